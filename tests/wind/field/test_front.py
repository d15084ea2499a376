"""Fronts and gusts travel in m/s, whatever the step."""

import numpy as np
import pytest
from numba import config, set_num_threads

from windswept.errors import InputError
from windswept.wind.field import Cylinder, FieldPlan, Grid, Line, Uniform, start_field, step_field
from windswept.wind.field.bodies import REST
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind, profile_factor
from windswept.wind.wind import Wind

from .field_cases import FLAT, line_of_air, small_field, steady

SPEED = 6.0


def front_places(rate: float, times: tuple[float, ...], relaxation: float) -> list[float]:
    """How far a uniform flow that began at time 0 has come at some times: the middle of its steep place, m."""
    field = small_field(primitives=(Uniform((SPEED, 0.0, 0.0), start=0.0),), relaxation=relaxation)
    between = FLAT.cell[0] * (np.arange(FLAT.shape[0] - 1) + 0.5)
    places = []
    for time in times:
        for _ in range(round((time - field.time) * rate)):
            step_field(field, 1.0 / rate)
        slope = -np.diff(line_of_air(field)[:, 0].astype(np.float64))
        near = np.abs(np.arange(len(slope)) - np.argmax(slope)) < 12
        places.append(float(np.sum((between * slope)[near]) / np.sum(slope[near])))
    return places


@pytest.mark.parametrize("relaxation", [0.0, 0.25])
def test_front_speed_is_the_stated_one_at_30_60_and_144_hz(relaxation: float) -> None:
    places = np.array([front_places(rate, (3.0, 6.0), relaxation) for rate in (30.0, 60.0, 144.0)])
    speeds = (places[:, 1] - places[:, 0]) / 3.0
    np.testing.assert_allclose(speeds, SPEED, rtol=0.02)
    assert speeds.max() / speeds.min() < 1.02
    np.testing.assert_allclose(places[:, 1], 6.0 * SPEED, rtol=0.02)


def test_air_inside_is_reached_from_the_border_and_before_it_stands() -> None:
    field = small_field(primitives=(Uniform((SPEED, 0.0, 0.0), start=0.0),), relaxation=0.0)
    step_field(field, 4.0)
    air = line_of_air(field)[:, 0]
    np.testing.assert_allclose(air[:12], SPEED, rtol=0.02)
    np.testing.assert_allclose(air[40:-1], 0.0, atol=0.1)


def test_a_flow_that_ends_is_blown_out_by_the_wind() -> None:
    flow = Uniform((0.0, 2.0, 0.0), end=0.1)
    field = small_field(steady(8.0), primitives=(flow,), relaxation=0.0)
    step_field(field, 1.0)
    assert field.velocity[32, 16, 4, 1] == pytest.approx(2.0, rel=0.02)
    step_field(field, 30.0)
    # On the ground itself the air takes longer than that.
    np.testing.assert_allclose(field.velocity[:, :, 1:, 1], 0.0, atol=1e-3)


def test_a_flow_that_began_before_the_field_blows_everywhere() -> None:
    field = small_field(primitives=(Uniform((SPEED, 0.0, 0.0)),))
    step_field(field, 0.1)
    np.testing.assert_allclose(field.velocity[..., 0], SPEED, rtol=1e-6)


def test_departures_die_at_the_stated_rate() -> None:
    vortex = Line((0.0, 0.0, 0.0), vortex=20.0, core=2.0, start=0.0)
    lasting, dying = (small_field(primitives=(vortex,), relaxation=rate) for rate in (0.0, 0.5))
    for field in (lasting, dying):
        step_field(field, 2.0)
    assert np.abs(lasting.departure).max() > 0.5
    # Each of 40 steps may put what is below REST to rest.
    np.testing.assert_allclose(dying.departure, np.exp(-1.0) * lasting.departure, atol=40.0 * REST)


@pytest.mark.parametrize(("speed", "mean"), [(12.0, 4.0), (6.0, 0.0), (9.0, 9.0)])
def test_a_gusts_crest_crosses_the_meadow_at_its_own_speed(speed: float, mean: float) -> None:
    gust = Gust(
        0.0, 5.0, speed=speed, position=(-40.0, 0.0), rise_length=6.0, hold_length=0.0, decay_length=6.0
    )
    field = small_field(Wind(mean=MeanWind(mean), gusts=(gust,)))
    seen = []
    while field.time < 60.0 / speed:
        step_field(field, 1.0 / 30.0)
        seen.append(line_of_air(field, height=1)[[16, 48], 0].copy())
    first, second = np.argmax(seen, axis=0) / 30.0
    assert 32.0 / (second - first) == pytest.approx(speed, rel=0.1)


def test_calm_stays_exactly_zero() -> None:
    field = small_field()
    for _ in range(20):
        step_field(field, 1.0 / 30.0)
    assert not field.velocity.any()
    assert not field.push.any()
    assert field.clamps.total == 0


def test_wind_alone_is_what_the_profile_says() -> None:
    field = small_field(steady(5.0, 1.0))
    step_field(field, 0.2)
    speed = np.linalg.norm(field.velocity, axis=3)
    expected = 5.0 * profile_factor(field.wind.profile, FLAT.heights)
    np.testing.assert_allclose(speed, np.broadcast_to(expected, speed.shape), rtol=1e-5)


def test_the_wind_may_change_while_the_field_runs() -> None:
    field = small_field(steady(5.0))
    step_field(field, 0.1)
    field.wind = Wind()
    step_field(field, 0.1)
    assert not field.velocity.any()


@pytest.mark.parametrize("seconds", [0.0, -1.0, np.nan, np.inf])
def test_a_step_takes_time(seconds: float) -> None:
    with pytest.raises(InputError, match=r"field: seconds = .*: expected a time above 0 s"):
        step_field(small_field(), seconds)


@pytest.mark.parametrize(
    ("change", "place"),
    [
        ({"cell": (1.0, 0.0, 1.0)}, "cell"),
        ({"cell": (1.0, np.nan, 1.0)}, "cell"),
        ({"shape": (2, 8, 8)}, "shape"),
        ({"shape": (4000, 4000, 16)}, "shape"),
        ({"origin": (np.inf, 0.0)}, "origin"),
    ],
)
def test_bad_grids_say_what_is_wrong(change: dict[str, tuple[float, ...]], place: str) -> None:
    with pytest.raises(InputError, match=f"field grid: {place}"):
        Grid(**({"origin": (0.0, 0.0), "cell": (1.0, 1.0, 1.0), "shape": (8, 8, 8)} | change))  # type: ignore[arg-type]


def test_a_field_relaxes_at_no_negative_rate() -> None:
    with pytest.raises(InputError, match="field: relaxation = -1"):
        start_field(FieldPlan(FLAT, relaxation=-1.0), Wind())


def test_the_number_of_threads_changes_no_bit() -> None:
    fields = []
    for threads in (1, config.NUMBA_NUM_THREADS):
        set_num_threads(threads)
        field = small_field(steady(5.0), obstacles=(Cylinder((0.0, 0.0), 3.0, 5.0),))
        step_field(field, 1.0)
        fields.append(field.velocity)
    np.testing.assert_array_equal(*fields)
