"""Tufts set down in a scene: places, parents, poses and what a tilt of the ground does."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.motion.blades.blades import Blades, rest_blades
from windswept.motion.blades.kind import BladeKind, build_kind
from windswept.motion.blades.plant_tufts import TuftPlaces, plant_tufts
from windswept.motion.blades.pose_blades import pose_blades
from windswept.motion.blades.simplify_table import simplify_table
from windswept.motion.blades.step_blades import step_in_given
from windswept.plants.underbrush import BladePose, Tuft, grow_tuft, load_underbrush

from .conftest import COARSE


@pytest.fixture(scope="module")
def daisies() -> tuple[list[Tuft], list[BladeKind]]:
    tufts = [grow_tuft(load_underbrush("oxeye_daisy"), seed) for seed in (0, 1)]
    return tufts, [build_kind(blade, COARSE) for blade in tufts[0].kinds]


def places(count: int, size: float = 1.0, slope: float = 0.0) -> TuftPlaces:
    rng = np.random.default_rng(0)
    position = np.zeros((count, 3), np.float32)
    position[:, :2] = rng.uniform(-5.0, 5.0, (count, 2))
    position[:, 2] = 3.0
    normal = np.tile(np.float32([-np.sin(slope), 0.0, np.cos(slope)]), (count, 1))
    which = (np.arange(count) % 2).astype(np.int32)
    yaw = rng.uniform(0.0, 6.0, count).astype(np.float32)
    return TuftPlaces(which, position, yaw, normal, np.full(count, size, np.float32))


def pose_all(planted: list[Blades], speed: float = 0.0, seconds: float = 5.0) -> list[BladePose]:
    poses: list[BladePose] = []
    for blades in planted:
        state = rest_blades(blades)
        if speed:
            wind = np.tile(np.float32([speed, 0.0, 0.0]), (blades.count, 1))
            step_in_given(blades, state, wind, None, round(120 * seconds))
        poses.append(
            pose_blades(blades, state, poses[blades.parent_kind] if blades.parent_kind >= 0 else None)
        )
    return poses


def test_every_blade_begins_on_what_carries_it(daisies: tuple[list[Tuft], list[BladeKind]]) -> None:
    tufts, kinds = daisies
    where = places(9)
    planted = plant_tufts(tufts, kinds, where)
    names = [kind.name for kind in kinds]
    counts = np.bincount(where.tuft, minlength=2)
    for number, blades in enumerate(planted):
        assert blades.count == sum(
            n * np.sum(t.blade_kind == number) for n, t in zip(counts, tufts, strict=True)
        )
    poses = pose_all(planted, speed=6.0)
    for blades, pose in zip(planted, poses, strict=True):
        root = pose.joint[:, 0]
        if blades.parent_kind < 0:
            apart = np.linalg.norm(root - where.position[blades.placement], axis=1)
            assert apart.max() < 0.036
            continue
        parent = planted[blades.parent_kind]
        np.testing.assert_array_equal(parent.placement[blades.parent], blades.placement)
        carrier = poses[blades.parent_kind].joint[blades.parent]
        if kinds[planted.index(blades)].name == "ray":
            np.testing.assert_allclose(root, carrier[:, -1], atol=1e-6)
    assert names[planted[-1].parent_kind] == "stem"


def test_sections_keep_their_lengths_and_frames_stay_square(
    daisies: tuple[list[Tuft], list[BladeKind]],
) -> None:
    planted = plant_tufts(*daisies, places(4))
    for blades, pose in zip(planted, pose_all(planted, 9.0), strict=True):
        length = np.linalg.norm(np.diff(pose.joint, axis=1), axis=2)
        expected = blades.size[:, None] * blades.kind.chain.length
        np.testing.assert_allclose(length, expected, rtol=1e-4)
        unit = np.einsum("bkij,bklj->bkil", pose.frame, pose.frame)
        np.testing.assert_allclose(unit, np.broadcast_to(np.eye(3), unit.shape), atol=1e-4)


def test_wind_bends_flowers_downwind_and_lowers_them(daisies: tuple[list[Tuft], list[BladeKind]]) -> None:
    planted = plant_tufts(*daisies, places(8))
    calm, windy = pose_all(planted), pose_all(planted, 8.0)
    stem = next(i for i, blades in enumerate(planted) if blades.kind.name == "stem")
    assert (windy[stem].tip[:, 0] > calm[stem].tip[:, 0] + 0.05).all()
    ray = len(planted) - 1
    moved = windy[ray].joint[:, 0] - calm[ray].joint[:, 0]
    assert moved[:, 0].min() > 0.05
    assert np.median(windy[stem].tip[:, 2]) < np.median(calm[stem].tip[:, 2])


def test_a_larger_blade_hangs_in_the_same_shape(daisies: tuple[list[Tuft], list[BladeKind]]) -> None:
    # Elastic similarity: twice as long and 2^1.5 as thick.
    small, large = (plant_tufts(*daisies, places(4, size)) for size in (1.0, 2.0))
    for one, two in zip(pose_all(small), pose_all(large), strict=True):
        shape = one.joint - one.joint[:, :1]
        np.testing.assert_allclose(two.joint - two.joint[:, :1], 2.0 * shape, atol=1e-4)


def test_blades_stand_on_the_normal_of_the_ground(daisies: tuple[list[Tuft], list[BladeKind]]) -> None:
    flat, steep = (plant_tufts(*daisies, places(6, slope=slope)) for slope in (0.0, 0.4))
    stem = next(i for i, blades in enumerate(flat) if blades.kind.name == "stem")
    assert steep[stem].frame[:, 0, 0].mean() < flat[stem].frame[:, 0, 0].mean() - 0.25
    # A slope turns gravity against the blade: it hangs further than the ground alone would turn it.
    turned = pose_all(steep)[stem].tip - steep[stem].base
    upright = pose_all(flat)[stem].tip - flat[stem].base
    assert turned[:, 0].mean() < upright[:, 0].mean() - 0.2 * kind_length(flat[stem])


def kind_length(blades: Blades) -> float:
    return blades.kind.chain.whole_length


def test_forces_are_felt_at_the_height_above_the_ground(daisies: tuple[list[Tuft], list[BladeKind]]) -> None:
    for blades in plant_tufts(*daisies, places(4)):
        height = blades.constants[:, 2].ravel()
        assert (height > -0.02).all()
        assert (height < 0.8).all()


def test_neighbours_stand_together(daisies: tuple[list[Tuft], list[BladeKind]]) -> None:
    blades = plant_tufts(*daisies, places(300))[0]
    step = np.linalg.norm(np.diff(blades.base[:, :2], axis=0), axis=1)
    assert np.median(step) < 0.1
    assert step.mean() < 0.3


def test_motion_goes_on_between_steps(daisies: tuple[list[Tuft], list[BladeKind]]) -> None:
    blades = plant_tufts(*daisies, places(3))[1]
    state = rest_blades(blades)
    wind = np.tile(np.float32([5.0, 0.0, 0.0]), (blades.count, 1))
    step_in_given(blades, state, wind, None, 20)
    now, ahead = pose_blades(blades, state).tip, pose_blades(blades, state, ahead=blades.time_step).tip
    step_in_given(blades, state, wind)
    then = pose_blades(blades, state).tip
    assert np.linalg.norm(then - now, axis=1).min() > 1e-4
    assert (np.linalg.norm(then - ahead, axis=1) < 0.3 * np.linalg.norm(then - now, axis=1)).all()


def test_fewer_sections_end_at_the_same_tip(daisies: tuple[list[Tuft], list[BladeKind]]) -> None:
    blades = plant_tufts(*daisies, places(5))[1]
    tables = simplify_table(blades.kind.table, 3), simplify_table(blades.kind.broken_table, 3)
    fine, coarse = pose_blades(blades), pose_blades(blades, tables=tables)
    assert coarse.joint.shape[1] == 4
    apart = np.linalg.norm(fine.tip - coarse.tip, axis=1)
    assert apart.max() < 0.005 * kind_length(blades)
