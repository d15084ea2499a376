"""Leaves: how many, where, how they lie."""

import numpy as np
import pytest

from windswept.plants.weber_penn import grow

TRUNK = {"curve_res": 8}


def test_leaves_stand_on_the_last_order_only():
    plant = grow("quaking_aspen", 0)
    assert (plant.stem_order[plant.link_stem[plant.leaf_link]] == 2).all()


def test_leaves_of_a_lone_trunk_are_spread_evenly_above_the_bare_part(sample_species):
    plant = grow(
        sample_species({"leaves": 40, "base_size": 0.25}, TRUNK, {"rotate": 77.0, "down_angle": 45.0})
    )
    assert plant.leaf_count == 40
    np.testing.assert_allclose(
        np.sort(plant.leaf_position[:, 2]), 2.5 + 7.5 * (np.arange(40) + 0.5) / 40, atol=1e-5
    )


def test_down_angle_and_rotate_by_hand(sample_species):
    plant = grow(sample_species({"leaves": 12}, TRUNK, {"rotate": 77.0, "down_angle": 35.0}))
    np.testing.assert_allclose(plant.leaf_axis[:, 2], np.cos(np.radians(35)), atol=1e-6)
    np.testing.assert_allclose(plant.leaf_normal[:, 2], np.sin(np.radians(35)), atol=1e-6)
    heading = np.unwrap(np.degrees(np.arctan2(plant.leaf_axis[:, 1], plant.leaf_axis[:, 0])), period=360)
    np.testing.assert_allclose(np.diff(heading), 77, atol=1e-3)


def test_negative_rotate_stands_on_alternate_sides(sample_species):
    plant = grow(sample_species({"leaves": 12}, TRUNK, {"rotate": -80.0, "down_angle": 35.0}))
    heading = np.degrees(np.arctan2(plant.leaf_axis[:, 1], plant.leaf_axis[:, 0]))
    np.testing.assert_allclose(heading[::2], heading[0], atol=1e-3)
    assert np.mod(heading[1] - heading[0], 360) == pytest.approx(160, abs=1e-3)


def test_negative_leaves_are_a_fan_at_the_tip(sample_species):
    plant = grow(sample_species({"leaves": -5}, TRUNK, {"rotate": 100.0}))
    assert plant.leaf_count == 5
    np.testing.assert_allclose(plant.leaf_position, np.tile([0, 0, 10], (5, 1)), atol=1e-5)
    across = np.degrees(np.arccos(plant.leaf_axis @ plant.leaf_axis[0]))
    np.testing.assert_allclose(across, [0, 20, 40, 60, 80], atol=1e-3)
    assert np.linalg.matrix_rank(plant.leaf_axis, tol=1e-4) == 2


def test_quality_keeps_the_area(sample_species):
    growth = {"leaves": 400, "leaf_scale": 0.2, "leaf_scale_x": 0.5}
    fine, coarse = (grow(sample_species(growth | {"leaf_quality": q}, TRUNK)) for q in (1.0, 0.25))
    assert (fine.leaf_count, coarse.leaf_count) == (400, 100)
    assert coarse.leaf_length[0] == pytest.approx(0.4)
    assert coarse.leaf_area.sum() == pytest.approx(fine.leaf_area.sum(), rel=1e-5)


def test_leaves_turn_to_the_light(sample_species):
    turned = []
    for bend in (0.0, 0.5, 1.0):
        growth = {"leaves": 200, "leaf_bend": bend}
        plant = grow(sample_species(growth, TRUNK | {"curve_v": 60.0}, {"rotate": 77.0, "down_angle": 50.0}))
        turned.append(plant.leaf_normal[:, 2].mean())
    assert turned[0] < turned[1] < turned[2]
    assert turned[2] == pytest.approx(1.0, abs=1e-5)


def test_leaves_grow_denser_towards_the_tips(sample_species):
    levels = {"curve_res": 8}, {"branches": 2, "length": 0.1, "rotate": 90.0, "down_angle": 60.0}
    plant = grow(sample_species({"leaves": 100}, *levels, {}))
    # branches at 1/4 and 3/4 of the trunk: 100 x (0.5 + 0.5 x 1/4) and 100 x (0.5 + 0.5 x 3/4), rounded
    assert sorted(np.bincount(plant.link_stem[plant.leaf_link])[1:]) in ([62, 88], [63, 87])
