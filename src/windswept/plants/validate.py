"""Says what breaks the invariants that `Plant` states."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
from numpy.typing import NDArray

from windswept.plants.depth_first import stem_preorder
from windswept.plants.plant import Plant

TOLERANCE = 2e-5
"""Slack on positions, m per metre of plant: a few units in the last place of float32."""
UNIT_TOLERANCE = 1e-4
"""Slack on the length and the squareness of directions."""


def validate(plant: Plant) -> None:
    """Raise ValueError with what breaks `Plant`'s invariants; return quietly when nothing does."""
    _check_arrays(plant)
    _check_stems(plant)
    _check_links(plant)
    _check_seats(plant)
    _check_order(plant)
    _check_leaves(plant)


def _check_arrays(plant: Plant) -> None:
    """Types, shapes and finiteness of every array."""
    counts = {"stem": plant.stem_count, "link": plant.link_count, "leaf": plant.leaf_count}
    _require(plant.stem_count > 0 and plant.link_count > 0, "plant has no stem or no link")
    for item in fields(plant):
        value = getattr(plant, item.name)
        if not isinstance(value, np.ndarray):
            continue
        expected = counts.get(item.name.split("_")[0], plant.link_count)
        expected += item.name == "stem_link_start"
        _require(len(value) == expected, f"{item.name} has {len(value)} rows, not {expected}")
        _require(value.dtype in (np.float32, np.int32), f"{item.name} is {value.dtype}, not float32 or int32")
        _require(value.dtype == np.int32 or np.isfinite(value), f"{item.name} is not finite")


def _check_stems(plant: Plant) -> None:
    """Parents, orders and radii of stems."""
    start, parent = plant.stem_link_start, plant.stem_parent
    _require(start[0] == 0 and start[-1] == plant.link_count, "stem_link_start does not span the links")
    _require(np.diff(start) > 0, "stem_link_start: a stem has no link")
    _require(
        (parent >= -1) & (parent < np.arange(len(parent))), "stem_parent: a stem comes before its parent"
    )
    step = plant.stem_order - plant.stem_order[parent]
    is_trunk = parent < 0
    _require(plant.stem_order[is_trunk] == 0, "stem_order: a trunk is not of order 0")
    _require(
        (step >= 0) & (step <= 1) | is_trunk, "stem_order: a child is not of its parent's order or the next"
    )
    _require(plant.stem_radius > 0, "stem_radius is not positive")
    _require(plant.stem_full_length > 0, "stem_full_length is not positive")
    _require((plant.stem_taper_start >= 0) & (plant.stem_taper_start < 1), "stem_taper_start is not in 0..1")


def _check_links(plant: Plant) -> None:
    """Chains within stems, lengths and radii."""
    stem = np.repeat(np.arange(plant.stem_count), np.diff(plant.stem_link_start))
    _require(plant.link_stem == stem, "link_stem disagrees with stem_link_start")
    within = _is_within_stem(plant)
    index = np.arange(plant.link_count)
    _require((plant.link_parent == index - 1) | ~within, "link_parent: the links of a stem are not a chain")
    _require((plant.link_attach == 1.0) | ~within, "link_attach is not 1 within a stem")
    joined = (plant.link_base[1:] == plant.link_tip[:-1]).all(axis=1)
    _require(joined | ~within[1:], "link_base is not the tip of the link before it in the stem")
    _require(np.linalg.norm(plant.link_tip - plant.link_base, axis=1) > 0, "a link has no length")
    _require(plant.link_radius_base > 0, "link_radius_base is not positive")
    _require(plant.link_radius_tip > 0, "link_radius_tip is not positive")


def _check_seats(plant: Plant) -> None:
    """First links of stems sit on a link of the parent stem."""
    first = plant.stem_link_start[:-1]
    seat, attach = plant.link_parent[first], plant.link_attach[first]
    child = plant.stem_parent >= 0
    _require(seat[~child] == -1, "link_parent: the first link of a trunk has a parent")
    _require(seat[child] >= 0, "link_parent: the first link of a child stem has none")
    seat_stem = plant.link_stem[seat]
    _require((seat_stem == plant.stem_parent) | ~child, "a stem's first link does not sit on its parent stem")
    _require((attach >= 0) & (attach <= 1), "link_attach is not in 0..1")
    base, tip = plant.link_base[seat], plant.link_tip[seat]
    on_axis = base + attach[:, None] * (tip - base)
    gap = np.linalg.norm(plant.link_base[first] - on_axis, axis=1)
    _require(
        (gap <= _slack(plant)) | ~child, "link_base: a child stem does not start on its parent link's axis"
    )


def _check_order(plant: Plant) -> None:
    """Preorder, child stems tip to base."""
    order = stem_preorder(plant)
    _require(order == np.arange(plant.stem_count), "stems are not in preorder with child stems tip to base")


def _check_leaves(plant: Plant) -> None:
    """Leaves lie on their links and have unit, square directions and an area."""
    link = plant.leaf_link
    _require((link >= 0) & (link < plant.link_count), "leaf_link is not a link")
    _require(np.diff(link) >= 0, "leaf_link does not ascend")
    axis_square = np.einsum("ij,ij->i", plant.leaf_axis, plant.leaf_axis)
    normal_square = np.einsum("ij,ij->i", plant.leaf_normal, plant.leaf_normal)
    lean = np.einsum("ij,ij->i", plant.leaf_axis, plant.leaf_normal)
    _require(np.abs(axis_square - 1) < UNIT_TOLERANCE, "leaf_axis is not of unit length")
    _require(np.abs(normal_square - 1) < UNIT_TOLERANCE, "leaf_normal is not of unit length")
    _require(np.abs(lean) < UNIT_TOLERANCE, "leaf_normal is not square to leaf_axis")
    _require((plant.leaf_length > 0) & (plant.leaf_width > 0), "leaf_length or leaf_width is not positive")
    base = plant.link_base[link].astype(np.float64)
    along = plant.link_tip[link] - base
    offset = plant.leaf_position - base
    share = np.einsum("ij,ij->i", offset, along) / np.einsum("ij,ij->i", along, along)
    gap = np.linalg.norm(offset - np.clip(share, 0, 1)[:, None] * along, axis=1)
    _require(gap <= _slack(plant), "leaf_position is not on its link's axis")


def _is_within_stem(plant: Plant) -> NDArray[np.bool_]:
    """(L,) whether a link is not the first of its stem."""
    within = np.ones(plant.link_count, bool)
    within[plant.stem_link_start[:-1]] = False
    return within


def _slack(plant: Plant) -> float:
    """Tolerance on positions, m."""
    return TOLERANCE * max(1.0, float(np.abs(plant.link_tip).max()))


def _require(holds: object, fault: str) -> None:
    """Raise ValueError with the fault and the first index at which it does not hold."""
    mask = np.asarray(holds)
    if mask.all():
        return
    where = (
        f" (first at index {int(np.argmin(mask.reshape(len(mask), -1).all(axis=1)))})" if mask.ndim else ""
    )
    raise ValueError(fault + where)
