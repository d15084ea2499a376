"""`multibody` as the ladder's first rung: plants come to it and leave it with the motion they have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import random_tree
from windswept.levels import (
    Eye,
    build_ladder,
    carry_over,
    joint_motion_of,
    measure,
    measured_ladder,
    simplify,
)
from windswept.levels.measure import with_measured_errors
from windswept.levels.training_wind import PLACEMENTS, training_air
from windswept.motion import Model, Stepper, build_model, finest_level, pose_links, rest_state
from windswept.motion.multibody import CoupledState, MultibodyStepper, coupled, coupled_rest
from windswept.plants.plant import Material, Plant
from windswept.plants.weber_penn import grow
from windswept.scene.level_set import LevelSet
from windswept.scene.load_scene import load_scene
from windswept.scene.scene import Placements, PlantKind, Scene
from windswept.scene.simulation import Simulation

HEIGHT, FOV = 1080, float(np.radians(60.0))


@pytest.fixture(scope="module")
def hazels() -> tuple[Scene, list[Plant]]:
    """Three hazels in a row away from the camera, in a turbulent breeze without gusts."""
    position = np.array([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0], [-3.0, 8.0, 0.0]], np.float32)
    scene = load_scene("hazel")
    scene = replace(
        scene,
        wind=replace(scene.wind, gusts=()),
        kinds=(PlantKind("hazel", 0),),
        placements=(Placements(position, np.array([0.0, 1.0, 2.0], np.float32)),),
    )
    return scene, [grow("hazel", 0)]


def swayed(model: Model, steps: int) -> CoupledState:
    """One plant after so many steps in the training wind."""
    level, air = finest_level(model), training_air()
    stepper, state = MultibodyStepper(model), coupled_rest(model, 1)
    for step in range(steps):
        wind = air(level, 2.0 + step * model.time_step)[:1]
        stepper.step(state, wind, wind)
    return state


def tips(model: Model, simulation: Simulation) -> np.ndarray:
    """(P, n, 3) far ends of all stems in the plants' frames, m."""
    last = np.append(model.skeleton.stem_first_link[1:], model.link_count) - 1
    vector = model.skeleton.vector[last]
    pose = simulation.pose[0]
    q = pose.rotation[:, last].astype(float)
    t = 2.0 * np.cross(q[..., :3], vector)
    return pose.position[:, last] + vector + q[..., 3:] * t + np.cross(q[..., :3], t)


def there_and_back(
    hazels: tuple[Scene, list[Plant]], levels: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Tips (frames, P, n, 3), pixel sizes and whether coupled (frames, P), flying away and coming back."""
    scene, plants = hazels
    simulation = Simulation(scene, plants, levels=levels, multibody=True)
    kind = simulation.kinds[0]
    assert kind.sets[0].level.coupled
    track, pixels, joined = [], [], []
    for frame in range(300):
        away = 6.0 + 17.0 * (1.0 - np.cos(2.0 * np.pi * frame / 300.0))
        simulation.eye = Eye(np.array([0.0, -away, 3.0], np.float32), FOV, HEIGHT)
        simulation.advance(1.0 / 60.0)
        track.append(tips(kind.model, simulation))
        distance = np.linalg.norm(kind.placements.position - simulation.eye.position, axis=1)
        pixels.append(simulation.eye.metres(distance))
        joined.append([kind.sets[rung].level.coupled for rung in kind.at])
    return np.array(track), np.array(pixels), np.array(joined)


def test_no_leaf_jumps_between_multibody_and_springs(hazels: tuple[Scene, list[Plant]]) -> None:
    # PHYSICS D2.2: the second difference of every tip less the same under `multibody` throughout, in pixels.
    with_levels, pixels, joined = there_and_back(hazels, True)
    without, _, _ = there_and_back(hazels, False)
    before, after = joined[:-1], joined[1:]
    assert (before & ~after).any(axis=0).all()
    assert (~before & after).any(axis=0).all()
    assert not np.array_equal(with_levels[-60], without[-60])
    jump = np.linalg.norm(np.diff(with_levels - without, n=2, axis=0), axis=-1) / pixels[1:-1, :, None]
    changing = np.zeros(len(joined), bool)
    for frame in np.flatnonzero((before != after).any(axis=1)):
        changing[frame : frame + 35] = True
    seen = jump[changing[1:-1]]
    assert np.percentile(seen, 99) < 0.25
    assert seen.max() < 1.0


def test_what_links_carry_goes_with_those_that_come_and_go() -> None:
    scene = load_scene("hazel")
    model = build_model(random_tree(1))
    position = np.zeros((10, 3), np.float32)
    position[:, 0] = 7.0 * np.arange(10)
    placements = Placements(position, np.linspace(0.0, 3.0, 10).astype(np.float32))
    level = replace(finest_level(model), coupled=True)

    def swing(one: LevelSet, first: int, last: int) -> None:
        for sample in range(first, last):
            one.sample_winds(scene.wind, sample / 30.0, (sample + 1) / 30.0)
            one.step(4, 0, 4)

    busy, quiet = (LevelSet(model, level, placements, scene.terrain, np.arange(8)) for _ in range(2))
    swing(busy, 0, 60)
    swing(quiet, 0, 60)
    leaver = [part[0, :, :, 2].copy() for part in busy.state.parts]
    busy.add(8, *leaver)
    busy.add(9, *leaver)
    assert len(busy.state.joints) == 2
    busy.remove(2)
    busy.remove(8)
    assert sorted(busy.members) == [0, 1, 3, 4, 5, 6, 7, 9]
    swing(busy, 60, 120)
    swing(quiet, 60, 120)
    for member in (0, 1, 3, 7):
        for one, other in zip(busy.state.parts, quiet.state.parts, strict=True):
            at, was = divmod(busy.slot(member), 8), divmod(quiet.slot(member), 8)
            assert np.array_equal(one[at[0], ..., at[1]], other[was[0], ..., was[1]])
            assert one.size == 0 or one[at[0], ..., at[1]].any()


def test_a_change_to_springs_and_back_keeps_the_motion() -> None:
    model = build_model(random_tree(2))
    hierarchy = simplify(model)
    ladder = build_ladder(hierarchy, multibody=True)
    state = swayed(model, 60)
    angles, velocities = joint_motion_of(model, ladder.levels[0], state, 0)
    assert np.array_equal(angles, state.angles(0))
    springs = next(level for level in ladder.levels if not level.coupled)
    joints, _ = carry_over(hierarchy, angles, velocities, springs)
    there = rest_state(springs, 1)
    there.joints[0, :, :, 0] = joints
    back, _, carried = carry_over(hierarchy, *joint_motion_of(model, springs, there, 0), ladder.levels[0])
    assert np.array_equal(back, state.joints[0, :, :, 0])
    assert np.array_equal(carried, coupled(model, state).carried[0, :, :, 0])
    # What links carry and how their joints move differ by the part of a step's motion that joints forget.
    apart = np.abs(carried - state.carried[0, :, :, 0]).max()
    assert 0.0 < apart < 0.2 * np.abs(carried).max()


def test_the_error_of_springs_is_what_tips_show() -> None:
    model = build_model(random_tree(4, material=Material(youngs_modulus=3e8)))
    ladder = build_ladder(simplify(model), multibody=True)
    springs = next(k for k, one in enumerate(ladder.levels) if not one.coupled)
    assert ladder.levels[springs].group_count == 0
    assert ladder.tolerance[0] == ladder.tolerance[springs] == 0.0
    measured = measure(ladder, 4.0)
    stated = with_measured_errors(ladder, measured)
    level, air = finest_level(model), training_air()
    steppers = (
        (MultibodyStepper(model), coupled_rest(model, PLACEMENTS)),
        (Stepper(level), rest_state(level, PLACEMENTS)),
    )
    last = np.append(model.skeleton.stem_first_link[1:], model.link_count) - 1
    apart = []
    for sample in range(120):
        ends = []
        for stepper, state in steppers:
            stepper.step(state, air(level, sample / 30.0), air(level, (sample + 1) / 30.0), 4)
            pose = pose_links(model, level, state)
            q, d = pose.rotation[:, last].astype(float), model.skeleton.vector[last]
            t = 2.0 * np.cross(q[..., :3], d)
            ends.append(pose.position[:, last] + d + q[..., 3:] * t + np.cross(q[..., :3], t))
        if sample % 3 == 2:
            apart.append(np.linalg.norm(ends[1] - ends[0], axis=-1))
    assert np.percentile(apart, 95) > 1e-3
    assert measured.p95[springs] == pytest.approx(np.percentile(apart, 95), rel=1e-3)
    assert measured.largest[springs] == pytest.approx(np.max(apart), rel=1e-3)
    assert stated.error[0] == 0.0
    assert stated.error[springs] >= measured.p95[springs]
    assert 3.0 * stated.error[springs] >= measured.largest[springs]


def test_a_scenes_ladder_keeps_no_level_that_a_cheaper_one_is_as_near_as() -> None:
    model = build_model(random_tree(4, material=Material(youngs_modulus=3e8)))
    ladder = build_ladder(simplify(model), multibody=True)
    short = measured_ladder(ladder)
    assert short.levels[0] is ladder.levels[0]
    assert short.levels[-1] is ladder.levels[-1]
    assert len(short.levels) == len(short.error) == len(short.tolerance) < len(ladder.levels)
    assert (np.diff(short.error) > 0.0).all()
    order = [id(level) for level in ladder.levels]
    assert (np.diff([order.index(id(level)) for level in short.levels]) > 0).all()


def test_a_coupled_level_with_groups_takes_over_the_motion() -> None:
    model = build_model(random_tree(2))
    hierarchy = simplify(model)
    ladder = build_ladder(hierarchy, multibody=True)
    level = replace(ladder.levels[ladder.merged(coupled=False)[0]], coupled=True)
    state = swayed(model, 60)
    angles, velocities = state.angles(0), state.velocities(0)
    joints, groups, carried = carry_over(hierarchy, angles, velocities, level)
    assert np.array_equal(joints, state.joints[0, level.link, :, 0])
    assert np.array_equal(carried, coupled(model, state).carried[0, level.link, :, 0])
    assert groups.shape == (level.group_count, 6)
    assert groups.any()


def test_plants_near_the_camera_are_coupled_and_all_are_without_levels(
    hazels: tuple[Scene, list[Plant]],
) -> None:
    scene, plants = hazels
    near = Eye(np.array([0.0, -3.0, 2.0], np.float32), FOV, HEIGHT)
    for levels in (True, False):
        simulation = Simulation(scene, plants, levels=levels, multibody=True)
        simulation.eye = near
        simulation.advance(1.0)
        kind = simulation.kinds[0]
        assert not kind.near
        assert [len(s.members) for s in kind.live_sets] == [3]
        assert isinstance(kind.live_sets[0].state, CoupledState)
        assert kind.live_sets[0].state.joints.any()
    assert not Simulation(scene, plants, levels=True).kinds[0].sets[0].level.coupled
