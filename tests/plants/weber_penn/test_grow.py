"""Whole trees: counts, invariants, determinism, independent streams, radii, budgets."""

from dataclasses import fields

import numpy as np
import pytest

from windswept.errors import BudgetError, InputError
from windswept.plants.species import load_species, species_names
from windswept.plants.validate import validate
from windswept.plants.weber_penn import grow
from windswept.plants.weber_penn.tree import LEAST_LINKS, THINNEST


def arrays(plant):
    """All arrays of a plant by name."""
    return {f.name: v for f in fields(plant) if isinstance(v := getattr(plant, f.name), np.ndarray)}


def with_growth(name, **changes):
    """A built-in species with other growth parameters."""
    species = load_species(name)
    return species.model_copy(update={"growth": species.growth.model_copy(update=changes)})


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(
    ("name", "stems", "leaves"),
    [("quaking_aspen", [1, 50, 1176], 22_050), ("black_tupelo", [1, 50, 975, 8303], 37_363)],
)
def test_counts_are_those_of_the_formulas(name, stems, leaves, seed):
    plant = grow(name, seed)
    np.testing.assert_allclose(np.bincount(plant.stem_order), stems, rtol=0.15)
    assert plant.leaf_count == pytest.approx(leaves, rel=0.15)


@pytest.mark.parametrize("name", species_names())
@pytest.mark.parametrize("seed", range(3))
def test_every_species_is_valid(name, seed):
    plant = grow(name, seed)
    validate(plant)
    assert plant.species == name
    assert plant.seed == seed
    growth = load_species(name).growth
    # The stems of a low plant are longer than the stub of a trunk that they stand on.
    longest = max(1.0, growth.level[1].length + growth.level[1].length_v)
    assert 0.2 * growth.scale < plant.height < 1.6 * longest * (growth.scale + growth.scale_v)
    assert plant.link_tip[:, 2].min() > -0.05 * plant.height


def test_same_seed_same_bytes_and_other_seed_another_tree():
    one, same, other = (arrays(grow("hazel", seed)) for seed in (5, 5, 6))
    assert all(one[name].tobytes() == same[name].tobytes() for name in one)
    assert one["link_tip"].tobytes() != other["link_tip"].tobytes()


@pytest.mark.parametrize(
    "changes", [{"leaves": 3}, {"leaves": -4}, {"leaf_quality": 0.5}, {"leaf_bend": 1.0}]
)
def test_leaves_never_move_wood(changes):
    one, other = arrays(grow("hazel", 1)), arrays(grow(with_growth("hazel", **changes), 1))
    # Only the radii that mechanics reckons with follow the leaves (thicken.py).
    wood = [name for name in one if not name.startswith(("leaf", "link_radius"))]
    assert all(one[name].tobytes() == other[name].tobytes() for name in wood)


def test_another_order_never_moves_those_before():
    whole, bare = grow("black_tupelo", 2), grow(with_growth("black_tupelo", levels=3), 2)
    kept = whole.stem_order[whole.link_stem] < 3
    np.testing.assert_array_equal(whole.link_tip[kept], bare.link_tip)


def test_more_twigs_never_move_branches():
    species = load_species("hazel")
    level = list(species.growth.level)
    level[2] = level[2].model_copy(update={"branches": 20, "curve_v": 90.0})
    more = grow(with_growth("hazel", level=level), 4)
    few = grow("hazel", 4)
    trees = [plant.link_tip[plant.stem_order[plant.link_stem] < 2] for plant in (few, more)]
    np.testing.assert_array_equal(*trees)


@pytest.mark.parametrize("name", species_names())
def test_trunks_and_branches_have_links_enough(name):
    plant = grow(name, 0)
    count = np.diff(plant.stem_link_start)
    own = plant.stem_taper_start == 0
    for order, least in enumerate(LEAST_LINKS):
        assert count[own & (plant.stem_order == order)].min() >= least


@pytest.mark.parametrize("name", species_names())
def test_no_child_is_thicker_than_its_parent_where_it_stands(name):
    plant = grow(name, 1)
    first = plant.stem_link_start[:-1][plant.stem_parent >= 0]
    seat, attach = plant.link_parent[first], plant.link_attach[first]
    there = plant.link_radius_base[seat] * (1 - attach) + plant.link_radius_tip[seat] * attach
    assert (plant.link_radius_base[first] <= there * (1 + 1e-5)).all()
    assert plant.link_radius_tip.min() >= THINNEST * (1 - 1e-6)


def test_trunk_radius_length_and_flare(sample_species):
    plant = grow(
        sample_species({"flare": 0.6, "scale_0": 1.5}, {"length": 0.8, "taper": 0.5, "curve_res": 8})
    )
    assert plant.stem_full_length[0] == pytest.approx(8.0)
    assert plant.stem_radius[0] == pytest.approx(8 * 0.02 * 1.5)
    assert plant.link_radius_base[0] == pytest.approx(plant.stem_radius[0] * (1 + 0.99 * 0.6))
    assert plant.link_radius_tip[-1] == pytest.approx(plant.stem_radius[0] * 0.5)


def test_0scale_leaves_branches_alone(sample_species):
    levels = {"taper": 0.0}, {"branches": 9, "length": 0.3, "down_angle": 60.0}, {}
    plain, thick = (grow(sample_species({"scale_0": s, "ratio_power": 1.2}, *levels)) for s in (1.0, 2.0))
    np.testing.assert_array_equal(plain.stem_radius[1:], thick.stem_radius[1:])
    assert plain.stem_radius[1] == pytest.approx(0.2 * 0.3**1.2, rel=1e-5)


def test_crown_shape_and_negative_down_angle_v(sample_species):
    level = {"branches": 20, "length": 0.5, "down_angle": 60.0, "down_angle_v": -50.0}
    plant = grow(sample_species({"shape": 0, "base_size": 0.2}, {"curve_res": 8}, level, {}))
    first = plant.stem_link_start[1:-1]
    height = plant.link_base[first, 2]
    ratio = (10 - height) / 8
    np.testing.assert_allclose(plant.stem_full_length[1:], 5 * (0.2 + 0.8 * ratio), rtol=1e-5)
    axis = (plant.link_tip - plant.link_base)[first]
    lean = np.degrees(np.arccos(axis[:, 2] / np.linalg.norm(axis, axis=1)))
    np.testing.assert_allclose(lean, 60 - 50 * (1 - 2 * (0.2 + 0.8 * ratio)), atol=1e-2)


def test_a_species_may_have_nothing_but_a_trunk(sample_species):
    plant = grow(sample_species())
    validate(plant)
    assert (plant.stem_count, plant.link_count, plant.leaf_count) == (1, 8, 0)


def test_a_trunk_without_branches_may_have_more_levels(sample_species):
    plant = grow(sample_species({"levels": 4, "leaves": 9}, {}, {"branches": 0}))
    validate(plant)
    assert (plant.stem_count, plant.leaf_count) == (1, 0)


def test_clones_are_stems_of_the_same_order_that_share_length_and_radius():
    plant = grow("weeping_willow", 0)
    clone = (plant.stem_parent >= 0) & (plant.stem_order == plant.stem_order[plant.stem_parent])
    mother = plant.stem_parent[clone]
    assert np.count_nonzero(clone & (plant.stem_order == 0)) >= 2
    assert (plant.stem_taper_start[clone] > plant.stem_taper_start[mother]).all()
    np.testing.assert_array_equal(plant.stem_full_length[clone], plant.stem_full_length[mother])
    np.testing.assert_array_equal(plant.stem_radius[clone], plant.stem_radius[mother])
    np.testing.assert_array_equal(plant.link_attach[plant.stem_link_start[:-1][clone]], 1.0)


def test_the_willow_weeps_and_the_pine_is_a_cone():
    willow = grow("weeping_willow", 0)
    whip = np.flatnonzero(willow.stem_order == 2)
    fall = (
        willow.link_tip[willow.stem_link_start[whip + 1] - 1, 2]
        - willow.link_base[willow.stem_link_start[whip], 2]
    )
    assert np.mean(fall < 0) > 0.8
    pine = grow("scots_pine", 0)
    radius, height = np.hypot(*pine.leaf_position[:, :2].T), pine.leaf_position[:, 2] / pine.height
    widths = [
        np.quantile(radius[(height > low) & (height <= low + 0.2)], 0.95) for low in (0.2, 0.4, 0.6, 0.8)
    ]
    assert (np.diff(widths) < 0).all()


@pytest.mark.parametrize(
    ("budgets", "message"),
    [
        ({"link_budget": 5}, r"order 0 bring it to 9 links, budget 5: lower growth.level\[0\].curve_res"),
        (
            {"link_budget": 2000},
            r"order 2 bring it to [\d,]+ links, budget 2,000: lower growth.level\[2\].branches",
        ),
        (
            {"leaf_budget": 2000},
            r"have 22,\d+ leaves, budget 2,000: lower growth.leaf_quality or growth.leaves",
        ),
    ],
)
def test_budgets_say_what_to_lower(budgets, message):
    with pytest.raises(BudgetError, match=message) as caught:
        grow("quaking_aspen", 0, **budgets)
    assert "\n" not in str(caught.value)


def test_splits_and_fans_keep_to_the_budgets(sample_species):
    wild = sample_species({}, {"seg_splits": 4.0, "curve_res": 64})
    with pytest.raises(BudgetError, match=r"level\[0\].seg_splits"):
        grow(wild)
    with pytest.raises(BudgetError, match=r"growth.base_splits"):
        grow(sample_species({"base_splits": 32}, {"curve_res": 64}), link_budget=1000)
    with pytest.raises(BudgetError, match="leaves"):
        grow(sample_species({"leaves": -1000}), leaf_budget=999)


def test_a_million_twigs_are_refused_at_once(sample_species):
    level = {"branches": 1000, "length": 0.5}
    with pytest.raises(BudgetError, match=r"level\[2\].branches"):
        grow(sample_species({"levels": 4}, {}, level, level, level))


def test_bad_seed_and_species():
    with pytest.raises(InputError, match="seed = -1: expected a whole number from 0 up"):
        grow("hazel", -1)
    with pytest.raises(InputError, match="did you mean hazel"):
        grow("hazle")
