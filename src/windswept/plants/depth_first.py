"""Puts the stems, links and leaves of a plant in depth-first order, whatever order they were grown in."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numba import njit
from numpy.typing import NDArray

from windswept.plants.plant import Plant

Indices = NDArray[np.int64]


def depth_first(plant: Plant) -> Plant:
    """Reorder a plant as `Plant` demands: stems in preorder, child stems tip to base, leaves by link.

    Args:
        plant: stems in any order; the links of each stem contiguous and base to tip. All indices refer to the
            order given. Its leaves may be in any order.
    """
    stem_from = stem_preorder(plant)
    link_count = np.diff(plant.stem_link_start)[stem_from]
    stem_link_start = np.concatenate(([0], np.cumsum(link_count)))
    link_shift = plant.stem_link_start[stem_from] - stem_link_start[:-1]
    link_from = np.arange(plant.link_count) + np.repeat(link_shift, link_count)
    stem_to, link_to = _inverse(stem_from), _inverse(link_from)
    leaf_link = _renumbered(plant.leaf_link, link_to)
    leaf_from = np.argsort(leaf_link, kind="stable")
    stems = {name: getattr(plant, name)[stem_from] for name in _STEM_FIELDS}
    links = {name: getattr(plant, name)[link_from] for name in _LINK_FIELDS}
    leaves = {name: getattr(plant, name)[leaf_from] for name in _LEAF_FIELDS}
    return replace(
        plant,
        **stems,
        **links,
        **leaves,
        stem_parent=_renumbered(plant.stem_parent[stem_from], stem_to),
        stem_link_start=stem_link_start.astype(np.int32),
        link_parent=_renumbered(plant.link_parent[link_from], link_to),
        link_stem=_renumbered(plant.link_stem[link_from], stem_to),
        leaf_link=leaf_link[leaf_from],
        joint_scale=None if plant.joint_scale is None else plant.joint_scale[link_from],
    )


_STEM_FIELDS = (
    *("stem_order", "stem_radius", "stem_taper", "stem_flare", "stem_lobes", "stem_lobe_depth"),
    *("stem_full_length", "stem_taper_start"),
)
_LINK_FIELDS = ("link_base", "link_tip", "link_attach", "link_radius_base", "link_radius_tip")
_LEAF_FIELDS = ("leaf_position", "leaf_axis", "leaf_normal", "leaf_length", "leaf_width")


def stem_preorder(plant: Plant) -> Indices:
    """(S,) stems in preorder, the children of a stem from its tip to its base; equal seats keep their order."""
    first = plant.stem_link_start[:-1]
    tip_first = np.lexsort((-plant.link_attach[first], -plant.link_parent[first], plant.stem_parent))
    child_count = np.bincount(plant.stem_parent + 1, minlength=plant.stem_count + 1)
    child_start = np.concatenate(([0], np.cumsum(child_count)))
    return _walk(tip_first.astype(np.int64), child_start.astype(np.int64))


@njit(cache=True)
def _walk(child: Indices, child_start: Indices) -> Indices:
    """Preorder of a forest; the children of stem s are ``child[child_start[s+1]:child_start[s+2]]``, roots s=-1."""
    order = np.empty(len(child), np.int64)
    waiting = np.empty(len(child), np.int64)
    depth = 0
    for i in range(child_start[1] - 1, -1, -1):
        waiting[depth] = child[i]
        depth += 1
    for place in range(len(child)):
        depth -= 1
        stem = waiting[depth]
        order[place] = stem
        for i in range(child_start[stem + 2] - 1, child_start[stem + 1] - 1, -1):
            waiting[depth] = child[i]
            depth += 1
    return order


def _inverse(order: Indices) -> Indices:
    """Where each old index went."""
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return place


def _renumbered(index: NDArray[np.int32], place: Indices) -> NDArray[np.int32]:
    """Indices in the new order; -1 stays -1."""
    return np.where(index < 0, -1, place[index]).astype(np.int32)
