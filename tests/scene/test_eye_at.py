"""The eye of a scene's camera: who simulation levels are chosen for."""

from __future__ import annotations

import math

import numpy as np
import pytest

from windswept.levels import seen_distance
from windswept.levels.choose import OUT_OF_VIEW
from windswept.scene.camera import Camera, View, view_at
from windswept.scene.eye_at import eye_at, eye_of

CAMERA = Camera(
    time=np.float32([0.0, 4.0]),
    eye=np.float32([[0.0, 0.0, 2.0], [8.0, 0.0, 2.0]]),
    target=np.float32([[0.0, 20.0, 2.0], [8.0, 20.0, 2.0]]),
    fov_y=np.float32([0.8, 0.8]),
)


def test_the_eye_is_the_camera_at_that_time() -> None:
    eye, view = eye_at(CAMERA, 2.0, 1080, 1.5, 0.5), view_at(CAMERA, 2.0)
    np.testing.assert_array_equal(eye.position, view.eye)
    np.testing.assert_allclose(eye.forward, [0.0, 1.0, 0.0], atol=1e-6)
    assert (eye.fov_y, eye.height, eye.tolerance, eye.aspect) == (view.fov_y, 1080, 0.5, 1.5)


def test_who_stands_behind_a_free_camera_is_spared() -> None:
    eye = eye_of(View(np.float32([3.0, 0.0, 2.0]), np.float32([3.0, -5.0, 2.0]), 0.8), 720, 1.5)
    ahead, behind = seen_distance(eye, np.float32([[3.0, -50.0, 2.0], [3.0, 50.0, 2.0]]), 1.0)
    assert behind == pytest.approx(OUT_OF_VIEW * ahead)


@pytest.mark.parametrize(("aspect", "spared"), [(1.0, True), (3.0, False)])
def test_a_wide_picture_spares_less_beside_it(aspect: float, spared: bool) -> None:
    eye = eye_at(CAMERA, 0.0, 720, aspect, 1.0)
    beside = math.atan(3.0 * math.tan(0.4))
    place = np.float32([[50.0 * math.sin(beside), 50.0 * math.cos(beside), 2.0]])
    assert (seen_distance(eye, place, 1.0)[0] > 49.5) == spared
