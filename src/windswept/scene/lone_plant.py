"""A scene with one plant: what a species means where a scene is asked for."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from windswept.plants.sources import grow_source
from windswept.scene.build_camera import frame_plant
from windswept.scene.build_wind import build_wind
from windswept.scene.camera import Camera
from windswept.scene.form import GustForm, WindForm
from windswept.scene.scene import Placements, PlantKind, Scene, sun_towards
from windswept.scene.terrain import flat_terrain

GROUND_SIZE = 80.0
"""Edge of the flat ground, m."""
WIND = WindForm(
    speed_m_s=4.0, turbulence=0.3, gust=[GustForm(start_s=2.5, strength_m_s=6.0, position=(-10.0, 0.0))]
)


def lone_plant(source: str, seed: int = 0) -> Scene:
    """One plant on flat ground in a light breeze with a gust, and a camera that frames it.

    The plant is grown here to learn its size (0.01 to 0.4 s) and let go.

    Args:
        source: anything that `grow_source` takes.
        seed: of growth and of the turbulence.

    Raises:
        InputError: no such source, or its file is wrong.
        BudgetError: the plant would be larger than the budget of growth.
    """
    plant = grow_source(source, seed)
    radius = float(np.hypot(plant.link_tip[:, 0], plant.link_tip[:, 1]).max())
    placements = Placements(position=np.zeros((1, 3), dtype=np.float32), yaw=np.zeros(1, dtype=np.float32))
    empty = empty_scene(source, seed, plant.height, frame_plant(plant.height, radius))
    return replace(empty, kinds=(PlantKind(source, seed),), placements=(placements,))


def empty_scene(source: str, seed: int, height: float, camera: Camera) -> Scene:
    """Flat ground in a light breeze with a gust.

    Args:
        source: of what will stand there, for error messages.
        seed: of the turbulence.
        height: of what will stand there, m.
        camera: that looks at it.
    """
    return Scene(
        seed=seed,
        terrain=flat_terrain(max(GROUND_SIZE, 6.0 * height)),
        wind=build_wind(source, WIND, seed),
        kinds=(),
        placements=(),
        camera=camera,
        sun_direction=sun_towards(math.radians(215.0), math.radians(35.0)),
        duration=10.0,
        frames_per_second=25.0,
    )
