"""From the camera table of a scene file to Camera, and a camera that frames one plant."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.scene.camera import Camera, standing_camera
from windswept.scene.form import CameraForm, KeyForm
from windswept.scene.terrain import Terrain

Reals = NDArray[np.float64]

LONE_FOV = math.radians(35.0)
LONE_MARGIN = 1.25
"""Height of the picture over that of the plant in it."""
SAME_PLACE = 1e-3
"""An eye nearer to its target than this has no direction, m."""


def build_camera(source: str, form: CameraForm, terrain: Terrain) -> Camera:
    """The camera of a scene; heights in the file are above the ground.

    Args:
        source: the scene file, for error messages.
        form: its [camera] table.
        terrain: the ground.

    Raises:
        InputError: neither or both of a place and keys, keys out of order, or an eye in its target or in the
            ground.
    """
    keys = form.key or [_only_key(source, form)]
    if form.key and (form.eye is not None or form.target is not None):
        raise InputError(source, "camera.key", None, "either keys or eye and target, not both")
    for i, key in enumerate(keys):
        place = f"camera.key[{i}]" if form.key else "camera"
        if i and not key.time_s > keys[i - 1].time_s:
            raise InputError(source, f"{place}.time_s", key.time_s, f"a time after {keys[i - 1].time_s:g}")
        if math.dist(key.eye, key.target) < SAME_PLACE:
            raise InputError(source, f"{place}.target", list(key.target), "a place other than the eye")
        if key.eye[2] < 0.0:
            ground = float(terrain.height(key.eye[0], key.eye[1]))
            expected = f"a height above the ground from 0 up: it lies at {ground:.4g} m there"
            raise InputError(source, f"{place}.eye", list(key.eye), expected)
    fov = [form.fov_degrees if key.fov_degrees is None else key.fov_degrees for key in keys]
    return Camera(
        time=np.array([key.time_s for key in keys], dtype=np.float32),
        eye=_on_ground(np.array([key.eye for key in keys]), terrain),
        target=_on_ground(np.array([key.target for key in keys]), terrain),
        fov_y=np.radians(fov).astype(np.float32),
    )


def _only_key(source: str, form: CameraForm) -> KeyForm:
    """The one key of a camera that stands."""
    if form.eye is None or form.target is None:
        missing = "camera.eye" if form.eye is None else "camera.target"
        raise InputError(source, missing, None, "this key to be given, or [[camera.key]] instead")
    return KeyForm(time_s=0.0, eye=form.eye, target=form.target)


def _on_ground(places: Reals, terrain: Terrain) -> NDArray[np.float32]:
    """(K, 3) the places with their heights above ground turned into heights."""
    lifted = places.astype(np.float64)
    lifted[:, 2] += terrain.height(places[:, 0], places[:, 1])
    return lifted.astype(np.float32)


def frame_plant(height: float, radius: float) -> Camera:
    """A camera that shows a whole plant at the origin from the south, a little from the east.

    Args:
        height: of the plant, m.
        radius: of its crown, m.
    """
    half = LONE_MARGIN * max(0.5 * height, radius)
    distance = half / math.tan(0.5 * LONE_FOV) + radius
    direction = np.array([0.35, -0.94, 0.0])
    target = np.array([0.0, 0.0, 0.5 * height])
    eye = direction * distance + np.array([0.0, 0.0, max(0.3 * height, 0.2)])
    return standing_camera(eye, target, LONE_FOV)


def frame_patch(height: float, edge: float) -> Camera:
    """A camera that shows a square patch at the origin from the south and from above, a little from the east.

    Args:
        height: of what grows there, m.
        edge: of the patch, which fills most of a picture wider than high, m.
    """
    half = LONE_MARGIN * max(0.65 * height, 0.3 * edge)
    distance = half / math.tan(0.5 * LONE_FOV) + 0.5 * edge
    eye = np.array([0.3 * distance, -0.95 * distance, 0.5 * height + 0.3 * distance])
    return standing_camera(eye, np.array([0.0, 0.0, 0.5 * height]), LONE_FOV)
