"""Sight: from where and how sharply a scene is going to be seen; what will always be far is planted simpler."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.scene.camera import Camera, view_at

Floats = NDArray[np.float32]

SAMPLES = 17
"""Moments of a camera's way at which it is looked for."""


@dataclass(frozen=True, slots=True)
class Sight:
    """The ways of a camera."""

    eyes: Floats
    """(E, 3) places from which the scene is seen, m."""
    pixel: float
    """Size of a pixel at a distance of 1 m, where the view is narrowest, m."""

    def distance(self, position: Floats) -> Floats:
        """(P,) least distance of (P, 3) places from the eyes, m."""
        away = np.linalg.norm(position[:, None, :] - self.eyes, axis=2)
        return np.asarray(away.min(axis=1), np.float32)


def sight_of(camera: Camera, duration: float, picture_height: int) -> Sight:
    """What a scene's own camera will see.

    Args:
        camera: its keys.
        duration: of the scene, s.
        picture_height: pixels.
    """
    views = [view_at(camera, time) for time in np.linspace(0.0, duration, SAMPLES)]
    narrowest = min(view.fov_y for view in views)
    eyes = np.unique([view.eye for view in views], axis=0).astype(np.float32)
    return Sight(eyes, float(2.0 * np.tan(0.5 * narrowest) / picture_height))
