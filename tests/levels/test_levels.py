"""Simulation levels: static force and shape kept, errors that fall with detail, states that survive a change."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import random_tree
from windswept.levels import (
    Eye,
    Ladder,
    build_ladder,
    carry_over,
    choose,
    cut_level,
    fill_registers,
    joint_motion_of,
    measure,
    simplify,
)
from windswept.levels.hierarchy import preorder
from windswept.levels.influence import REFERENCE_SPEED
from windswept.levels.static_angles import static_angles
from windswept.levels.static_shapes import STATED_WIND
from windswept.levels.training_wind import PLACEMENTS, training_wind, wind_on
from windswept.motion import Level, Model, Stepper, build_model, finest_level, pose_links, rest_state
from windswept.plants.plant import Material
from windswept.plants.weber_penn import grow


@pytest.fixture(scope="module")
def aspen() -> Ladder:
    return build_ladder(simplify(build_model(grow("quaking_aspen", 0))))


@pytest.fixture(scope="module")
def small() -> Ladder:
    material = Material(damping_ratio=0.2, youngs_modulus=1e10)
    return build_ladder(simplify(build_model(random_tree(3, material=material))))


def settled_in(model: Model, level: Level, speed: float) -> np.ndarray:
    """(L, 3) joint positions after a long steady wind."""
    stepper, state = Stepper(level), rest_state(level, 1)
    wind = np.zeros((1, len(level.probe_position), 3), np.float32)
    wind[..., 0], wind[..., 1] = 0.8 * speed, 0.6 * speed
    for _ in range(60):
        stepper.step(state, wind, wind, 40)
    return pose_links(model, level, state).position[0]


def test_every_link_is_in_one_place_of_every_level(aspen: Ladder) -> None:
    for level in aspen.levels:
        groups = -1 - level.listens[level.listens < 0]
        assert np.array_equal(level.listens[level.link], np.arange(level.link_count))
        assert set(groups.tolist()) == set(range(level.group_count))
        assert level.group_start[-1] == level.group_count
        assert (level.parent < np.arange(level.link_count)).all()


def test_nodes_are_a_tree_of_contiguous_ranges(aspen: Ladder) -> None:
    hierarchy = aspen.hierarchy
    order = preorder(hierarchy.child, hierarchy.root)
    assert sorted(order.tolist()) == list(range(len(hierarchy.first)))
    assert len(order) <= 2 * hierarchy.model.link_count - 1
    for node, (one, other) in enumerate(hierarchy.child):
        covered = int(node < hierarchy.model.link_count)
        for child in (one, other):
            if child >= 0:
                covered += hierarchy.stop[child] - hierarchy.first[child]
                assert hierarchy.error[node] >= hierarchy.error[child]
        assert covered == hierarchy.stop[node] - hierarchy.first[node]


def test_steady_wind_bends_every_level_alike(small: Ladder) -> None:
    # The static part of the motion is right by construction at the wind whose folding of leaves the shapes are
    # taken from; what is left is geometry beyond first order.
    model = small.hierarchy.model
    finest = settled_in(model, small.levels[0], REFERENCE_SPEED)
    moved = np.linalg.norm(finest - model.skeleton.base, axis=1).max()
    assert moved > 1e-3
    for level in small.levels[1:-1]:
        apart = np.linalg.norm(settled_in(model, level, REFERENCE_SPEED) - finest, axis=1).max()
        assert apart < 0.01 * moved


def test_shapes_hold_where_wind_bends_a_plant_far(aspen: Ladder) -> None:
    # At the stated wind, from a direction that no shape was fitted to.
    model = aspen.hierarchy.model
    finest = settled_in(model, aspen.levels[0], STATED_WIND)

    def error(level: Level) -> float:
        apart = settled_in(model, level, STATED_WIND) - finest
        moved = finest - model.skeleton.base
        return float(np.sqrt(np.sum(apart**2) / np.sum(moved**2)))

    assert max(error(level) for level in aspen.levels[1:-1]) < 0.02
    coarsest = aspen.levels[-2]
    assert coarsest.group_count == 1
    assert error(coarsest) < 0.012
    first_order = coarsest.shapes.copy()
    first_order[:, :, 3:] = 0.0
    assert error(replace(coarsest, shapes=first_order)) == pytest.approx(0.09, abs=0.005)


def test_steady_angles_are_those_that_motion_comes_to() -> None:
    model = build_model(random_tree(3, material=Material(damping_ratio=0.2, youngs_modulus=5e8)))
    level = finest_level(model)
    stepper, state = Stepper(level), rest_state(level, 1)
    wind = np.zeros((1, len(level.probe_position), 3), np.float32)
    wind[..., 0], wind[..., 1] = 8.0, 6.0
    for _ in range(60):
        stepper.step(state, wind, wind, 40)
    angles = static_angles(model, np.array([[8.0, 6.0, 0.0]], np.float32))[0]
    assert np.abs(angles).max() > 0.05
    assert np.abs(angles - state.angles(0)).max() < 1e-4 * np.abs(angles).max()


def test_trunk_feels_the_same_static_force_at_every_level(aspen: Ladder) -> None:
    # The trunk's lowest joint bends as the moment of the whole crown's drag.
    speed, angles = 3.0, []
    for level in aspen.levels[:-3]:
        stepper, state = Stepper(level), rest_state(level, 1)
        wind = np.zeros((1, len(level.probe_position), 3), np.float32)
        wind[..., 0] = speed
        for _ in range(80):
            stepper.step(state, wind, wind, 40)
        own, _ = joint_motion_of(aspen.hierarchy.model, level, state, 0)
        angles.append(np.linalg.norm(own[0]))
    assert np.abs(np.array(angles) / angles[0] - 1.0).max() < 0.01


def test_calm_is_still_at_every_level(aspen: Ladder) -> None:
    for level in aspen.levels:
        stepper, state = Stepper(level), rest_state(level, 1)
        calm = np.zeros((1, len(level.probe_position), 3), np.float32)
        before = pose_links(aspen.hierarchy.model, level, state).link
        stepper.step(state, calm, calm, 50)
        assert np.array_equal(pose_links(aspen.hierarchy.model, level, state).link, before)


@pytest.mark.slow
def test_merging_costs_little_accuracy(aspen: Ladder) -> None:
    measured = measure(aspen, 8.0)
    relative = measured.rms / measured.motion
    oscillators = np.array(aspen.oscillators)
    assert relative[0] == 0.0
    assert relative[oscillators < 0.35 * oscillators[0]][0] < 0.06
    assert relative[oscillators < 0.02 * oscillators[0]][0] < 0.15
    assert relative[-2] < 0.5
    assert relative[-1] == pytest.approx(1.0, abs=1e-4)


def test_a_change_to_a_finer_level_and_back_keeps_the_state(aspen: Ladder) -> None:
    coarse, fine = aspen.levels[6], aspen.levels[2]
    stepper, state = Stepper(coarse), rest_state(coarse, PLACEMENTS)
    for sample in range(60):
        wind = wind_on(coarse, training_wind(), sample / 30.0)
        stepper.step(state, wind, wind, 4)
    angles, velocities = joint_motion_of(aspen.hierarchy.model, coarse, state, 2)
    joints, groups = carry_over(aspen.hierarchy, angles, velocities, fine)
    there = rest_state(fine, 1)
    there.joints[0, :, :, 0], there.groups[0, :, :, 0] = joints, groups
    same_angles, same_velocities = joint_motion_of(aspen.hierarchy.model, fine, there, 0)
    assert np.abs(same_angles - angles).max() < 1e-3 * np.abs(angles).max()
    joints, groups = carry_over(aspen.hierarchy, same_angles, same_velocities, coarse)
    assert np.abs(groups - state.groups[0, :, :, 2]).max() < 1e-2 * np.abs(groups).max()
    assert np.array_equal(joints[:, ::2], angles[coarse.link])


def test_choice_follows_distance_and_holds_in_the_dead_band(aspen: Ladder) -> None:
    eye = Eye(np.zeros(3, np.float32), np.radians(60.0))
    border = eye.distance(np.maximum.accumulate(aspen.error))[4:5]
    level = np.zeros(1, np.int32)
    assert choose(aspen, eye, border * 0.99, level)[0] < 4
    level = choose(aspen, eye, border * 1.001, level)
    assert level[0] >= 4
    for factor in (0.99, 1.01, 0.95, 1.0, 0.92):
        assert choose(aspen, eye, border * factor, level)[0] == level[0]
    assert choose(aspen, eye, border * 0.85, level)[0] < level[0]
    assert choose(aspen, eye, np.array([1e6]), level)[0] == len(aspen.levels) - 1


def test_idle_lanes_are_filled_from_coarser_levels() -> None:
    rng = np.random.default_rng(0)
    for count in (1, 7, 8, 9, 60):
        wanted = rng.integers(0, 6, count).astype(np.int32)
        filled = fill_registers(wanted)
        assert (filled <= wanted).all()

        def registers(levels: np.ndarray) -> int:
            return int((-(-np.bincount(levels) // 8)).sum())

        assert registers(filled) <= registers(wanted)
        assert (np.sort(np.bincount(filled) % 8)[:-1] == 0).all()


@pytest.mark.slow
def test_estimated_errors_are_of_the_measured_size(aspen: Ladder) -> None:
    measured = measure(aspen, 8.0)
    middle = slice(4, len(aspen.levels) - 2)
    ratio = aspen.error[middle] / measured.p95[middle]
    assert 0.33 < ratio.min() <= ratio.max() < 3.0


def test_a_tenth_of_a_metre_at_one_pixel() -> None:
    # PHYSICS C3.12: 93.5 m at 1 px, 1080 lines, 60 degrees.
    eye = Eye(np.zeros(3, np.float32), np.radians(60.0))
    assert eye.distance(np.array([0.1]))[0] == pytest.approx(93.5, abs=0.1)


def test_zero_tolerance_is_level_zero_in_motion() -> None:
    model = build_model(random_tree(5))
    level = cut_level(simplify(model), -1.0)
    finest = finest_level(model)
    assert level.group_count == 0
    assert np.array_equal(level.link, finest.link)
    wind = np.full((1, len(finest.probe_position), 3), 4.0, np.float32)
    states = []
    for one in (level, finest):
        stepper, state = Stepper(one), rest_state(one, 1)
        states.append(stepper.step(state, wind, wind, 100).joints)
    assert np.array_equal(*states)


def test_a_plant_without_drag_has_levels_and_stands_still() -> None:
    model = build_model(random_tree(1, material=Material(leaf_drag=0.0, wood_drag=0.0)))
    ladder = build_ladder(simplify(model))
    assert len(ladder.levels) > 2
    assert all(np.isfinite(level.group_constants).all() for level in ladder.levels)
    measured = measure(ladder, 1.0)
    assert measured.largest.max() == 0.0
