"""The tree of links as mechanics needs it: vectors, joint axes in the rest frame, depths and subtree ranges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from windswept.motion.rods import Doubles, link_length
from windswept.plants.plant import Ints, Plant


@dataclass(frozen=True, slots=True)
class Skeleton:
    """Rest skeleton of L links and S stems in double precision, links in depth-first order."""

    parent: Ints
    """(L,) parent link, -1 at a root."""
    depth: Ints
    """(L,) links between this one and the root."""
    subtree_end: Ints
    """(L,) the subtree of link l is ``l:subtree_end[l]``."""
    attach: Doubles
    """(L,) fraction along the parent link at which the base sits."""
    base: Doubles
    """(L, 3) joint, m."""
    vector: Doubles
    """(L, 3) base to tip, m."""
    length: Doubles
    """(L,) m."""
    axes: Doubles
    """(L, 2, 3) the two joint axes at rest, orthonormal with the link."""
    stem: Ints
    """(L,) stem of each link."""
    stem_depth: Ints
    """(S,) stems between this one and the root."""
    stem_first_link: Ints
    """(S,) first link of each stem."""


def build_skeleton(plant: Plant) -> Skeleton:
    """Skeleton of a plant."""
    base = plant.link_base.astype(np.float64)
    vector = plant.link_tip.astype(np.float64) - base
    length = link_length(plant)
    first = np.ascontiguousarray(plant.stem_link_start[:-1])
    depth, subtree_end = _depth_and_end(plant.link_parent)
    stem_depth, _ = _depth_and_end(plant.stem_parent)
    axes = _joint_axes(plant.link_parent, plant.link_stem, vector / length[:, None])
    return Skeleton(
        plant.link_parent,
        depth,
        subtree_end,
        plant.link_attach.astype(np.float64),
        base,
        vector,
        length,
        axes,
        plant.link_stem,
        stem_depth,
        first,
    )


@njit(cache=True)
def _depth_and_end(parent: Ints) -> tuple[Ints, Ints]:
    count = len(parent)
    depth, end = np.zeros(count, np.int32), np.arange(1, count + 1).astype(np.int32)
    for i in range(count):
        if parent[i] >= 0:
            depth[i] = depth[parent[i]] + 1
    for i in range(count - 1, -1, -1):
        if parent[i] >= 0:
            end[parent[i]] = max(end[parent[i]], end[i])
    return depth, end


@njit(cache=True)
def _joint_axes(parent: Ints, stem: Ints, direction: Doubles) -> Doubles:
    """(L, 2, 3) first axis p x c at a stem's base, carried along the stem without twist; second c x first.

    Beaudoin's axes are p x c and p; PHYSICS C3.18 keeps them perpendicular to the link. Where parent and child
    are parallel any perpendicular axis serves, and the parent's own first axis is the steady choice.
    """
    count = len(parent)
    axes = np.empty((count, 2, 3))
    for link in range(count):
        up, c = parent[link], direction[link]
        if up < 0:
            helper = np.array([0.0, 1.0, 0.0]) if abs(c[1]) < 0.9 else np.array([1.0, 0.0, 0.0])
            first = helper - c * np.dot(helper, c)
        else:
            first = np.cross(direction[up], c)
            if stem[link] == stem[up] or np.dot(first, first) < 1e-6:
                first = axes[up, 0] - c * np.dot(axes[up, 0], c)
            if np.dot(first, first) < 1e-6:
                first = axes[up, 1] - c * np.dot(axes[up, 1], c)
        first = first / np.sqrt(np.dot(first, first))
        axes[link, 0] = first
        axes[link, 1] = np.cross(c, first)
    return axes
