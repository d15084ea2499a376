"""The pruning envelope."""

import numpy as np
import pytest

from windswept.plants.species import load_species
from windswept.plants.validate import validate
from windswept.plants.weber_penn import grow
from windswept.plants.weber_penn.pruning import fit_lengths, is_inside
from windswept.plants.weber_penn.tree import plant_tree

ENVELOPE = {"prune_ratio": 1.0, "prune_width": 0.4, "prune_width_peak": 0.6, "base_size": 0.05}


@pytest.fixture
def tree(sample_species):
    return plant_tree(sample_species(ENVELOPE), 0, 1000, 1000)


def test_envelope_by_hand(tree):
    # r = (10 - 8.1) / 9.5 = 0.2, width 0.4 x sqrt(0.2 / 0.4) x 10 m = 2.828 m
    np.testing.assert_array_equal(is_inside(tree, np.array([[2.82, 0, 8.1], [0, 2.84, 8.1]])), [True, False])
    np.testing.assert_array_equal(is_inside(tree, np.array([[0, 0, 10.1], [0, 0, 0.4]])), [False, False])


def test_a_straight_stem_is_shortened_until_it_fits(tree):
    base, tip = np.array([[0.0, 0.0, 5.0]]), np.array([[0.5, 0.0, 0.0], [1.0, 0.0, 0.0]])
    family, reach = np.zeros(2, int), np.array([0.5, 1.0])
    length = fit_lengths(tree, base, np.array([9.0]), family, reach, tip)
    assert is_inside(tree, base + length[0] * tip).all()
    assert 2.5 < length[0] < 4.0
    np.testing.assert_array_equal(fit_lengths(tree, base, np.array([2.0]), family, reach, tip), 2.0)


def test_a_stem_that_stands_outside_does_not_grow(tree):
    length = fit_lengths(
        tree, np.array([[9.0, 0, 5]]), np.ones(1), np.zeros(1, int), np.ones(1), np.array([[1.0, 0, 0]])
    )
    np.testing.assert_array_equal(length, 0.0)


def test_a_clone_shortens_the_stem_it_continues(tree):
    tip = np.array([[0.0, 0.0, 0.1], [1.0, 0.0, 0.0]])
    args = np.array([[0.0, 0.0, 5.0]]), np.array([9.0]), np.zeros(2, int), np.ones(2), tip
    assert is_inside(tree, args[0] + fit_lengths(tree, *args)[0] * tip).all()


def test_half_a_prune_ratio_cuts_half(sample_species):
    args = np.array([[0.0, 0, 5]]), np.array([9.0]), np.zeros(1, int), np.ones(1), np.array([[1.0, 0, 0]])
    whole, half, none = (
        fit_lengths(plant_tree(sample_species(ENVELOPE | {"prune_ratio": ratio}), 0, 9, 9), *args)[0]
        for ratio in (1.0, 0.5, 0.0)
    )
    assert none == 9.0
    assert half == pytest.approx((whole + none) / 2)


@pytest.mark.parametrize("seed", [0, 3])
def test_nothing_of_the_willow_leaves_its_envelope(seed):
    plant = grow("weeping_willow", seed)
    tree = plant_tree(load_species("weeping_willow"), seed, 1, 1)
    branch = plant.stem_order[plant.link_stem] > 0
    assert is_inside(tree, plant.link_tip[branch].astype(float) * (1 - 1e-6)).all()
    validate(plant)
