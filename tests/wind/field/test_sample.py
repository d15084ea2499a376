"""What trees read: the wind itself, and what the field adds to it."""

import numpy as np

from windswept.wind.field import Cylinder, Line, sample, step_field
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.velocity import velocity
from windswept.wind.waves import WaveSchedule, WaveSet
from windswept.wind.wind import Wind

from .field_cases import FLAT, small_field, steady

TURBULENT = Wind(mean=steady(6.0).mean, waves=WaveSchedule((WaveSet(plausible_waves(6.0, 0.3, 1)),)))
DISTURBED = {
    "obstacles": (Cylinder((0.0, 0.0), 3.0, 5.0),),
    "primitives": (Line((9.0, 5.0, 0.0), vortex=20.0),),
}


def nodes() -> tuple[np.ndarray, np.ndarray]:
    points = FLAT.nodes().reshape(-1, 3).astype(np.float32)
    return points, points[:, 2].copy()


def test_wind_and_field_add_up_to_the_fields_air_at_its_nodes() -> None:
    field = small_field(TURBULENT, **DISTURBED)
    step_field(field, 3.0)
    points, height = nodes()
    air = velocity(field.wind, points, height, field.time) + sample(field, points, height)
    np.testing.assert_allclose(air, field.velocity.reshape(-1, 3), atol=2e-5)


def test_between_nodes_it_is_trilinear() -> None:
    field = small_field(TURBULENT, **DISTURBED)
    step_field(field, 1.0)
    middle = np.array([[-4.5, 2.5, 0.0]], np.float32)
    corners = np.array([[-5.0 + a, 2.0 + b, 0.0] for a in (0, 1) for b in (0, 1) for _ in (0, 1)], np.float32)
    heights = np.array([2.0, 3.0] * 4, np.float32)
    mean = sample(field, corners, heights).mean(axis=0)
    np.testing.assert_allclose(sample(field, middle, np.array([2.5], np.float32))[0], mean, atol=1e-5)


def test_undisturbed_and_outside_it_adds_nothing() -> None:
    field = small_field(TURBULENT)
    step_field(field, 1.0)
    points, height = nodes()
    np.testing.assert_allclose(sample(field, points, height), 0.0, atol=1e-5)
    field = small_field(TURBULENT, **DISTURBED)
    step_field(field, 1.0)
    outside = np.array([[-40.0, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, 0.0], [np.nan, 0.0, 0.0]], np.float32)
    assert not sample(field, outside, np.array([1.0, 1.0, 90.0, 1.0], np.float32)).any()


def test_below_the_ground_is_on_it() -> None:
    field = small_field(TURBULENT, **DISTURBED)
    step_field(field, 1.0)
    points = np.array([[9.0, 3.0, 0.0]] * 2, np.float32)
    below, on = sample(field, points, np.array([-2.0, 0.0], np.float32))
    np.testing.assert_array_equal(below, on)
    assert on.any()


def test_any_number_of_points() -> None:
    field = small_field(TURBULENT, **DISTURBED)
    step_field(field, 1.0)
    points, height = nodes()
    whole = sample(field, points, height)
    for count in (0, 1, 511, 512, 513):
        np.testing.assert_array_equal(sample(field, points[:count], height[:count]), whole[:count])
