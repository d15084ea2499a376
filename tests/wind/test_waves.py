"""Verification of the corrected and the printed sine sums (PHYSICS C1.7-9)."""

import math
from typing import Any

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.velocity import velocity_reference
from windswept.wind.waves import AS_PRINTED, Waves, WaveSchedule, WaveSet, mean_raised, wave_deviation
from windswept.wind.wind import Wind


def one_wave(**change: Any) -> Waves:
    values: dict[str, Any] = {"travel": 0.0, "push": 0.0, "wavelength": 25.0, "speed": 6.0}
    return Waves(**(values | {"amplitude": 1.0, "power": 1.0, "phase": 0.0} | change))


def along(waves: Waves, times: np.ndarray, place: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Velocity along the first wave's push at reference height, at one place over time."""
    wind = Wind(waves=WaveSchedule((WaveSet(waves),)))
    points, height = np.array([[*place, 10.0]], dtype=np.float32), np.array([10.0], dtype=np.float32)
    push = np.array([math.cos(waves.push[0]), math.sin(waves.push[0]), 0.0])
    return np.array([velocity_reference(wind, points, height, float(t))[0] @ push for t in times])


def lag_seconds(first: np.ndarray, second: np.ndarray, step: float) -> float:
    """Delay of the second series behind the first, from the peak of their cross-correlation."""
    product = np.fft.ifft(np.fft.fft(second) * np.conj(np.fft.fft(first))).real
    best = int(np.argmax(product))
    return (best if best < len(first) // 2 else best - len(first)) * step


@pytest.mark.parametrize(("form", "sign"), [("corrected", 1.0), (AS_PRINTED, -1.0)])
@pytest.mark.parametrize("power", [1.0, 3.0])
def test_crests_travel_along_the_direction(form: str, sign: float, power: float) -> None:
    azimuth, speed = 0.7, 6.0
    waves = one_wave(travel=azimuth, push=azimuth, speed=speed, wavelength=48.0, power=power, form=form)
    step = 0.01
    times = np.arange(800) * step  # exactly one period of 8 s
    ahead = (10.0 * math.cos(azimuth), 10.0 * math.sin(azimuth))
    assert lag_seconds(along(waves, times), along(waves, times, ahead), step) == pytest.approx(
        sign * 10.0 / speed, rel=0.02
    )


def test_temporal_peak_is_speed_over_wavelength() -> None:
    times = np.arange(4096) * 0.05
    spectrum = np.abs(np.fft.rfft(along(one_wave(), times)))
    frequency = np.fft.rfftfreq(len(times), 0.05)[np.argmax(spectrum)]
    assert frequency == pytest.approx(6.0 / 25.0, abs=1.0 / (len(times) * 0.05))


@pytest.mark.parametrize(("power", "fraction"), [(1, 0.50), (2, 0.36), (3, 0.30), (4, 0.26)])
def test_crests_sharpen_with_the_power(power: int, fraction: float) -> None:
    # Fraction of time above half the peak, counted from the trough (C1.9).
    series = along(one_wave(power=power), np.linspace(0.0, 25.0 / 6.0, 4000, endpoint=False))
    raised = series - series.min()
    assert np.mean(raised > 0.5 * raised.max()) == pytest.approx(fraction, abs=0.006)


@pytest.mark.parametrize("power", [1.0, 2.0, 3.0, 4.0, 1.5, 2.7])
def test_mean_is_zero_and_range_twice_the_amplitude(power: float) -> None:
    series = along(one_wave(power=power, amplitude=1.5), np.linspace(0.0, 25.0 / 6.0, 4000, endpoint=False))
    assert series.mean() == pytest.approx(0.0, abs=1e-6)
    assert np.ptp(series) == pytest.approx(3.0, rel=1e-5)
    assert series.std() == pytest.approx(1.5 * wave_deviation(power), rel=1e-5)


def test_power_one_is_the_plain_sine() -> None:
    times = np.linspace(0.0, 9.0, 200)
    expected = 1.3 * np.sin(2.0 * math.pi / 25.0 * (4.0 - 6.0 * times) + 0.4)
    np.testing.assert_allclose(
        along(one_wave(amplitude=1.3, phase=0.4), times, (4.0, 0.0)), expected, atol=1e-12
    )


def test_printed_form_has_the_papers_values() -> None:
    # k=2: range [0, 0.25], mean 0.125, twice the frequency; odd k: symmetric +-2^-k (C1.9).
    times = np.linspace(0.0, 25.0 / 6.0, 4000, endpoint=False)
    second = along(one_wave(power=2.0, form=AS_PRINTED), times)
    assert (second.min(), second.max(), second.mean()) == pytest.approx((0.0, 0.25, 0.125), abs=1e-6)
    assert np.argmax(np.abs(np.fft.rfft(second - second.mean()))) == 2
    third = along(one_wave(power=3.0, form=AS_PRINTED), times)
    assert (third.min(), third.max()) == pytest.approx((-0.125, 0.125), abs=1e-6)


def test_printed_form_refuses_real_powers() -> None:
    with pytest.raises(InputError, match="power"):
        one_wave(power=1.5, form=AS_PRINTED)


def test_mean_of_whole_and_real_powers() -> None:
    for k in range(1, 9):
        assert mean_raised(k) == pytest.approx(math.comb(2 * k, k) / 4.0**k)
    turns = np.linspace(0.0, 2.0 * math.pi, 20000, endpoint=False)
    for k in (1.3, 2.5, 3.9):
        assert mean_raised(k) == pytest.approx(np.mean(((np.sin(turns) + 1.0) / 2.0) ** k), rel=1e-6)


def test_sets_blend_without_a_jump_in_value_or_slope() -> None:
    sets = (
        WaveSet(one_wave(), end=10.0, fade=3.0),
        WaveSet(one_wave(wavelength=17.0, speed=4.0, power=2.0), start=7.0, fade=3.0),
    )
    wind = Wind(waves=WaveSchedule(sets))
    points, height = np.zeros((1, 3), np.float32), np.full(1, 10.0, np.float32)
    step = 1e-3
    times = np.arange(5.0, 12.0, step)
    series = np.array([velocity_reference(wind, points, height, float(t))[0, 0] for t in times])
    slope = np.diff(series) / step
    assert np.abs(slope).max() < 4.0
    assert np.abs(np.diff(slope)).max() < 0.02  # a jump in slope would show as a step of about 1


def test_set_without_fade_and_outside_its_time() -> None:
    sudden = WaveSet(one_wave(), start=1.0, end=2.0, fade=0.0)
    assert [sudden.weight(t) for t in (0.9, 1.0, 1.9, 2.0)] == [0.0, 1.0, 1.0, 0.0]
    soft = WaveSet(one_wave(), start=1.0, end=9.0, fade=2.0)
    assert [soft.weight(t) for t in (1.0, 2.0, 3.0, 8.0, 9.0)] == pytest.approx([0.0, 0.5, 1.0, 0.5, 0.0])


def test_plausible_waves_have_the_asked_intensity_along_and_across() -> None:
    waves = plausible_waves(6.0, 0.3, seed=4, azimuth=0.5)
    wind = Wind(waves=WaveSchedule((WaveSet(waves),)))
    rng = np.random.default_rng(0)
    points = rng.uniform(-5000.0, 5000.0, (40000, 3)).astype(np.float32)
    field = velocity_reference(wind, points, np.full(40000, 10.0, np.float32), 0.0)
    along_wind = field @ [math.cos(0.5), math.sin(0.5), 0.0]
    across_wind = field @ [-math.sin(0.5), math.cos(0.5), 0.0]
    assert along_wind.std() == pytest.approx(0.3 * 6.0, rel=0.12)  # spread of directions costs up to 10 %
    assert 0.7 < across_wind.std() / (0.3 * 6.0) < 1.1


@pytest.mark.parametrize("seed", range(4))
def test_neighbouring_trees_are_not_in_step(seed: int) -> None:
    # PHYSICS D2.13 asks 0.1-0.6 of tip motion; the wind of trees 8 m apart must leave room for that.
    wind = Wind(waves=WaveSchedule((WaveSet(plausible_waves(4.0, 0.3, seed=seed)),)))
    points = np.array([[0.0, 0.0, 0.0], [0.0, 8.0, 0.0], [8.0, 0.0, 0.0]], np.float32)
    height = np.full(3, 10.0, np.float32)
    series = np.array([velocity_reference(wind, points, height, t)[:, 0] for t in np.arange(0.0, 120.0, 0.1)])
    together = np.corrcoef(series.T)
    assert together[0, 1] < 0.75
    assert together[0, 2] < 0.6


@pytest.mark.parametrize("seed", range(4))
def test_plausible_pattern_drifts_with_the_mean_wind(seed: int) -> None:
    # PHYSICS D2.14: crests travel downwind at U_c +-10 %.
    wind = Wind(waves=WaveSchedule((WaveSet(plausible_waves(5.0, 0.3, seed=seed, azimuth=0.6)),)))
    rng = np.random.default_rng(seed)
    places = rng.uniform(-2000.0, 2000.0, (4000, 3)).astype(np.float32)
    ahead = places + np.array([10.0 * math.cos(0.6), 10.0 * math.sin(0.6), 0.0], np.float32)
    height = np.full(4000, 10.0, np.float32)
    now = velocity_reference(wind, places, height, 0.0)
    delays = np.arange(1.0, 3.0, 0.02)
    likeness = [np.sum(now * velocity_reference(wind, ahead, height, d)) for d in delays]
    assert delays[np.argmax(likeness)] == pytest.approx(10.0 / 5.0, rel=0.1)


def test_same_seed_same_waves() -> None:
    first, second, other = (plausible_waves(5.0, 0.2, seed=s) for s in (7, 7, 8))
    np.testing.assert_array_equal(first.phase, second.phase)
    assert not np.array_equal(first.phase, other.phase)
    assert np.all((first.wavelength >= 8.0) & (first.wavelength <= 80.0))


def test_no_mean_no_plausible_waves() -> None:
    assert not plausible_waves(0.0, 0.3, seed=1).amplitude.any()


@pytest.mark.parametrize(
    ("change", "place"),
    [
        ({"wavelength": 0.0}, "wavelength"),
        ({"power": 0.5}, "power"),
        ({"amplitude": math.nan}, "amplitude"),
        ({"speed": [1.0, 2.0]}, "speed"),
        ({"form": "printed"}, "form"),
    ],
)
def test_bad_waves_say_what_is_wrong(change: dict[str, Any], place: str) -> None:
    with pytest.raises(InputError, match=place):
        one_wave(**change)


@pytest.mark.parametrize(("change", "place"), [({"fade": -1.0}, "fade"), ({"start": 3.0, "end": 3.0}, "end")])
def test_bad_sets_say_what_is_wrong(change: dict[str, float], place: str) -> None:
    with pytest.raises(InputError, match=place):
        WaveSet(one_wave(), **change)
