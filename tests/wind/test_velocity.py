"""The fused kernel against the plain formula, and what holds for any wind."""

import math

import numpy as np
import pytest

from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind, Profile, profile_factor
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.velocity import ALONE, velocity, velocity_reference
from windswept.wind.waves import AS_PRINTED, Waves, WaveSchedule, WaveSet
from windswept.wind.wind import Wind, calm

REAL_POWERS = Waves([0.1, 2.0], [0.2, 1.0], [20.0, 31.0], [5.0, 7.0], [1.0, 0.5], [1.7, 2.5], [0.3, 4.0])
PRINTED = Waves(
    [0.1, 2.0], [0.1, 2.0], [20.0, 31.0], [5.0, 7.0], [1.0, 0.5], [2.0, 3.0], [0.3, 4.0], AS_PRINTED
)
PLAUSIBLE = plausible_waves(6.0, 0.3, seed=3, azimuth=0.4)

WINDS = {
    "mean": Wind(mean=MeanWind(6.0, 0.4)),
    "canopy": Wind(profile=Profile(1.0, 7.0, 20.0), mean=MeanWind(6.0, 0.4)),
    "waves": Wind(waves=WaveSchedule((WaveSet(PLAUSIBLE),))),
    "real powers": Wind(waves=WaveSchedule((WaveSet(REAL_POWERS),))),
    "printed": Wind(waves=WaveSchedule((WaveSet(PRINTED),))),
    "blend": Wind(waves=WaveSchedule((WaveSet(PLAUSIBLE, end=6.0), WaveSet(REAL_POWERS, start=4.0)))),
    "gust": Wind(gusts=(Gust(1.0, 9.0, azimuth=0.3, width=60.0),)),
    "step": Wind(gusts=(Gust(2.0, 9.0, 2.0, speed=1e6, rise_length=0.0, hold_length=math.inf),)),
}
WINDS["all"] = Wind(
    profile=Profile(0.3),
    mean=MeanWind(6.0, 0.4),
    waves=WINDS["blend"].waves,
    gusts=WINDS["gust"].gusts + WINDS["step"].gusts,
)


def some_points(count: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    points = rng.uniform(-200.0, 200.0, (count, 3)).astype(np.float32)
    return points, rng.uniform(-1.0, 25.0, count).astype(np.float32)


@pytest.mark.parametrize("name", WINDS)
@pytest.mark.parametrize("time", [0.0, 5.0, 3600.5])
def test_kernel_equals_the_plain_formula(name: str, time: float) -> None:
    points, height = some_points(1500)
    expected = velocity_reference(WINDS[name], points, height, time)
    scale = max(1.0, float(np.abs(expected).max()))
    np.testing.assert_allclose(
        velocity(WINDS[name], points, height, time), expected, atol=1e-5 * scale, rtol=0.0
    )


def test_sources_add_up() -> None:
    points, height = some_points(50)
    parts = [
        Wind(profile=Profile(0.3), mean=WINDS["all"].mean),
        Wind(profile=Profile(0.3), waves=WINDS["all"].waves),
        *(Wind(profile=Profile(0.3), gusts=(gust,)) for gust in WINDS["all"].gusts),
    ]
    total = sum(velocity_reference(part, points, height, 5.0) for part in parts)
    np.testing.assert_allclose(velocity_reference(WINDS["all"], points, height, 5.0), total, atol=1e-12)


def test_calm_is_exactly_zero() -> None:
    points, height = some_points(700)
    assert not velocity(calm(), points, height, 12.0).any()
    assert not velocity_reference(calm(), points, height, 12.0).any()


def test_mean_follows_the_profile_and_direction() -> None:
    wind = Wind(mean=MeanWind(4.0, math.pi / 2))
    points, height = some_points(20)
    field = velocity(wind, points, height, 0.0)
    np.testing.assert_allclose(field[:, 1], 4.0 * profile_factor(wind.profile, height), rtol=1e-5)
    np.testing.assert_allclose(field[:, 0], 0.0, atol=1e-6)
    assert not field[:, 2].any()


@pytest.mark.parametrize("count", [0, 1, 511, 512, 513, ALONE, ALONE + 1])
def test_any_number_of_points_on_one_thread_or_more(count: int) -> None:
    points, height = some_points(count)
    expected = velocity_reference(WINDS["all"], points, height, 1.0)
    np.testing.assert_allclose(velocity(WINDS["all"], points, height, 1.0), expected, atol=5e-5)


def test_result_does_not_depend_on_the_neighbours_and_fills_out() -> None:
    points, height = some_points(1500)
    out = np.full((1500, 3), np.nan, dtype=np.float32)
    assert velocity(WINDS["all"], points, height, 2.0, out) is out
    alone = velocity(WINDS["all"], points[700:701], height[700:701], 2.0)
    np.testing.assert_allclose(out[700], alone[0], atol=2e-6)
    np.testing.assert_array_equal(out, velocity(WINDS["all"], points, height, 2.0))


def test_far_and_late_stays_finite() -> None:
    points, height = some_points(100)
    assert np.isfinite(velocity(WINDS["all"], points * np.float32(1e3), height * np.float32(100), 1e6)).all()
