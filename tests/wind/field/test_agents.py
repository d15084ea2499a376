"""Agents act where and while they are there, the same at any step, and never with what is no number."""

import math

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.wind.field import Ball, Field, Helicopter, Line, Path, Rain, Uniform, Walker, step_field
from windswept.wind.field.acts import Act, Body, Jet, Shower
from windswept.wind.field.clamps import MAX_PUSH, MAX_SPEED

from .field_cases import small_field, steady

ROLLING = Path([0.0, 4.0], [[-10.0, 0.0], [10.0, 0.0]])
BALL = Ball(ROLLING, radius=2.0)


class Acting:
    """An agent of one act that lasts for ever."""

    def __init__(self, act: Act) -> None:
        self.act = act

    def acts(self, start: float, stop: float, shape: tuple[int, int], area: float) -> list[Act]:
        return [self.act]


def run(agent: object, seconds: float, rate: float = 30.0, relaxation: float = 0.25) -> Field:
    field = small_field(relaxation=relaxation)
    for _ in range(round(seconds * rate)):
        step_field(field, 1.0 / rate, (agent,))  # type: ignore[arg-type]
    return field


def test_a_ball_presses_outward_and_down_where_it_is_and_nowhere_else() -> None:
    field = run(BALL, 2.0)
    where = np.argwhere(field.push.any(axis=3))
    x, y, z = where.T - np.array([[32.0], [16.0], [0.0]])
    assert len(where) > 10
    assert np.hypot(np.maximum(np.abs(x) - 0.2, 0.0), y).max() <= 2.0
    assert z.max() <= 4.0
    assert (field.push[..., 2] <= 0.0).all()
    assert field.push[32, 17, 1, 1] > 50.0
    assert field.push[32, 15, 1, 1] < -50.0
    assert field.push[32, 16, 1, 2] == pytest.approx(-BALL.pressure, rel=0.05)


def test_the_push_is_gone_with_the_ball_and_its_air_soon_after() -> None:
    field = run(BALL, 3.9, relaxation=2.0)
    assert field.push.any()
    assert field.velocity[..., 0].max() > 1.0
    for _ in range(6):
        step_field(field, 1.0 / 30.0, (BALL,))
    assert not field.push.any()
    assert field.velocity.any()
    step_field(field, 8.0)
    assert not field.velocity.any()


def test_a_ball_drags_air_along() -> None:
    field = run(BALL, 2.0)
    assert field.velocity[32, 16, 1, 0] == pytest.approx(5.0, rel=0.25)
    assert abs(field.velocity[32, 16 + 6, 1, 0]) < 0.2


def test_the_ball_pushes_alike_at_any_step() -> None:
    slow, fast = (run(BALL, 2.0, rate).push.sum(axis=(0, 1, 2)) for rate in (30.0, 144.0))
    assert slow[2] == pytest.approx(fast[2], rel=0.1)


def test_what_is_smaller_than_a_cell_presses_with_the_same_force() -> None:
    # The mean over where it stands in the cell; pressure falls linearly to the rim: P pi r^2 / 3 on each layer.
    forces = []
    for x, y in np.random.default_rng(0).uniform(-0.5, 0.5, (40, 2)):
        field = small_field()
        body = Body((x, y), (x, y), 0.0, 6.0, 0.3, pressure=900.0)
        step_field(field, 0.01, (Acting(body),))
        forces.append(np.linalg.norm(field.push[:, :, 2], axis=-1).sum())
    assert np.mean(forces) == pytest.approx(900.0 * math.pi * 0.3**2 / 3.0, rel=0.1)
    assert min(forces) > 0.0


def test_a_walker_stands_on_one_foot_or_both_and_lifts_the_other() -> None:
    walker = Walker(Path([0.0, 10.0], [[-7.0, 0.0], [7.0, 0.0]]))
    lifts = np.array([[walker.foot(t, side)[2] for side in (-1.0, 1.0)] for t in np.arange(1.0, 9.0, 0.02)])
    assert ((lifts == 0.0).sum(axis=1) >= 1).all()
    assert lifts.max() == pytest.approx(walker.lift, rel=0.02)
    feet = np.array([walker.foot(t, -1.0)[:2] for t in np.arange(1.0, 9.0, 0.02)])
    steps = np.diff(feet[:, 0])
    assert (steps >= -1e-9).all()
    assert (steps < 1e-9).mean() == pytest.approx(0.6, abs=0.05)
    np.testing.assert_allclose(feet[:, 1], walker.apart, atol=1e-6)


def test_a_walkers_weight_rests_on_the_soles() -> None:
    walker = Walker(ROLLING)
    soles = [
        body
        for body in walker.acts(2.0, 2.02, (9, 9), 1.0)
        if isinstance(body, Body) and body.radius == walker.foot_radius
    ]
    assert len(soles) in (1, 2)
    for sole in soles:
        assert sole.pressure * math.pi * sole.radius**2 == pytest.approx(walker.mass * 9.81)
    field = run(walker, 2.0)
    assert field.push[..., 2].min() < -100.0
    assert not run(walker, 4.2).push.any()


def test_downwash_comes_down_leaves_along_the_ground_and_ceases() -> None:
    helicopter = Helicopter(Path([0.0, 8.0], [[0.0, 0.0], [0.0, 0.0]]), mass=800.0, rotor_radius=4.0)
    field = run(helicopter, 4.0)
    assert field.velocity[32, 16, 6, 2] == pytest.approx(-helicopter.speed, rel=0.05)
    outward = field.velocity[32:, 16, 1, 0]
    assert outward[4] > 0.3 * helicopter.speed
    assert 0.0 < outward[14] < 0.5 * outward[4]
    np.testing.assert_allclose(field.velocity[32 - 4, 16, 1, 0], -outward[4], rtol=1e-3)
    assert not field.push.any()
    step_field(field, 5.0, (helicopter,))
    assert not field.velocity.any()


def test_momentum_theory_lifts_the_helicopter() -> None:
    # Thrust = mass flow x final speed = rho A (w / 2) w = weight.
    helicopter = Helicopter(ROLLING)
    thrust = 1.2 * math.pi * helicopter.rotor_radius**2 * 0.5 * helicopter.speed**2
    assert thrust == pytest.approx(helicopter.mass * 9.81)


def rain_fallen(rain: Rain, rate: float, seconds: float = 2.0) -> np.ndarray:
    """(nx, ny) momentum that rain has brought to plants which are pushed anew ``rate`` times a second, N s/m^2."""
    field, fallen = small_field(), 0.0
    for _ in range(round(seconds * rate)):
        fallen = fallen - step_field(field, 1.0 / rate, (rain,)).push[:, :, 0, 2] / rate
    return np.asarray(fallen)


@pytest.mark.parametrize("rate", [7.0, 12.0, 60.0, 144.0])
def test_the_same_drops_fall_at_any_frame_rate(rate: float) -> None:
    rain = Rain(20.0, seed=4, end=1.5)
    fallen = rain_fallen(rain, 30.0)
    assert len(np.unique(np.round(fallen / rain.drop_momentum))) > 20
    np.testing.assert_allclose(rain_fallen(rain, rate), fallen, rtol=1e-5)


def test_another_seed_is_other_rain() -> None:
    assert not np.array_equal(rain_fallen(Rain(20.0, seed=4), 30.0), rain_fallen(Rain(20.0, seed=5), 30.0))


def test_rain_presses_with_the_momentum_of_its_drops() -> None:
    # 20 mm/h is 20/3600 kg/(m^2 s), which arrives at the drops' terminal speed of 6.55 m/s.
    field = small_field()
    pressures = []
    for _ in range(30):
        step_field(field, 1.0 / 30.0, (Rain(20.0),))
        pressures.append(-field.push[..., 2].mean())
    assert np.mean(pressures) == pytest.approx(20.0 / 3600.0 * 6.55, rel=0.01)
    assert not field.push[..., :2].any()
    counts = field.push[:, :, 0, 2] / field.push[:, :, 0, 2].max()
    assert len(np.unique(counts)) > 5
    step_field(field, 0.1)
    assert not field.push.any()


def test_rain_has_its_time() -> None:
    assert not Rain(20.0, start=5.0).acts(1.0, 2.0, (4, 4), 1.0)
    assert isinstance(Rain(20.0, end=5.0).acts(1.0, 2.0, (4, 4), 1.0)[0], Shower)


BROKEN: dict[str, tuple[Act, str]] = {
    "force of 10^6": (Body((0.0, 0.0), (0.0, 0.0), 0.0, 2.0, 2.0, pressure=1e6), "pushes"),
    "endless force": (Body((0.0, 0.0), (0.0, 0.0), 0.0, 2.0, 2.0, pressure=math.inf), "lost"),
    "force that is no number": (Body((0.0, 0.0), (0.0, 0.0), 0.0, 2.0, 2.0, pressure=math.nan), "lost"),
    "place that is no number": (Body((math.nan, 0.0), (0.0, 0.0), 0.0, 2.0, 2.0, 100.0), "lost"),
    "no radius": (Body((0.0, 0.0), (0.0, 0.0), 0.0, 2.0, 0.0, 100.0), "lost"),
    "faster than sound": (Body((0.0, 0.0), (0.0, 0.0), 0.0, 2.0, 2.0, 0.0, (1e6, 0.0, 0.0)), "speeds"),
    "velocity that is no number": (
        Body((0.0, 0.0), (0.0, 0.0), 0.0, 2.0, 2.0, 0.0, (math.nan,) * 3),
        "speeds",
    ),
    "jet that is no number": (Jet((0.0, 0.0), 3.0, math.nan, 1.0), "lost"),
    "jet of 10^6": (Jet((0.0, 0.0), 3.0, 1e6, 1.0), "speeds"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_what_is_absurd_is_held_back_and_counted(name: str) -> None:
    act, counter = BROKEN[name]
    field = small_field(steady(3.0), relaxation=9.0)
    step_field(field, 0.1, (Acting(act),))
    assert getattr(field.clamps, counter) >= 2
    assert np.isfinite(field.velocity).all()
    assert np.isfinite(field.push).all()
    assert np.linalg.norm(field.velocity, axis=3).max() <= MAX_SPEED * 1.0001
    assert np.abs(field.push).max() <= MAX_PUSH
    step_field(field, 2.0)
    healed = np.broadcast_to(3.0 * field.profile, field.velocity.shape[:3])
    np.testing.assert_allclose(field.velocity[..., 0], healed, rtol=1e-4)


@pytest.mark.parametrize("primitive", [Uniform((math.nan, 0.0, 0.0)), Line((0.0, 0.0, math.inf), vortex=9.0)])
def test_primitives_that_are_no_number_are_counted_too(primitive: Uniform | Line) -> None:
    field = small_field(steady(3.0), primitives=(primitive,))
    step_field(field, 0.1)
    assert field.clamps.speeds > 0
    assert np.isfinite(field.velocity).all()


def test_a_field_written_over_with_nonsense_heals() -> None:
    field = small_field(steady(3.0))
    field.departure[20, 10, 3, :3] = math.nan, math.inf, 1e30
    step_field(field, 0.1)
    assert field.clamps.speeds > 0
    assert np.isfinite(field.velocity).all()
    assert np.isfinite(field.departure).all()


def test_wind_without_disturbance_is_never_clamped() -> None:
    field = small_field(steady(40.0), obstacles=())
    step_field(field, 1.0)
    assert field.clamps.total == 0


@pytest.mark.parametrize(
    ("times", "places"),
    [([0.0], [[0.0, 0.0]]), ([1.0, 1.0], [[0.0, 0.0], [1.0, 0.0]]), ([0.0, 1.0], [[0.0, 0.0]])],
)
def test_bad_paths_say_what_is_wrong(times: list[float], places: list[list[float]]) -> None:
    with pytest.raises(InputError, match="path: "):
        Path(times, places)
