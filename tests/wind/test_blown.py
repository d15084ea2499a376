"""A wind made stronger, weaker, or turned: the same field, scaled and rotated about the origin."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.wind.blown import blown
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.velocity import velocity_reference
from windswept.wind.waves import WaveSchedule, WaveSet
from windswept.wind.wind import Wind

GUSTY = Wind(
    mean=MeanWind(4.0, 0.4),
    waves=WaveSchedule((WaveSet(plausible_waves(4.0, 0.3, 1, 0.4)),)),
    gusts=(Gust(start=1.0, strength=6.0, azimuth=0.7, position=(-20.0, 5.0), width=60.0),),
)
POINTS = np.random.default_rng(0).uniform(-50.0, 50.0, (40, 3)).astype(np.float32)
HEIGHT = np.full(40, 10.0, np.float32)


@pytest.mark.parametrize("time", [0.0, 3.0, 700.0])
def test_the_field_is_scaled_and_turned(time: float) -> None:
    turn, share = 1.1, 2.5
    turned = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    there = POINTS.copy()
    there[:, :2] = POINTS[:, :2] @ turned.T
    before = velocity_reference(GUSTY, POINTS, HEIGHT, time)[:, :2]
    after = velocity_reference(blown(GUSTY, share * 4.0, 0.4 + turn), there, HEIGHT, time)[:, :2]
    np.testing.assert_allclose(after, share * before @ turned.T, atol=1e-5)


def test_no_speed_is_exactly_calm() -> None:
    assert not velocity_reference(blown(GUSTY, 0.0, 2.0), POINTS, HEIGHT, 3.0).any()


def test_its_own_speed_and_heading_change_nothing() -> None:
    same = velocity_reference(blown(GUSTY, 4.0, 0.4), POINTS, HEIGHT, 3.0)
    np.testing.assert_array_equal(same, velocity_reference(GUSTY, POINTS, HEIGHT, 3.0))


def test_gusts_in_calm_air_stay_and_the_mean_is_added() -> None:
    wind = Wind(gusts=GUSTY.gusts)
    still = blown(wind, 0.0, 0.0)
    assert still.gusts == wind.gusts
    assert blown(still, 5.0, 1.0).mean == MeanWind(5.0, 1.0)
