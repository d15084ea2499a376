"""A scene in motion: every kind of plant compiled to a Model and a State, stepped in one wind."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from windswept.motion import (
    TIME_STEP,
    Level,
    Model,
    State,
    Stepper,
    build_model,
    finest_level,
    pose_links,
    rest_state,
)
from windswept.plants.plant import Floats, Plant
from windswept.plants.pose import Pose
from windswept.scene.grow_kinds import grow_kinds
from windswept.scene.scene import Placements, Scene
from windswept.scene.terrain import Terrain
from windswept.wind.velocity import velocity
from windswept.wind.wind import Wind

WIND_INTERVAL = 4
"""Inner steps between two samples of the wind: 30 a second; in between it changes linearly."""


@dataclass(frozen=True, slots=True)
class Probes:
    """Where the wind is sampled for all placements of one kind: B probes each."""

    world: Floats
    """(P * B, 3) m."""
    height: Floats
    """(P * B,) above the ground, m."""
    yaw: Floats
    """(P,) turn of each placement, rad."""


@dataclass(frozen=True, slots=True)
class MovingKind:
    """All placements of one kind of plant, with what moves them."""

    plant: Plant
    placements: Placements
    model: Model
    level: Level
    state: State
    stepper: Stepper
    probes: Probes


class Simulation:
    """Runs a scene; the same whatever the frame rate.

    Args:
        scene: what stands where, in which wind.
        plants: one for each of the scene's kinds; None grows them.
        say: told of each plant that is grown and compiled.
    """

    def __init__(
        self,
        scene: Scene,
        plants: list[Plant] | None = None,
        say: Callable[[str], None] = lambda line: None,
    ) -> None:
        self.scene = scene
        self.wind = scene.wind
        """May be replaced while the simulation runs, as the viewer's sliders do."""
        grown = grow_kinds(scene, say) if plants is None else plants
        self.kinds = [
            compile_kind(plant, placements, scene.terrain)
            for plant, placements in zip(grown, scene.placements, strict=True)
        ]
        self.time = 0.0
        """Seconds since rest."""
        self.step_count = 0
        """Inner steps taken since rest."""
        self._winds: list[tuple[Floats, Floats]] = []

    def advance(self, seconds: float) -> Simulation:
        """Lets ``seconds`` pass: as many fixed inner steps as fit."""
        self.time += seconds
        # A frame rate's rounding must not lose a step that is due.
        due = math.floor(self.time / TIME_STEP + 1e-6)
        while self.step_count < due:
            taken = self.step_count % WIND_INTERVAL
            if taken == 0 or not self._winds:
                self._sample_winds(self.step_count - taken)
            count = min(due - self.step_count, WIND_INTERVAL - taken)
            for kind, (before, after) in zip(self.kinds, self._winds, strict=True):
                kind.stepper.step(kind.state, before, after, count, taken, WIND_INTERVAL)
            self.step_count += count
        return self

    @property
    def pose(self) -> list[Pose]:
        """Where every link of every kind is at this moment, in the plants' own frames."""
        ahead = self.time - self.step_count * TIME_STEP
        return [pose_links(kind.model, kind.level, kind.state, ahead) for kind in self.kinds]

    @property
    def wind_speeds(self) -> list[Floats]:
        """(P,) mean wind speed in the crown of every placement, m/s, kind by kind."""
        if not self._winds:
            self._sample_winds(self.step_count)
        return [np.linalg.norm(after, axis=2).mean(axis=1) for _, after in self._winds]

    @property
    def link_count(self) -> int:
        """Links that are stepped, over all placements."""
        return sum(kind.model.link_count * kind.placements.count for kind in self.kinds)

    def _sample_winds(self, step: int) -> None:
        """Winds at both ends of the interval that begins at an inner step."""
        start, stop = step * TIME_STEP, (step + WIND_INTERVAL) * TIME_STEP
        self._winds = [
            (wind_at_probes(self.wind, kind.probes, start), wind_at_probes(self.wind, kind.probes, stop))
            for kind in self.kinds
        ]


def compile_kind(plant: Plant, placements: Placements, terrain: Terrain) -> MovingKind:
    """Model, resting State and probes of all placements of one plant."""
    model = build_model(plant)
    level = finest_level(model)
    state = rest_state(level, placements.count)
    probes = place_probes(level, placements, terrain)
    return MovingKind(plant, placements, model, level, state, Stepper(level), probes)


def place_probes(level: Level, placements: Placements, terrain: Terrain) -> Probes:
    """World positions and heights above ground of every placement's probes."""
    local = level.probe_position
    turned = turn_about_z(np.broadcast_to(local, (placements.count, *local.shape)), placements.yaw)
    world = (turned + placements.position[:, None, :]).reshape(-1, 3).astype(np.float32)
    height = world[:, 2] - terrain.height(world[:, 0], world[:, 1])
    return Probes(world, np.maximum(height, 0.0).astype(np.float32), placements.yaw)


def wind_at_probes(wind: Wind, probes: Probes, time: float) -> Floats:
    """(P, B, 3) air velocity at every placement's probes, in the plant's own frame, m/s."""
    placements = len(probes.yaw)
    air = velocity(wind, probes.world, probes.height, time)
    return turn_about_z(air.reshape(placements, -1, 3), -probes.yaw)


def turn_about_z(vectors: Floats, angle: Floats) -> Floats:
    """(P, B, 3) vectors turned about +Z by (P,) angles, rad."""
    cosine, sine = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1).astype(np.float32)
