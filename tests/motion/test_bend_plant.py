"""From plants to the branches that `bend` moves."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from handmade import BARE_STIFF, Stem, build_plant, random_tree, straight
from windswept.motion import Stepper, build_model, finest_level, pose_links, rest_state
from windswept.motion.bend import Bender
from windswept.motion.bend_branches import place_branches
from windswept.motion.bend_plain import WEIGHTS, step_ordered
from windswept.motion.bend_plant import fit_curves, plant_branches, stem_flexibility
from windswept.plants.air import AIR_DENSITY
from windswept.wind.mean import MeanWind
from windswept.wind.velocity import velocity
from windswept.wind.wind import Wind


def rest(branches):
    return step_ordered(branches, np.zeros((branches.branch_count, 3)), WEIGHTS["beam"])


def test_curves_run_from_base_to_tip_and_no_other_comes_nearer_to_the_nodes():
    plant, rng = random_tree(4), np.random.default_rng(0)
    curves = fit_curves(plant)
    assert_allclose(curves[:, 0], plant.link_base[plant.stem_link_start[:-1]], atol=1e-6)
    assert_allclose(curves[:, 3], plant.link_tip[plant.stem_link_start[1:] - 1], atol=1e-6)
    for stem, best in enumerate(curves):
        nodes = plant.link_tip[plant.stem_link_start[stem] : plant.stem_link_start[stem + 1]].astype(float)
        length = np.linalg.norm(np.diff(nodes, axis=0, prepend=best[:1]), axis=1)
        if len(nodes) < 4:
            continue
        t = np.cumsum(length) / length.sum()
        weights = np.stack([(1 - t) ** 3, 3 * (1 - t) ** 2 * t, 3 * (1 - t) * t * t, t**3], axis=1)
        for _ in range(20):
            other = best.copy()
            other[1:3] += 0.05 * length.sum() * rng.standard_normal((2, 3))
            assert np.sum((weights @ best - nodes) ** 2) < np.sum((weights @ other - nodes) ** 2)


def test_a_stem_of_one_link_is_straight():
    plant = build_plant(straight(3.0, 1, 0.05))
    assert_allclose(fit_curves(plant)[0, :, 2], [0.0, 1.0, 2.0, 3.0], atol=1e-6)


def test_branches_stand_by_level_and_by_parent():
    branches = plant_branches(random_tree(7))
    level = np.repeat(np.arange(branches.level_count), np.diff(branches.level_start))
    child = np.flatnonzero(branches.parent >= 0)
    assert np.all(level[child] == level[branches.parent[child]] + 1)
    for first, end in zip(branches.level_start[:-1], branches.level_start[1:], strict=True):
        assert np.all(np.diff(branches.parent[first:end]) >= 0)


def test_at_rest_the_tips_are_where_the_wind_is_sampled():
    branches = plant_branches(random_tree(4))
    assert_allclose(rest(branches).points[:, 3] + branches.origin, branches.tip, atol=1e-5)


def test_placed_plants_are_turned_and_moved():
    kinds = [plant_branches(random_tree(seed)) for seed in (4, 7)]
    position = np.array([(3.0, 1.0, 0.5), (-9.0, 2.0, 0.0), (5.0, 5.0, 0.0)], np.float32)
    placed = place_branches(kinds, np.array([1, 0, 1]), position, np.array([0.3, 2.0, -1.0]))
    pose = rest(placed)
    assert np.all(placed.parent < np.arange(placed.branch_count))
    for number, (kind, yaw) in enumerate(((1, 0.3), (0, 2.0), (1, -1.0))):
        own = placed.placement == number
        turn = np.array([[np.cos(yaw), -np.sin(yaw), 0.0], [np.sin(yaw), np.cos(yaw), 0.0], [0.0, 0.0, 1.0]])
        alone = rest(kinds[kind])
        assert_array_equal(placed.stem[own], kinds[kind].stem)
        assert_allclose(pose.points[own], alone.points @ turn.T, atol=1e-5)
        world = pose.points[own, 3] + placed.origin[own]
        assert_allclose(world[:, :2], placed.tip[own, :2], atol=1e-5)


def test_a_shrub_keeps_its_stems_apart():
    trunk = straight(1.0, 3, 0.02)
    plant = build_plant(trunk)
    shrub = plant_branches(plant)
    moved = build_plant(Stem(trunk.nodes + np.array([2.0, 1.0, 0.0]), trunk.radii))
    assert_allclose(plant_branches(moved).origin - shrub.origin, [[2.0, 1.0, 0.0]], atol=1e-6)


@pytest.mark.parametrize("links", [10, 40])
def test_a_bare_pole_is_as_flexible_as_a_beam(links):
    length, radius = 4.0, 0.03
    # Level, so that the wind is the same all along it.
    plant = build_plant(straight(length, links, radius, direction=(1.0, 0.0, 0.0)))
    # A uniform load q = 1/2 rho C_d 2 r U^2 deflects the tip by q L^4 / (8 EI); half is the mean over directions.
    q = 0.5 * 0.5 * AIR_DENSITY * BARE_STIFF.wood_drag * 2.0 * radius
    deflection = q * length**4 / (8.0 * BARE_STIFF.youngs_modulus * 0.25 * np.pi * radius**4)
    assert stem_flexibility(plant)[0] == pytest.approx(1.5 * deflection / length, rel=0.02)


def test_a_tapered_pole_leans_as_far_as_with_springs():
    plant = build_plant(straight(5.0, 20, 0.02, 0.008))
    model = build_model(plant)
    level = finest_level(model)
    wind = Wind(mean=MeanWind(10.0, 0.7))
    at_probes = velocity(wind, model.probe_position, model.probe_position[:, 2], 0.0)[None]
    state = rest_state(level, 1)
    Stepper(level).step(state, at_probes, at_probes, 6000)
    last = plant.stem_link_start[1] - 1
    pose, rod = pose_links(model, level, state).link[0, last], (plant.link_tip - plant.link_base)[last]
    axis, w = pose[4:7], pose[7]
    sprung = pose[:3] + rod + 2.0 * np.cross(axis, np.cross(axis, rod) + w * rod)
    bender = Bender(plant_branches(plant))
    rest = bender.pose(bender.rest()).points[0, 3]
    bent = bender.pose(bender.step_ordered(bender.rest(), wind, 0.0)).points[0, 3]
    lean = np.linalg.norm(sprung - plant.link_tip[last])
    assert lean > 0.05
    assert_allclose(bent - rest, sprung - plant.link_tip[last], atol=0.04 * lean)
