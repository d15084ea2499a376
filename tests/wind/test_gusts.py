"""Verification of gust fronts: arrival, shape, width, and sudden fronts."""

import math

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.wind.gusts import Gust
from windswept.wind.velocity import velocity_reference
from windswept.wind.wind import Wind


def at(gust: Gust, places: list[tuple[float, float]], time: float) -> np.ndarray:
    """(N, 2) horizontal velocity at reference height."""
    points = np.array([[x, y, 10.0] for x, y in places], dtype=np.float32)
    height = np.full(len(places), 10.0, dtype=np.float32)
    return velocity_reference(Wind(gusts=(gust,)), points, height, time)[:, :2]


@pytest.mark.parametrize("azimuth", [0.0, 2.2, -1.0])
def test_gust_arrives_at_start_plus_distance_over_speed(azimuth: float) -> None:
    gust = Gust(start=2.0, strength=8.0, azimuth=azimuth, speed=10.0, position=(-3.0, 4.0))
    place = [(-3.0 + 40.0 * math.cos(azimuth), 4.0 + 40.0 * math.sin(azimuth))]
    assert not at(gust, place, 6.0 - 1e-3).any()
    after = at(gust, place, 6.2)[0]
    assert math.atan2(after[1], after[0]) == pytest.approx(azimuth, abs=1e-4)


def test_shape_behind_the_front() -> None:
    gust = Gust(start=0.0, strength=8.0, speed=10.0, rise_length=10.0, hold_length=20.0, decay_length=30.0)
    times = (0.0, 0.5, 1.0, 2.0, 3.0, 4.5, 6.0, 9.0)
    series = [at(gust, [(0.0, 0.0)], t)[0, 0] for t in times]
    assert series == pytest.approx([0.0, 4.0, 8.0, 8.0, 8.0, 4.0, 0.0, 0.0], abs=1e-9)


def test_gust_is_smooth_in_value_and_slope() -> None:
    gust = Gust(start=0.0, strength=8.0, speed=10.0)
    times = np.arange(-0.5, 8.0, 1e-3)
    slope = np.diff([at(gust, [(0.0, 0.0)], float(t))[0, 0] for t in times]) / 1e-3
    assert np.abs(np.diff(slope)).max() < 1e-3 * 1.05 * 6.0 * 8.0 / 1.5**2  # largest curvature 6 S / rise^2


def test_width_fades_to_the_sides() -> None:
    gust = Gust(start=0.0, strength=8.0, speed=10.0, hold_length=1000.0, width=20.0)
    series = at(gust, [(0.0, y) for y in (0.0, 10.0, -10.0, 20.0, 35.0)], 10.0)[:, 0]
    assert series == pytest.approx([8.0, 4.0, 4.0, 0.0, 0.0], abs=1e-9)


SUDDEN = {"start": 3.0, "strength": 12.0, "speed": 1e6, "rise_length": 0.0, "decay_length": 0.0}


def test_a_fast_endless_front_is_sudden_everywhere_and_stays() -> None:
    gust = Gust(**SUDDEN, hold_length=math.inf)
    places = [(-400.0, 0.0), (0.0, 0.0), (300.0, 200.0)]
    assert not at(gust, places, 2.99).any()
    np.testing.assert_allclose(at(gust, places, 3.01)[:, 0], 12.0)
    np.testing.assert_allclose(at(gust, places, 4000.0)[:, 0], 12.0)


def test_a_sudden_gust_ends_as_suddenly() -> None:
    gust = Gust(**SUDDEN, hold_length=2e6)
    assert at(gust, [(0.0, 0.0)], 4.99)[0, 0] == pytest.approx(12.0)
    assert at(gust, [(0.0, 0.0)], 5.01)[0, 0] == 0.0


@pytest.mark.parametrize(
    ("change", "place"),
    [
        ({"speed": 0.0}, "speed"),
        ({"width": -1.0}, "width"),
        ({"rise_length": -1.0}, "rise_length"),
        ({"decay_length": math.nan}, "decay_length"),
        ({"strength": math.inf}, "strength"),
    ],
)
def test_bad_gusts_say_what_is_wrong(change: dict[str, float], place: str) -> None:
    with pytest.raises(InputError, match=place):
        Gust(**({"start": 0.0, "strength": 1.0} | change))
