"""The motion of blades: the constraint law, drag, rest, breaking, and forces that cannot be meant."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from windswept.motion.blades.blades import Blades, place_blades, rest_blades
from windswept.motion.blades.constraint import constraint_step
from windswept.motion.blades.field import pack_field
from windswept.motion.blades.kind import BladeKind, build_kind, frequencies
from windswept.motion.blades.lean import lean_of_load
from windswept.motion.blades.pose_blades import pose_blades
from windswept.motion.blades.rest_shape import rest_shape
from windswept.motion.blades.step_blades import step_in_field, step_in_given
from windswept.motion.blades.step_plain import PlainState, drag_of_air, rest_lean, sample_plain, step_plain
from windswept.motion.model import TIME_STEP
from windswept.plants.underbrush.grow_tuft import GROUND, tilted_frames

from .conftest import COARSE, component, uniform


def meadow(kind: BladeKind, count: int = 21, seed: int = 0) -> Blades:
    rng = np.random.default_rng(seed)
    base = np.zeros((count, 3))
    base[:, :2] = rng.uniform(0.0, 6.0, (count, 2))
    frame = tilted_frames(rng.uniform(0.05, 0.7, count), rng.uniform(0.0, 6.3, count)) @ GROUND
    return place_blades(kind, base, frame, rng.uniform(0.7, 1.3, count))


def air(count: int, *velocity: float) -> np.ndarray:
    return np.tile(np.array(velocity, np.float32), (count, 1))


@pytest.mark.parametrize(("time", "left"), [(1.0, 0.736), (4.744, 0.05), (6.638, 0.01), (9.233, 0.001)])
@pytest.mark.parametrize("substeps", [1, 7, 40])
def test_settling_times_of_the_critical_law(time: float, left: float, substeps: int) -> None:
    tau = 0.13
    xx, xv, vx, vv = constraint_step(np.array([1.0 / tau]), 1.0, time * tau / substeps)[0]
    deviation, rate = 1.0, 0.0
    for _ in range(substeps):
        deviation, rate = xx * deviation + xv * rate, vx * deviation + vv * rate
    assert deviation == pytest.approx(left, rel=2e-3)


def test_general_damping_overshoots_as_it_should() -> None:
    zeta, omega = 0.15, 9.0
    half_period = np.pi / (omega * np.sqrt(1.0 - zeta**2))
    xx = constraint_step(np.array([omega]), zeta, half_period)[0, 0]
    assert -xx == pytest.approx(np.exp(-np.pi * zeta / np.sqrt(1.0 - zeta**2)))


def test_frequency_is_the_cantilevers() -> None:
    # omega = 1.8751^2 sqrt(EI / m L^4) (PHYSICS B2); to the side it grows with the root of the stiffness.
    flat, side = frequencies(uniform(24, weight=1.0, side_ratio=9.0))
    assert flat == pytest.approx(1.8751**2, rel=0.005)
    assert side == pytest.approx(3.0 * flat)


def test_drag_of_the_reed_goes_from_the_square_of_speed_to_speed(reed: BladeKind) -> None:
    # Speck 2003: squared up to 1 m/s, linear from 1.5 to 10 m/s.
    def exponent(slow: float, fast: float) -> float:
        speed = np.geomspace(slow, fast, 20)
        force = [np.linalg.norm(drag_of_air(reed, np.array([0.0, u, 0.0]))) for u in speed]
        return float(np.polyfit(np.log(speed), np.log(force), 1)[0])

    assert exponent(0.05, 1.0) == pytest.approx(2.0, abs=0.1)
    assert exponent(1.5, 10.0) == pytest.approx(1.0, abs=0.16)


@pytest.mark.parametrize("tau", [None, 0.2])
def test_kernel_equals_plain_formulas(grass: BladeKind, tau: float | None) -> None:
    kind = grass if tau is None else replace(grass, frequency=np.full(2, 1.0 / tau), damping_ratio=1.0)
    kind = replace(kind, breaking_lean=0.45)
    blades, count = meadow(kind), 21
    state, frame, size = rest_blades(blades), blades.frame.astype(float), blades.size.astype(float)
    plain = PlainState(np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count, bool))
    rng = np.random.default_rng(1)
    for _ in range(80):
        velocity = rng.normal((3.0, 0.0, 0.0), 2.0, (count, 3)).astype(np.float32)
        push = rng.normal(0.0, 1.0, (count, 3)).astype(np.float32)
        step_in_given(blades, state, velocity, push)
        plain = step_plain(kind, frame, size, plain, velocity, push, TIME_STEP)
    assert np.abs(plain.lean).max() > 0.1
    np.testing.assert_array_equal(state.broken, plain.broken)
    assert 0 < plain.broken.sum() < count
    np.testing.assert_allclose(state.lean, plain.lean, atol=2e-5)
    np.testing.assert_allclose(state.rate, plain.rate, atol=1e-3)


def test_the_field_is_sampled_trilinearly(grass: BladeKind) -> None:
    rng = np.random.default_rng(2)
    velocity = rng.normal(0.0, 3.0, (7, 9, 4, 3)).astype(np.float32)
    push = rng.normal(0.0, 1.0, (7, 9, 4, 3)).astype(np.float32)
    field = pack_field(velocity, push, (1.0, -0.5), (0.7, 0.6, 0.1))
    blades = meadow(grass, 30)
    place = blades.constants[:, :3].transpose(0, 2, 1).reshape(-1, 3)[:30]
    in_field = step_in_field(blades, rest_blades(blades), field)
    given = step_in_given(
        blades, rest_blades(blades), *(a.astype(np.float32) for a in sample_plain(field, place))
    )
    assert np.abs(given.lean).max() > 1e-3
    np.testing.assert_allclose(in_field.lean, given.lean, atol=1e-6)
    # Some blades stand beyond the grid: there the field is as on its border.
    assert (place[:, 0] < 1.0).any()
    assert (place[:, 0] > 1.0 + 6 * 0.7).any()


@pytest.mark.parametrize("speed", [0.5, 3.0, 12.0, 40.0])
def test_a_steady_wind_brings_every_blade_to_rest_at_its_equilibrium(grass: BladeKind, speed: float) -> None:
    kind = replace(grass, breaking_lean=np.inf)
    blades, count = meadow(kind), 21
    state = step_in_given(blades, rest_blades(blades), air(count, speed, 0.0, 0.0), None, 120 * 30)
    frame, size = blades.frame.astype(float), blades.size.astype(float)
    force = drag_of_air(kind, np.einsum("bij,j->bi", frame, [speed, 0.0, 0.0])) * size[:, None] ** -1.5
    load = force - kind.weight * frame[:, :, 2]
    np.testing.assert_allclose(rest_lean(kind, frame) + state.lean, lean_of_load(load), atol=3e-5)
    assert np.abs(state.rate).max() < 1e-3
    tip = pose_blades(blades, state).tip
    misses = []
    for b in range(count):
        shape = rest_shape(kind.chain, kind.force_scale * load[b]).joint[-1]
        misses.append(np.linalg.norm(blades.base[b] + size[b] * shape @ frame[b] - tip[b]) / size[b])
    # The table's own bins are left: see test_pose_table.py.
    assert np.median(misses) < 0.005 * kind.chain.whole_length


def test_without_force_every_blade_returns_to_rest_exactly(grass: BladeKind) -> None:
    blades = meadow(grass)
    state = rest_blades(blades)
    at_rest = pose_blades(blades, state)
    calm = air(blades.count, 0.0, 0.0, 0.0)
    step_in_given(blades, state, calm, None, 50)
    assert not state.lanes.any()
    step_in_given(blades, state, air(blades.count, 4.0, 2.0, -1.0), None, 200)
    assert np.abs(state.lean).max() > 0.05
    step_in_given(blades, state, calm, None, 120 * 60)
    assert not state.lanes.any()
    np.testing.assert_array_equal(pose_blades(blades, state).joint, at_rest.joint)


def test_gusts_do_not_feed_the_motion(grass: BladeKind) -> None:
    kind = replace(grass, breaking_lean=np.inf)
    blades = meadow(kind, 8)
    state, rng = rest_blades(blades), np.random.default_rng(3)
    for _ in range(400):
        gust = air(8, *rng.normal(0.0, 25.0, 3))
        step_in_given(blades, state, gust, None, 6)
        whole = rest_lean(kind, blades.frame) + state.lean
        assert np.linalg.norm(whole, axis=1).max() < 1.0 + 1e-5
    step_in_given(blades, state, air(8, 40.0, 0.0, 0.0), None, 120 * 20)
    assert np.abs(state.rate).max() < 1e-3


@pytest.mark.parametrize("turn", [0.9, 1.1, 1.3])
def test_a_swing_too_fast_for_the_steps_settles_in_the_wind(grass: BladeKind, turn: float) -> None:
    # Near half a turn in a step and beyond it, the velocity that a step begins with says nothing of the swing.
    frequency = np.array([turn, 1.5 * turn]) * np.pi / TIME_STEP
    kind = replace(
        grass, frequency=frequency, damping_ratio=0.02, drag=0.01, weight=0.0, breaking_lean=np.inf
    )
    blades, count = meadow(kind), 21
    state, frame, size = rest_blades(blades), blades.frame.astype(float), blades.size.astype(float)
    plain = PlainState(np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count, bool))
    velocity = air(count, 5.0, 1.5, 0.0)
    for _ in range(40):
        step_in_given(blades, state, velocity)
        plain = step_plain(kind, frame, size, plain, velocity, np.zeros((count, 3)), TIME_STEP)
    np.testing.assert_allclose(state.lean, plain.lean, atol=2e-5)
    step_in_given(blades, state, velocity, None, 600)
    force = drag_of_air(kind, np.einsum("bij,bj->bi", frame, velocity)) * size[:, None] ** -1.5
    np.testing.assert_allclose(state.lean, lean_of_load(force), atol=2e-6)


def test_air_damps_a_swing(grass: BladeKind) -> None:
    # y'' + omega^2 y = -c |y'| y' swings less and less: 1 / amplitude grows by 4 c omega / (3 pi) a second.
    kind = replace(grass, damping_ratio=0.0, weight=0.0, drag_share=np.array([1.0, 1.0, 1.0]))
    blades = place_blades(kind, np.zeros((1, 3)), GROUND[None], np.ones(1))
    state, start, seconds = rest_blades(blades), 0.2, 3.0
    state.lanes[:, 1] = start
    step_in_given(blades, state, air(1, 0.0, 0.0, 0.0), None, int(seconds / TIME_STEP))
    omega = kind.frequency[0]
    amplitude = np.hypot(state.lean[0, 1], state.rate[0, 1] / omega)
    c = omega**2 * kind.drag * kind.reach[0] ** 2
    expected = 1.0 / (1.0 / start + 4.0 * c * omega / (3.0 * np.pi) * seconds)
    assert expected < 0.8 * start
    assert amplitude == pytest.approx(expected, rel=0.05)


def test_a_broken_blade_stays_broken() -> None:
    kind = build_kind(component("white_clover", "petiole"), COARSE)
    assert kind.breaking_lean < 1.0
    assert kind.broken_scale < 0.5
    blades = meadow(kind)
    state = step_in_given(blades, rest_blades(blades), air(21, 3.0, 0.0, 0.0), None, 60)
    assert not state.broken.any()
    step_in_given(
        blades, state, air(21, 0.0, 0.0, 0.0), np.tile(np.float32([900.0, 0.0, -300.0]), (21, 1)), 60
    )
    assert state.broken.all()
    step_in_given(blades, state, air(21, 0.0, 0.0, 0.0), None, 120 * 30)
    assert state.broken.all()
    whole = pose_blades(blades).tip[:, 2]
    assert (pose_blades(blades, state).tip[:, 2] < whole - 0.1 * kind.chain.whole_length).all()


def test_the_same_at_any_frame_rate(grass: BladeKind) -> None:
    blades = meadow(grass, 17)
    rng = np.random.default_rng(4)
    field = pack_field(
        rng.normal(0.0, 3.0, (5, 5, 3, 3)).astype(np.float32), None, (0.0, 0.0), (1.5, 1.5, 0.2)
    )
    ends = []
    for rate in (30, 60, 144):
        state = rest_blades(blades)
        for frame in range(1, rate + 1):
            due = int(np.floor(frame / rate / TIME_STEP + 1e-6))
            step_in_field(blades, state, field, due - state.step_count)
        ends.append(state.lanes.tobytes())
        assert state.step_count == 120
    assert ends[0] == ends[1] == ends[2]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_no_number_counts_as_no_force_and_is_counted(grass: BladeKind, bad: float) -> None:
    blades = meadow(grass, 19)
    wind = air(19, 0.0, 0.0, 0.0)
    wind[[2, 18]] = (bad, 1.0, 0.0)
    push = np.zeros((19, 3), np.float32)
    push[7, 2] = bad
    state = step_in_given(blades, rest_blades(blades), wind, push, 3)
    assert state.clamped_count == 3
    assert not state.lanes.any()


def test_a_force_of_a_million_newtons_is_shortened_and_counted(grass: BladeKind) -> None:
    blades = meadow(grass, 19)
    push = np.zeros((19, 3), np.float32)
    push[5, 0] = 1e6 / blades.kind.chain.area.sum()
    state = step_in_given(blades, rest_blades(blades), air(19, 0.0, 0.0, 0.0), push, 120)
    assert state.clamped_count == 1
    assert np.isfinite(state.lanes).all()
    assert np.isfinite(pose_blades(blades, state).joint).all()
    assert state.broken[5]
    assert not state.lean[np.arange(19) != 5].any()


def test_a_field_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="2 or more along each axis"):
        pack_field(np.zeros((4, 1, 4, 3), np.float32), None, (0.0, 0.0), (1.0, 1.0, 1.0))


def test_no_air_breaks_the_numbers(grass: BladeKind) -> None:
    blades = meadow(grass, 64)
    state, rng = rest_blades(blades), np.random.default_rng(6)
    strange = np.float32([0.0, 1e-30, 1e-3, 30.0, 1e4, 1e10, 1e19, 3e38, np.nan, np.inf])
    for _ in range(60):
        velocity = rng.choice(strange, (64, 3)) * rng.choice([-1, 1], (64, 3)).astype(np.float32)
        push = rng.choice(strange, (64, 3)) * rng.choice([-1, 1], (64, 3)).astype(np.float32)
        step_in_given(blades, state, velocity, push)
        assert np.isfinite(state.lanes).all()
        assert np.isfinite(pose_blades(blades, state).joint).all()
    assert state.clamped_count > 0
