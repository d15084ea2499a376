"""Camera paths: through the keys, smooth between them, still outside."""

import numpy as np
import pytest

from windswept.scene.build_camera import frame_plant
from windswept.scene.camera import Camera, standing_camera, view_at

PATH = Camera(
    time=np.array([0.0, 4.0, 10.0], np.float32),
    eye=np.array([[0, 0, 2], [8, 0, 2], [9, 5, 3]], np.float32),
    target=np.array([[0, 10, 2], [0, 10, 2], [1, 10, 4]], np.float32),
    fov_y=np.array([0.7, 0.7, 0.5], np.float32),
)


@pytest.mark.parametrize("key", [0, 1, 2])
def test_path_passes_through_its_keys(key: int) -> None:
    view = view_at(PATH, float(PATH.time[key]))
    np.testing.assert_allclose(view.eye, PATH.eye[key], atol=1e-6)
    np.testing.assert_allclose(view.target, PATH.target[key], atol=1e-6)
    assert view.fov_y == pytest.approx(PATH.fov_y[key])


def test_path_is_smooth_and_does_not_overshoot() -> None:
    times = np.linspace(0.0, 10.0, 2001)
    eyes = np.array([view_at(PATH, float(t)).eye for t in times], dtype=np.float64)
    velocity = np.diff(eyes, axis=0) / np.diff(times)[:, None]
    assert np.abs(np.diff(velocity, axis=0)).max() < 0.05
    assert eyes[:, 0].max() <= 9.0 + 1e-5
    assert (np.diff(eyes[:, 0]) >= -1e-5).all()


def test_camera_stands_outside_its_keys() -> None:
    np.testing.assert_array_equal(view_at(PATH, -3.0).eye, PATH.eye[0])
    np.testing.assert_array_equal(view_at(PATH, 30.0).eye, PATH.eye[2])


def test_standing_camera() -> None:
    camera = standing_camera(np.array([1.0, 2.0, 3.0]), np.zeros(3), 0.6)
    view = view_at(camera, 17.0)
    assert view.eye.tolist() == [1.0, 2.0, 3.0]
    assert view.eye.dtype == np.float32


@pytest.mark.parametrize(("height", "radius"), [(0.5, 0.1), (12.0, 4.0), (10.0, 9.0)])
def test_framed_plant_is_inside_the_picture(height: float, radius: float) -> None:
    view = view_at(frame_plant(height, radius), 0.0)
    forward = (view.target - view.eye) / np.linalg.norm(view.target - view.eye)
    for corner in ([0, 0, 0], [0, 0, height], [radius, 0, height / 2], [-radius, 0, height / 2]):
        ray = np.array(corner) - view.eye
        assert np.arccos(ray @ forward / np.linalg.norm(ray)) < 0.5 * view.fov_y
