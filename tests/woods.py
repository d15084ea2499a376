"""A wood on the card: placements of two small trees all round a camera, still, in wind that grows along it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from windswept.geometry.curves import build_geometry
from windswept.geometry.detail import DetailRules
from windswept.gpu.buffers import filled
from windswept.gpu.draw_list import DrawList, draw_list
from windswept.gpu.frame import Camera, CardMotion, Frame, PosedPlants
from windswept.gpu.renderer import Renderer
from windswept.plants.plant import Plant
from windswept.plants.pose import rest_pose

SIZE = (160, 96)
RULES = DetailRules(leaf_pixels=12.0)


@dataclass(frozen=True)
class Wood:
    """Many placements, posed at rest by whoever is asked."""

    plants: list[Plant]
    renderer: Renderer
    placed: tuple[PosedPlants, ...]
    speeds: Any

    def pose(self, encoder: Any, seating: Any) -> None:
        """Nobody moves: what the tests look at are rows and counts."""

    def frame(self, camera: Camera) -> Frame:
        return Frame(self.placed, camera, motion=CardMotion(self.pose, self.speeds))

    def uploaded(self, camera: Camera) -> Frame:
        """The same with poses that come from the CPU."""
        posed = [
            replace(placed, link=rest_pose(plant, len(placed.position)).link)
            for plant, placed in zip(self.plants, self.placed, strict=True)
        ]
        return Frame(tuple(posed), camera)

    def listed(self, camera: Camera) -> DrawList:
        """What the CPU chooses."""
        view, _ = self.renderer._look(self.frame(camera))
        return draw_list(self.renderer.kinds, self.placed, view, RULES)


def placed_round(rng: np.random.Generator, plant: Plant, count: int, reach: float) -> PosedPlants:
    position = np.zeros((count, 3), np.float32)
    position[:, :2] = rng.uniform(-reach, reach, (count, 2))
    yaw = rng.uniform(0.0, 6.0, count).astype(np.float32)
    return PosedPlants(None, position, yaw, np.zeros(count, np.float32))


def wood_of(renderer: Renderer, plants: list[Plant], counts: tuple[int, ...], reach: float) -> Wood:
    """A wood whose wind grows from placement to placement, m/s from 0 to 12."""
    rng = np.random.default_rng(0)
    placed = tuple(
        placed_round(rng, plant, count, reach) for plant, count in zip(plants, counts, strict=True)
    )
    speeds = filled(renderer.canvas.device, np.linspace(0.0, 12.0, sum(counts)).astype(np.float32))
    return Wood(plants, renderer, placed, speeds)


def wood_renderer(plants: list[Plant]) -> Renderer:
    return Renderer(plants, [build_geometry(plant) for plant in plants], size=SIZE, rules=RULES)
