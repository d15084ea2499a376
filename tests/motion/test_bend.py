"""`bend`: closed forms, what must hold in any wind, and the kernel against the plain formulas."""

from __future__ import annotations

import math
from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from handmade import random_tree
from windswept.motion.bend import ALONE, Bender, bend_legs, turned_by
from windswept.motion.bend_branches import Branches, BranchPose, place_branches
from windswept.motion.bend_plain import (
    WEIGHTS,
    attachment_gap,
    bend,
    bend_factor,
    curve_frame,
    step_lagged,
    step_ordered,
)
from windswept.motion.bend_plant import plant_branches
from windswept.motion.lanes import WIDTH
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.waves import Waves, WaveSchedule, WaveSet
from windswept.wind.wind import Wind, calm

STRAIGHT = np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, 1 / 3], [0.0, 0.0, 2 / 3], [0.0, 0.0, 1.0]]])
STEP = 1.0 / 60.0
FACTORS = st.tuples(*[st.floats(-50.0, 50.0)] * 3)


def gusty(speed: float = 8.0) -> Wind:
    waves = WaveSchedule((WaveSet(plausible_waves(speed, 0.4, 3, 0.4), end=6.0), WaveSet(OTHER, start=4.0)))
    return Wind(mean=MeanWind(speed, 0.4), waves=waves, gusts=(Gust(2.0, 5.0, 0.3),))


OTHER = Waves([0.1, 2.0], [0.2, 1.0], [20.0, 31.0], [5.0, 7.0], [2.0, 1.5], [1.7, 2.0], [0.3, 4.0])


def pliant(seed: int) -> Branches:
    """A handmade tree that a breeze bends as far as `bend` is good for."""
    stiff = plant_branches(random_tree(seed))
    return replace(stiff, flexibility=40.0 * stiff.flexibility)


@pytest.fixture(scope="module")
def branches() -> Branches:
    kinds = [pliant(seed) for seed in (4, 7)]
    position = np.array([(0, 0, 0), (30, 5, 1), (-20, 9, 0)], np.float32)
    return place_branches(kinds, np.array([0, 1, 0]), position, np.array([0.0, 1.0, 4.0]))


def tall(branches: Branches) -> float:
    return float(branches.tip[:, 2].max())


def curve(points: np.ndarray, t: np.ndarray) -> np.ndarray:
    s = 1.0 - t
    return np.stack([s**3, 3 * s * s * t, 3 * s * t * t, t**3], axis=1) @ points


@pytest.mark.parametrize("kinds", [0, 1])
def test_nothing_placed_is_no_branches(kinds: int) -> None:
    none = place_branches(
        [pliant(4)][:kinds], np.zeros(0, np.int32), np.zeros((0, 3), np.float32), np.zeros(0, np.float32)
    )
    assert (none.branch_count, none.level_count) == (0, 0)
    some = pliant(4)
    for field in fields(Branches):
        ours, theirs = getattr(none, field.name), getattr(some, field.name)
        assert (ours.dtype, ours.shape[1:]) == (theirs.dtype, theirs.shape[1:])
    bender = Bender(none)
    state = bender.rest()
    for step in (bender.step_lagged, bender.step_ordered):
        assert bender.pose(step(state, gusty(), 1.0)).points.shape == (0, 4, 3)
    plain = step_ordered(none, bend_factor(none, gusty(), 1.0), WEIGHTS["beam"])
    assert step_lagged(none, plain, np.zeros((0, 3)), WEIGHTS["beam"]).points.shape == (0, 4, 3)
    assert attachment_gap(none, plain).shape == (0,)


def test_still_air_gives_the_rest_pose_bit_by_bit(branches: Branches) -> None:
    bender = Bender(branches)
    rest = bender.rest()
    expected = rest.now.copy()
    for step in (bender.step_lagged, bender.step_ordered):
        for time in (0.0, 1.0, 2.0):
            assert_array_equal(step(rest, calm(), time).now, expected)


@settings(deadline=None)  # the first call compiles
@given(st.tuples(*[st.floats(-1.0, 1.0)] * 6), st.sampled_from(list(WEIGHTS)))
def test_no_force_adds_exactly_nothing(legs: tuple[float, ...], weights: str) -> None:
    second, third = np.float32(legs[:3]), np.float32(legs[3:])
    first, more = WEIGHTS[weights]
    zero = (np.float32(0.0),) * 3
    assert bend_legs(tuple(second), tuple(third), zero, (first, more - first)) == (zero, zero)


@given(FACTORS, st.sampled_from(list(WEIGHTS)))
def test_legs_keep_their_length(b: tuple[float, ...], weights: str) -> None:
    points = np.array([[[0.0, 0, 0], [0.1, 0, 0.4], [0.4, 0.1, 0.7], [0.3, 0.4, 0.9]]])
    bent = bend(points, np.array([b]), WEIGHTS[weights])
    before, after = (np.linalg.norm(np.diff(p, axis=1), axis=2) for p in (points, bent))
    assert_allclose(after, before, rtol=1e-12)


def test_a_branch_in_the_face_of_the_wind_keeps_its_length() -> None:
    a = (np.float32(1.0), np.float32(0.0), np.float32(0.0))
    for size in (0.5, 1.0, 1.0001, 80.0):
        turned = turned_by(a, (np.float32(-size), np.float32(0.0), np.float32(0.0)))
        assert_allclose(np.linalg.norm(np.add(a, turned)), 1.0, atol=1e-6)


def test_small_forces_bend_linearly_and_like_a_tip_loaded_beam() -> None:
    t = np.linspace(0.0, 1.0, 41)
    for size in (1e-5, 1e-4):
        bent = curve(bend(STRAIGHT, np.array([[size, 0.0, 0.0]]), WEIGHTS["beam"])[0], t)
        deflection = 2.0 / 3.0 * size
        beam = deflection * bent[:, 2] ** 2 * (3.0 - bent[:, 2]) / 2.0
        assert_allclose(bent[:, 0] / deflection, beam / deflection, atol=1e-6)


@pytest.mark.parametrize(("degrees", "change"), [(15.0, -0.0046), (30.0, -0.0181), (45.0, -0.0402)])
def test_with_legs_kept_the_curve_shortens_by_a_known_share(degrees: float, change: float) -> None:
    # The legs are the control polygon; the curve cuts its corner: by 2 % at 31 degrees, 4 % at 45.
    t = np.linspace(0.0, 1.0, 2001)
    b = math.tan(math.radians(degrees))
    bent = curve(bend(STRAIGHT, np.array([[b, 0.0, 0.0]]), WEIGHTS["beam"])[0], t)
    length = np.linalg.norm(np.diff(bent, axis=0), axis=1).sum()
    assert length - 1.0 == pytest.approx(change, abs=1e-4)


@pytest.mark.parametrize("degrees", [1.0, 15.0, 33.0])
def test_curvature_falls_from_base_to_tip_but_not_as_printed(degrees: float) -> None:
    # Beyond acos(5/6) = 33.6 degrees the slope of curvature at the base, (4 (1 - cos) - 2/3) sin, turns positive.
    t = np.linspace(0.0, 1.0, 201)
    falls = {}
    for name, weights in WEIGHTS.items():
        b = np.array([[math.tan(math.radians(degrees)), 0.0, 0.0]])
        legs = np.diff(bend(STRAIGHT, b, weights)[0], axis=0)
        square = np.stack([(1 - t) ** 2, 2 * t * (1 - t), t * t], axis=1)
        first, second = 3.0 * square @ legs, 6.0 * np.stack([1 - t, t], axis=1) @ np.diff(legs, axis=0)
        curvature = np.linalg.norm(np.cross(first, second), axis=1) / np.linalg.norm(first, axis=1) ** 3
        falls[name] = bool(np.all(np.diff(curvature) < 0.0))
    assert falls == {"beam": True, "as_printed": False}


@pytest.mark.parametrize(
    ("load", "aside", "down", "tolerance"),
    [(0.25, 0.08275, 0.00412, 0.003), (1.0, 0.30172, 0.05643, 0.015), (2.0, 0.49346, 0.16064, 0.04)],
)
def test_large_deflection_stays_near_the_elastica(
    load: float, aside: float, down: float, tolerance: float
) -> None:
    # PHYSICS B3: P L^2 / EI = load; small deflections are load / 3 = 2 b / 3 of the length.
    tip = bend(STRAIGHT, np.array([[0.5 * load, 0.0, 0.0]]), WEIGHTS["beam"])[0, 3]
    assert_allclose([tip[0], 1.0 - tip[2]], [aside, down], atol=tolerance)


def run(branches: Branches, mode: str, weights: str, seconds: float) -> tuple[float, BranchPose]:
    """Largest distance between kernel and plain formulas over a run, and the kernel's last pose."""
    bender, worst = Bender(branches, weights), 0.0
    state, wind = bender.rest(), gusty()
    plain = step_ordered(branches, np.zeros((branches.branch_count, 3)), WEIGHTS[weights])
    for time in np.arange(0.0, seconds, 4 * STEP):
        b = bend_factor(branches, wind, time)
        if mode == "lagged":
            bender.step_lagged(state, wind, time)
            plain = step_lagged(branches, plain, b, WEIGHTS[weights])
        else:
            bender.step_ordered(state, wind, time)
            plain = step_ordered(branches, b, WEIGHTS[weights])
        pose = bender.pose(state)
        worst = max(worst, float(np.abs(pose.points - plain.points).max()))
        assert_allclose(pose.side, plain.side, atol=1e-5)
    return worst, pose


@pytest.mark.parametrize("mode", ["lagged", "ordered"])
@pytest.mark.parametrize("weights", list(WEIGHTS))
def test_the_kernel_equals_the_plain_formulas(branches: Branches, mode: str, weights: str) -> None:
    worst, pose = run(branches, mode, weights, 10.0)
    moved = np.abs(pose.points - Bender(branches).pose(Bender(branches).rest()).points).max()
    assert moved > 0.05 * tall(branches)
    assert worst < 1e-5 * tall(branches)


def test_children_keep_their_angle_on_the_parent(branches: Branches) -> None:
    _, pose = run(branches, "ordered", "beam", 5.0)
    child = np.flatnonzero(branches.parent >= 0)
    parent = branches.parent[child]
    _, frame = curve_frame(
        pose.points[parent].astype(np.float64), pose.side[parent], branches.attach[child].astype(np.float64)
    )
    leg = np.einsum("nij,nj->ni", frame, pose.points[child, 1] - pose.points[child, 0])
    length = np.linalg.norm(branches.legs[child, 0], axis=1, keepdims=True)
    assert_allclose(leg / length, branches.legs[child, 0] / length, atol=2e-5)


def test_ordered_branches_grow_out_of_their_parents_without_a_gap(branches: Branches) -> None:
    _, pose = run(branches, "ordered", "beam", 3.0)
    assert attachment_gap(branches, pose).max() < 1e-5


def test_lagged_gaps_are_bounded_by_what_parents_move_in_a_step(branches: Branches) -> None:
    bender, wind = Bender(branches), gusty()
    state = bender.rest()
    before = bender.pose(state)
    largest_gap = 0.0
    for number in range(120):
        now = bender.pose(bender.step_lagged(state, wind, number * STEP))
        moved = np.linalg.norm(now.points - before.points, axis=2).max(axis=1)
        bound = np.where(branches.parent >= 0, moved[branches.parent], 0.0)
        gap = attachment_gap(branches, now)
        assert np.all(gap <= bound + 1e-5)
        # The first steps jump from still air into the wind.
        largest_gap = max(largest_gap, float(gap.max())) if number > 3 else 0.0
        before = now
    assert 1e-4 < largest_gap < 0.1


def test_lag_is_one_step_a_level_and_gone_once_the_wind_is_steady(branches: Branches) -> None:
    bender, steady = Bender(branches), Wind(mean=MeanWind(7.0, 1.0))
    ordered = bender.step_ordered(bender.rest(), steady, 0.0).now
    state = bender.rest()
    for _ in range(branches.level_count - 1):
        bender.step_lagged(state, steady, 0.0)
    assert np.abs(state.now - ordered).max() > 1e-3
    assert_array_equal(bender.step_lagged(state, steady, 0.0).now, ordered)


def test_waves_travel_along_their_direction() -> None:
    kind, speed, apart = pliant(4), 5.0, 10.0
    azimuth = 0.7
    along = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    pair = place_branches(
        [kind], np.zeros(2, int), np.array([0.0 * along, apart * along], np.float32), np.zeros(2)
    )
    wave = Waves([azimuth], [azimuth], [40.0], [speed], [3.0], [2.0], [0.0])
    wind = Wind(mean=MeanWind(4.0, azimuth), waves=WaveSchedule((WaveSet(wave),)))
    bender = Bender(pair)
    state, tips = bender.rest(), []
    times = np.arange(0.0, 24.0, 0.05)
    for time in times:
        pose = bender.pose(bender.step_ordered(state, wind, time))
        tips.append(pose.points[:2, 3] @ along)  # the two trunks are the first level
    near, far = (np.array(tips) - np.mean(tips, axis=0)).T
    lags = np.arange(-80, 81)
    match = [np.sum(near[80:-80] * np.roll(far, -lag)[80:-80]) for lag in lags]
    assert lags[int(np.argmax(match))] * 0.05 == pytest.approx(apart / speed, abs=0.05)


def test_waves_blend_without_a_pop(branches: Branches) -> None:
    def largest_step(step: float) -> tuple[float, float]:
        """Largest motion in one step around the blend from 3.5 s to 6.5 s, and after it."""
        bender, wind = Bender(branches), gusty()
        state, moved, last = bender.rest(), [], None
        times = np.arange(3.5, 9.5, step)
        for time in times:
            now = bender.pose(bender.step_ordered(state, wind, time)).points
            if last is not None:
                moved.append(np.abs(now - last).max())
            last = now
        return max(m for m, t in zip(moved, times, strict=False) if t < 6.5), max(moved)

    blend, whole = largest_step(1.0 / 30.0)
    finer, _ = largest_step(1.0 / 60.0)
    assert whole < 0.1 * tall(branches)
    # A pop stays as high however short the step is; smooth motion halves with it.
    assert finer < 0.6 * blend


def test_far_plants_bend_as_near_ones() -> None:
    kind = pliant(4)
    far = place_branches([kind], np.zeros(1, int), np.array([[5000.0, 0.0, 0.0]], np.float32), np.zeros(1))
    near = place_branches([kind], np.zeros(1, int), np.zeros((1, 3), np.float32), np.zeros(1))
    steady = Wind(mean=MeanWind(7.0, 1.0))
    poses = [b.pose(b.step_ordered(b.rest(), steady, 0.0)).points for b in (Bender(far), Bender(near))]
    assert_array_equal(*poses)


def test_threads_share_the_work_of_a_wood() -> None:
    count = 1 + ALONE * WIDTH // pliant(4).branch_count
    position = np.random.default_rng(0).uniform(-90.0, 90.0, (count, 3)).astype(np.float32)
    wood = place_branches([pliant(4)], np.zeros(count, int), position, np.linspace(0.0, 6.0, count))
    assert wood.branch_count > ALONE * WIDTH
    bender, wind = Bender(wood), gusty()
    state = bender.rest()
    before = bender.pose(state)
    now = bender.pose(bender.step_lagged(state, wind, 3.0))
    expected = step_lagged(wood, before, bend_factor(wood, wind, 3.0), WEIGHTS["beam"])
    assert np.abs(now.points - before.points).max() > 0.05 * tall(wood)
    assert_allclose(now.points, expected.points, atol=1e-5 * tall(wood))
