"""Where the wind is sampled for placements of a plant, and what it is there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.motion import Level
from windswept.plants.plant import Floats
from windswept.scene.scene import Placements
from windswept.scene.terrain import Terrain
from windswept.wind.field import Field, sample
from windswept.wind.velocity import velocity
from windswept.wind.wind import Wind


@dataclass(frozen=True, slots=True)
class Probes:
    """B probes each of P placements."""

    world: Floats
    """(P * B, 3) m."""
    height: Floats
    """(P * B,) above the ground, m."""
    yaw: Floats
    """(P,) turn of each placement, rad."""


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


def field_at_probes(field: Field, probes: Probes) -> Floats:
    """(P, B, 3) what a force field adds to the wind at every placement's probes, in the plant's own frame, m/s."""
    added = sample(field, probes.world, probes.height)
    return turn_about_z(added.reshape(len(probes.yaw), -1, 3), -probes.yaw)


def turn_about_z(vectors: Floats, angle: Floats) -> Floats:
    """(P, B, 3) vectors turned about +Z by (P,) angles, rad."""
    cosine, sine = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1).astype(np.float32)
