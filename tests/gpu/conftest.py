from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from handmade import random_tree
from stands import SOFT
from windswept.geometry.curves import build_geometry
from windswept.geometry.geometry import Geometry
from windswept.gpu.device import shared_device
from windswept.gpu.frame import Camera, Frame, Ground, PosedPlants
from windswept.gpu.renderer import Renderer
from windswept.plants.plant import Plant
from windswept.plants.pose import Pose, rest_pose

SIZE = (160, 96)


@dataclass(frozen=True)
class Stand:
    """Two kinds of small trees, two placements of each."""

    plants: list[Plant]
    geometries: list[Geometry]
    renderer: Renderer

    def frame(self, poses: list[Pose] | None = None, **changes: Any) -> Frame:
        poses = poses or [rest_pose(plant, 2) for plant in self.plants]
        flutter = np.full(2, changes.pop("flutter", 0.0), np.float32)
        placed = [
            PosedPlants(
                pose.link, np.array([(x, 0, 0), (x + 1, 2, 0)], np.float32), np.array([0.0, 1.0]), flutter
            )
            for pose, x in zip(poses, (-2.0, 2.0), strict=True)
        ]
        camera = changes.pop("camera", Camera((0.0, -9.0, 2.0), (0.0, 0.0, 1.5)))
        return Frame(tuple(placed), camera, **changes)


@pytest.fixture(scope="session")
def device() -> Any:
    return shared_device()


@pytest.fixture(scope="session")
def soft_trees() -> list[Plant]:
    return [random_tree(seed, material=SOFT) for seed in (3, 5)]


@pytest.fixture(scope="session")
def stand(device: Any) -> Stand:
    plants = [random_tree(4), random_tree(7)]
    geometries = [build_geometry(plant) for plant in plants]
    ground = Ground(np.zeros((5, 5), np.float32), (-20.0, -20.0), 10.0)
    return Stand(plants, geometries, Renderer(plants, geometries, ground, SIZE))
