"""Poses made by hand for tests: every joint of a plant turned at random, links kept together."""

from __future__ import annotations

import numpy as np

from windswept.plants.plant import Plant
from windswept.plants.pose import Pose


def shaken_pose(plant: Plant, seed: int, angle: float = 0.1, placements: int = 2) -> Pose:
    """Joints turned about random axes by up to ``angle``, rad; every link stays fixed to its parent."""
    rng = np.random.default_rng(seed)
    link = np.zeros((placements, plant.link_count, 8))
    for placement in link:
        for child, parent in enumerate(plant.link_parent):
            axis = rng.standard_normal(3)
            half = 0.5 * rng.uniform(0.0, angle)
            turn = np.append(np.sin(half) * axis / np.linalg.norm(axis), np.cos(half))
            if parent < 0:
                placement[child, :3], placement[child, 4:] = plant.link_base[child], turn
                continue
            carrier = placement[parent, 4:]
            offset = plant.link_base[child].astype(float) - plant.link_base[parent]
            placement[child, :3] = placement[parent, :3] + turned(carrier, offset)
            placement[child, 4:] = product(carrier, turn)
    return Pose(link.astype(np.float32))


def turned(quaternion: np.ndarray, vector: np.ndarray) -> np.ndarray:
    twice = 2.0 * np.cross(quaternion[:3], vector)
    return vector + quaternion[3] * twice + np.cross(quaternion[:3], twice)


def product(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    vector = left[3] * right[:3] + right[3] * left[:3] + np.cross(left[:3], right[:3])
    return np.append(vector, left[3] * right[3] - left[:3] @ right[:3])
