"""validate names every broken invariant."""

from dataclasses import replace

import numpy as np
import pytest

from windswept.plants.validate import validate
from windswept.plants.weber_penn import grow


@pytest.fixture(scope="module")
def plant():
    return grow("hazel", 0)


def broken(plant, name, index, value):
    """The plant with one number changed."""
    array = getattr(plant, name).copy()
    array[index] = value
    return replace(plant, **{name: array})


def test_grown_plant_is_valid(plant):
    validate(plant)


@pytest.mark.parametrize(
    ("name", "index", "value", "fault"),
    [
        ("link_tip", (3, 0), np.nan, "link_tip is not finite"),
        ("stem_link_start", 0, 1, "does not span"),
        ("stem_link_start", 2, 0, "a stem has no link"),
        ("stem_parent", 2, 2, "before its parent"),
        ("stem_order", 0, 1, "order 0"),
        ("stem_order", 5, 4, "or the next"),
        ("stem_radius", 1, 0, "stem_radius"),
        ("stem_full_length", 1, -1, "stem_full_length"),
        ("stem_taper_start", 1, 1, "stem_taper_start"),
        ("link_stem", 4, 3, "link_stem disagrees"),
        ("link_parent", 5, 3, "not a chain"),
        ("link_attach", 5, 0.5, "not 1 within"),
        ("link_tip", (5, 1), 3.0, "not the tip"),
        ("link_radius_base", 7, 0, "link_radius_base"),
        ("link_radius_tip", 7, -1, "link_radius_tip"),
        ("link_parent", 0, 1, "trunk has a parent"),
        ("leaf_link", 0, -1, "leaf_link is not a link"),
        ("leaf_link", 0, 1000, "does not ascend"),
        ("leaf_axis", 4, 0.9, "leaf_axis"),
        ("leaf_normal", 4, 0.9, "leaf_normal"),
        ("leaf_position", 4, 9.0, "leaf_position"),
        ("leaf_width", 4, 0.0, "leaf_width"),
    ],
)
def test_fault_is_named(plant, name, index, value, fault):
    with pytest.raises(ValueError, match=fault):
        validate(broken(plant, name, index, value))


def test_wrong_type_and_length_are_named(plant):
    with pytest.raises(ValueError, match="float64"):
        validate(replace(plant, link_base=plant.link_base.astype(np.float64)))
    with pytest.raises(ValueError, match="rows"):
        validate(replace(plant, link_base=plant.link_base[1:]))


def test_seats_are_checked(plant):
    stem = int(np.flatnonzero(plant.stem_order == 2)[0])
    first = plant.stem_link_start[stem]
    with pytest.raises(ValueError, match="parent stem"):
        validate(broken(plant, "link_parent", first, 0))
    with pytest.raises(ValueError, match="has none"):
        validate(broken(plant, "link_parent", first, -1))
    with pytest.raises(ValueError, match="not in 0"):
        validate(broken(plant, "link_attach", first, 1.5))
    attach = plant.link_attach[first]
    with pytest.raises(ValueError, match="parent link's axis"):
        validate(broken(plant, "link_attach", first, 0.0 if attach > 0.5 else 1.0))


def test_length_and_squareness(plant):
    last = plant.link_count - 1
    with pytest.raises(ValueError, match="no length"):
        validate(broken(plant, "link_tip", last, plant.link_base[last]))
    with pytest.raises(ValueError, match="square"):
        validate(broken(plant, "leaf_normal", 2, plant.leaf_axis[2]))
    with pytest.raises(ValueError, match="preorder"):
        validate(swapped_seats(plant))


def swapped_seats(plant):
    """Two sibling stems of one link set so that the lower comes first."""
    first = plant.stem_link_start[:-1]
    attach, base, tip = plant.link_attach.copy(), plant.link_base.copy(), plant.link_tip.copy()
    seat = plant.link_parent[first]
    for one in range(1, plant.stem_count):
        same = np.flatnonzero((seat == seat[one]) & (attach[first] < attach[first[one]]))
        if len(same):
            low, high = first[same[0]], first[one]
            attach[[low, high]], base[[low, high]] = attach[[high, low]], base[[high, low]]
            return replace(plant, link_attach=attach, link_base=base, link_tip=tip)
    raise AssertionError("no two stems on one link")
