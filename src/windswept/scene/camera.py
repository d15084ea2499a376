"""The camera: where it is and looks, moving smoothly through its keys."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

Floats = NDArray[np.float32]
Doubles = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class View:
    """A camera at one moment."""

    eye: Floats
    """(3,) m."""
    target: Floats
    """(3,) the point at the centre of the picture, m."""
    fov_y: float
    """Vertical field of view, radians."""


@dataclass(frozen=True, slots=True)
class Camera:
    """K keys of a camera path; one key for a camera that stands."""

    time: Floats
    """(K,) ascending, s."""
    eye: Floats
    """(K, 3) m."""
    target: Floats
    """(K, 3) m."""
    fov_y: Floats
    """(K,) radians."""


def standing_camera(eye: NDArray[np.floating], target: NDArray[np.floating], fov_y: float) -> Camera:
    """A camera that does not move."""
    return Camera(
        time=np.zeros(1, dtype=np.float32),
        eye=np.asarray(eye, dtype=np.float32)[None],
        target=np.asarray(target, dtype=np.float32)[None],
        fov_y=np.array([fov_y], dtype=np.float32),
    )


def view_at(camera: Camera, time: float) -> View:
    """The camera at a time, s, see ``path_at``."""
    now = path_at(camera, time)
    return View(eye=now[0:3].astype(np.float32), target=now[3:6].astype(np.float32), fov_y=float(now[6]))


def path_at(camera: Camera, time: float | Doubles) -> Doubles:
    """(..., 7) eye, target and field of view at times (...,), s: it stands before its first and after its last key.

    Between keys it follows monotone cubics (Fritsch and Carlson 1980): no jerk, and no swinging past a key.
    """
    keys = np.concatenate([camera.eye, camera.target, camera.fov_y[:, None]], axis=1).astype(np.float64)
    if len(camera.time) == 1:
        return np.broadcast_to(keys[0], (*np.shape(time), 7))
    clamped = np.clip(time, camera.time[0], camera.time[-1])
    return np.asarray(PchipInterpolator(camera.time.astype(np.float64), keys)(clamped))
