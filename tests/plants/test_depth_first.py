"""Any order of stems is brought into the one that Plant demands."""

from dataclasses import replace

import numpy as np
import pytest

from windswept.plants.depth_first import depth_first, stem_preorder
from windswept.plants.plant import Plant
from windswept.plants.validate import validate
from windswept.plants.weber_penn import grow


def shuffled(plant, seed=0):
    """The same plant with its stems in another order."""
    rng = np.random.default_rng(seed)
    stem_from = rng.permutation(plant.stem_count)
    stem_to = np.argsort(stem_from)
    ranges = [np.arange(*plant.stem_link_start[[s, s + 1]]) for s in stem_from]
    link_from = np.concatenate(ranges)
    link_to = np.argsort(link_from)
    leaf_from = rng.permutation(plant.leaf_count)
    rows = {}
    for name in Plant.__dataclass_fields__:
        value = getattr(plant, name)
        if isinstance(value, np.ndarray):
            rows[name] = (
                value[{"stem": stem_from, "link": link_from, "leaf": leaf_from}[name[:4]]]
                if (name != "stem_link_start")
                else np.concatenate(([0], np.cumsum([len(r) for r in ranges]))).astype(np.int32)
            )
    for name, place in (("stem_parent", stem_to), ("link_parent", link_to), ("link_stem", stem_to)):
        rows[name] = np.where(rows[name] < 0, -1, place[rows[name]]).astype(np.int32)
    rows["leaf_link"] = link_to[rows["leaf_link"]].astype(np.int32)
    return replace(plant, **rows)


@pytest.mark.parametrize("name", ["scots_pine", "quaking_aspen"])
def test_shuffled_plant_comes_back(name):
    plant = grow(name, 1)
    mixed = shuffled(plant)
    with pytest.raises(ValueError, match="stem"):
        validate(mixed)
    again = depth_first(mixed)
    validate(again)
    np.testing.assert_array_equal(again.link_base, plant.link_base)
    np.testing.assert_array_equal(again.link_parent, plant.link_parent)
    np.testing.assert_array_equal(np.sort(again.leaf_position, axis=0), np.sort(plant.leaf_position, axis=0))


def test_ordered_plant_is_left_alone():
    plant = grow("hazel", 0)
    np.testing.assert_array_equal(stem_preorder(plant), np.arange(plant.stem_count))


def test_subtree_of_every_link_is_one_range():
    plant = grow("hazel", 3)
    size = np.ones(plant.link_count, int)
    last = np.arange(plant.link_count)
    for link in range(plant.link_count - 1, 0, -1):
        parent = plant.link_parent[link]
        size[parent] += size[link]
        last[parent] = max(last[parent], last[link])
    np.testing.assert_array_equal(last - np.arange(plant.link_count) + 1, size)


def test_child_stems_run_from_tip_to_base():
    plant = grow("scots_pine", 0)
    first = plant.stem_link_start[:-1]
    seat = plant.link_parent[first] + plant.link_attach[first]
    for stem in range(plant.stem_count):
        assert (np.diff(seat[plant.stem_parent == stem]) <= 0).all()


def test_joint_scale_moves_with_its_link():
    plant = grow("scots_pine", 0)
    scale = plant.link_base[:, 2].copy()
    mixed = shuffled(replace(plant, joint_scale=None))
    again = depth_first(replace(mixed, joint_scale=mixed.link_base[:, 2].copy()))
    np.testing.assert_array_equal(again.joint_scale, scale)
