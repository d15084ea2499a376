"""Scene: everything a scene file says, with every plant in its place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.scene.camera import Camera
from windswept.scene.spread.colony import Colony
from windswept.scene.terrain import Terrain
from windswept.wind.field import FieldPlan
from windswept.wind.wind import Wind

Floats = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class PlantKind:
    """One plant to grow; all its placements share it."""

    source: str
    """Anything that `grow_source` takes: a name or the path of a file."""
    seed: int
    """Seed of growth."""


@dataclass(frozen=True, slots=True)
class Placements:
    """Where the P placements of one plant kind stand."""

    position: Floats
    """(P, 3) of the root, on the ground, m."""
    yaw: Floats
    """(P,) turn about +Z, radians counter-clockwise."""

    @property
    def count(self) -> int:
        """Number of placements, P."""
        return len(self.yaw)


@dataclass(frozen=True, slots=True)
class Scene:
    """What stands where, in which wind, seen from where, for how long."""

    seed: int
    terrain: Terrain
    wind: Wind
    kinds: tuple[PlantKind, ...]
    placements: tuple[Placements, ...]
    """One for each of ``kinds``, in the same order."""
    camera: Camera
    sun_direction: Floats
    """(3,) unit vector towards the sun."""
    duration: float
    """s."""
    frames_per_second: float
    colonies: tuple[Colony, ...] = ()
    """Underbrush, placed or spread."""
    field: FieldPlan | None = None
    """What the wind alone does not say: agents, obstacles and flows."""

    @property
    def placement_count(self) -> int:
        """Number of plants that stand in the scene."""
        return sum(placements.count for placements in self.placements)

    @property
    def tuft_count(self) -> int:
        """Number of tufts of underbrush that stand in the scene."""
        return sum(colony.count for colony in self.colonies)

    @property
    def frame_count(self) -> int:
        """Number of pictures, the first at time 0."""
        return max(1, round(self.duration * self.frames_per_second))


def sun_towards(azimuth: float, elevation: float) -> Floats:
    """(3,) unit vector towards a sun at an azimuth (counter-clockwise from +x) and elevation, radians."""
    flat = np.cos(elevation)
    return np.array([flat * np.cos(azimuth), flat * np.sin(azimuth), np.sin(elevation)], dtype=np.float32)
