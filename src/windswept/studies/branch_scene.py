"""Trees of branches alone, bent and drawn on the card: what the reproduction of Skjermo's paper looks at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from windswept.geometry.curves import build_geometry
from windswept.gpu.bend import Bending, BranchDrawing, branch_look_rows
from windswept.gpu.bend.branch_drawing import LEVEL_GRIDS
from windswept.gpu.frame import Camera, Frame, Ground, PosedPlants
from windswept.gpu.renderer import Renderer
from windswept.motion.bend_branches import Branches, place_branches
from windswept.motion.bend_plant import plant_branches
from windswept.plants.plant import Floats, Ints, Plant

FIELD = Ground(np.zeros((2, 2), np.float32), (-300.0, -300.0), 600.0)
"""Flat ground."""


@dataclass(frozen=True, slots=True)
class BranchScene:
    """Branches on the card and the renderer that draws them."""

    renderer: Renderer
    bending: Bending
    nobody: tuple[PosedPlants, ...]
    """No placement of every kind: the renderer's own plants stay away."""

    def draw(
        self, camera: Camera, time: float = 0.0, wind: tuple[float, float] = (4.0, 1.0)
    ) -> NDArray[np.uint8]:
        """(height, width, 4) picture of the branches as they are bent now; time and wind move grass and clouds."""
        return self.renderer.draw(Frame(self.nobody, camera, time=time, wind=wind))

    def draw_aside(self, camera: Camera) -> None:
        """Draws the same and leaves it on the card."""
        self.renderer.draw_aside(Frame(self.nobody, camera, wind=(4.0, 1.0)))


def branch_scene(
    plants: Sequence[Plant],
    kind: Ints,
    position: Floats,
    yaw: NDArray[np.floating],
    size: tuple[int, int],
    kinds: Sequence[Branches] | None = None,
    grids: tuple[tuple[int, int], ...] = LEVEL_GRIDS,
    lit: str = "",
) -> BranchScene:
    """Put branches on the card.

    Args:
        plants: kinds of trees.
        kind: (P,) which of them each placement is.
        position: (P, 3) roots, m.
        yaw: (P,) turn about +Z, rad.
        size: width and height of the picture, pixels.
        kinds: branches of each kind; by default those of ``plant_branches``.
        grids: of ``BranchDrawing``.
        lit: of ``BranchDrawing``.

    Raises:
        GraphicsError: there is no graphics adapter.
    """
    geometries = [build_geometry(plant) for plant in plants]
    branches = place_branches(kinds or [plant_branches(plant) for plant in plants], kind, position, yaw)
    renderer = Renderer(list(plants), geometries, FIELD, size)
    looks, rows = branch_look_rows(branches, geometries, renderer.kinds, kind)
    bending = Bending(renderer.canvas.device, branches, rows)
    renderer.beside.append(BranchDrawing(renderer, bending, looks, grids, lit))
    none = np.zeros(0, np.float32)
    nobody = tuple(
        PosedPlants(np.zeros((0, plant.link_count, 8), np.float32), np.zeros((0, 3), np.float32), none, none)
        for plant in plants
    )
    return BranchScene(renderer, bending, nobody)


def bare(plant: Plant) -> Plant:
    """The plant in winter: no leaves to draw, and none to catch the wind."""
    names = [name for name in plant.__dataclass_fields__ if name.startswith("leaf_")]
    return replace(plant, **{name: getattr(plant, name)[:0] for name in names})
