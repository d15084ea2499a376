"""Sight: from where and how sharply a scene is going to be seen; what will always be far is planted simpler."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from windswept.scene.camera import Camera, Doubles, path_at

Floats = NDArray[np.float32]

SPACING = 3.0
"""A camera's way is looked at from places at most so far apart, m: what it passes at all it passes near to one."""
MOST_EYES = 100_000
"""Where the way is so long that there would be more, some 100 km, they are farther apart."""
STEEPEST = 3.0
"""Greatest slope of a monotone cubic over its mean slope."""


@dataclass(frozen=True, slots=True)
class Sight:
    """The ways of a camera."""

    eyes: Floats
    """(E, 3) places from which the scene is seen, m."""
    pixel: float
    """Size of a pixel at a distance of 1 m, where the view is narrowest, m."""

    def distance(self, position: Floats) -> Floats:
        """(P,) least distance of (P, 3) places from the eyes, m."""
        return np.asarray(cKDTree(self.eyes).query(position)[0], np.float32)


def sight_of(camera: Camera, duration: float, picture_height: int) -> Sight:
    """What a scene's own camera will see.

    Args:
        camera: its keys.
        duration: of the scene, s.
        picture_height: pixels.
    """
    path = path_at(camera, _moments(camera, duration))
    eyes = np.unique(path[:, :3], axis=0).astype(np.float32)
    return Sight(eyes, float(2.0 * np.tan(0.5 * path[:, 6].min()) / picture_height))


def _moments(camera: Camera, duration: float) -> Doubles:
    """(T,) times, s, at which the eye has gone at most SPACING since the last one, those of the keys among them."""
    way = STEEPEST * np.linalg.norm(np.diff(camera.eye, axis=0), axis=1)
    parts = np.ceil(way / max(SPACING, way.sum() / MOST_EYES)).astype(int)
    between = [
        np.linspace(start, stop, count + 1)
        for start, stop, count in zip(camera.time[:-1], camera.time[1:], np.maximum(parts, 1), strict=True)
    ]
    return np.clip(np.concatenate([[0.0, duration], *between]), 0.0, duration)
