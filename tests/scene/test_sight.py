"""From where a scene is going to be seen: all of the camera's way."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.scene.camera import Camera, standing_camera, view_at
from windswept.scene.sight import MOST_EYES, SPACING, sight_of


def flight(eyes: list[list[float]], times: list[float], fov: list[float] | None = None) -> Camera:
    """A camera that looks at the origin."""
    keys = len(times)
    return Camera(
        time=np.array(times, np.float32),
        eye=np.array(eyes, np.float32),
        target=np.zeros((keys, 3), np.float32),
        fov_y=np.array(fov or [0.7] * keys, np.float32),
    )


def test_a_long_way_is_seen_from_everywhere_along_it() -> None:
    # Slow, then fast: what lies along the fast part is passed between two frames all the same.
    camera = flight(
        [[0.0, 0.0, 2.0], [20.0, 0.0, 2.0], [900.0, 300.0, 40.0], [900.0, 900.0, 2.0]],
        [0.0, 50.0, 53.0, 60.0],
    )
    sight = sight_of(camera, 60.0, 1000)
    passed = np.array([view_at(camera, time).eye for time in np.linspace(0.0, 60.0, 6001)])
    away = sight.distance(passed)
    assert away.max() <= 0.5 * SPACING
    assert np.linalg.norm(np.diff(passed, axis=0), axis=1).max() > SPACING
    beside = passed + np.float32([0.0, 0.0, 50.0])
    assert sight.distance(beside).max() <= 50.0 + 0.1
    assert len(sight.eyes) < 4000


def test_only_what_is_filmed_counts() -> None:
    camera = flight([[0.0, 0.0, 2.0], [100.0, 0.0, 2.0]], [-5.0, 5.0], [0.4, 0.8])
    sight = sight_of(camera, 2.0, 1000)
    ends = [view_at(camera, time) for time in (0.0, 2.0)]
    np.testing.assert_allclose(sight.eyes[[0, -1]], [end.eye for end in ends], rtol=1e-6)
    assert sight.pixel == pytest.approx(2.0 * np.tan(0.5 * ends[0].fov_y) / 1000.0)


def test_a_camera_that_stands_is_one_place() -> None:
    sight = sight_of(standing_camera(np.array([3.0, 4.0, 0.0]), np.zeros(3), 0.6), 10.0, 720)
    assert sight.eyes.tolist() == [[3.0, 4.0, 0.0]]
    np.testing.assert_allclose(sight.distance(np.zeros((2, 3), np.float32)), 5.0)


def test_no_way_is_too_long() -> None:
    there_and_back = [[(-1.0) ** k * 9000.0, 0.0, 2.0] for k in range(200)]
    sight = sight_of(flight(there_and_back, list(range(200))), 199.0, 720)
    assert len(sight.eyes) <= MOST_EYES + 400
