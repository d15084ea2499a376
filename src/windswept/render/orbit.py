"""A camera that circles round a point."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from windswept.gpu.frame import Camera

STEEPEST = np.radians(88.0)
LOWEST = np.radians(-20.0)
NEAREST = 0.5
"""m."""


@dataclass(frozen=True, slots=True)
class Orbit:
    """Where a circling camera is."""

    focus: tuple[float, float, float]
    """Point it looks at, m."""
    distance: float
    """m."""
    azimuth: float
    """Bearing of the camera seen from the focus, rad from +X towards +Y."""
    elevation: float
    """Of the camera above the focus, rad."""
    fov_y: float

    def turned(self, right: float, up: float) -> Orbit:
        """Moved round the focus by angles, rad."""
        elevation = float(np.clip(self.elevation + up, LOWEST, STEEPEST))
        return replace(self, azimuth=self.azimuth - right, elevation=elevation)

    def zoomed(self, factor: float) -> Orbit:
        """Moved away from the focus by a factor."""
        return replace(self, distance=max(self.distance * factor, NEAREST))

    def camera(self) -> Camera:
        """The camera at this place."""
        level = np.cos(self.elevation)
        direction = np.array(
            [level * np.cos(self.azimuth), level * np.sin(self.azimuth), np.sin(self.elevation)]
        )
        x, y, z = (float(value) for value in np.asarray(self.focus) + self.distance * direction)
        return Camera((x, y, z), self.focus, self.fov_y)


def orbit_from(camera: Camera) -> Orbit:
    """Orbit round a camera's own target."""
    offset = np.asarray(camera.eye, np.float64) - np.asarray(camera.target, np.float64)
    distance = float(np.linalg.norm(offset))
    azimuth = float(np.arctan2(offset[1], offset[0]))
    elevation = float(np.arcsin(offset[2] / distance))
    return Orbit(camera.target, distance, azimuth, elevation, camera.fov_y)
