"""Shortens stems until they fit the pruning envelope."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.plants.weber_penn.formulas import ENVELOPE, shape_ratio
from windswept.plants.weber_penn.tree import Tree

Reals = NDArray[np.float64]
Indices = NDArray[np.int64]

LEAST_CUT = 1.0 / 15.0
"""Every try shortens a stem by at least this fraction of its first length ..."""
MOST_CUT = 0.5
"""... and by at most this fraction of its present one."""
SHORTEST = 1e-3
"""A stem that does not fit at this fraction of its first length does not grow."""


def fit_lengths(tree: Tree, base: Reals, length: Reals, family: Indices, reach: Reals, tip: Reals) -> Reals:
    """Lengths after pruning, m; a stem and its clones are shortened together.

    Args:
        tree: what is grown.
        base: (F, 3) where the stems stand, m.
        length: (F,) their lengths before pruning, m.
        family: (L,) row of base and length that each link belongs to.
        reach: (L,) Z of each link's tip.
        tip: (L, 3) link tips from the base, for a length of 1.
    """
    if tree.growth.prune_ratio == 0:
        return length
    fitted = np.where(is_inside(tree, base), length, 0.0)
    trying = np.flatnonzero(fitted[family] > 0.0)
    while len(trying):
        own = family[trying]
        outside = ~is_inside(tree, base[own] + fitted[own, None] * tip[trying])
        nearest = np.full(len(length), np.inf)
        np.minimum.at(nearest, own[outside], reach[trying][outside])
        cut = np.isfinite(nearest)
        retry = np.maximum(fitted * np.minimum(nearest, 1.0), fitted * MOST_CUT)
        retry = np.minimum(retry, fitted - length * LEAST_CUT)
        fitted = np.where(cut, np.where(retry < SHORTEST * length, 0.0, retry), fitted)
        trying = trying[(cut & (fitted > 0.0))[own]]
    return length - (length - fitted) * tree.growth.prune_ratio


def is_inside(tree: Tree, point: Reals) -> NDArray[np.bool_]:
    """Whether points (..., 3) in m lie inside the pruning envelope."""
    growth = tree.growth
    ratio = (tree.scale - point[..., 2]) / (tree.scale * (1.0 - growth.base_size))
    radius = np.hypot(point[..., 0], point[..., 1]) / tree.scale
    return np.asarray(radius < growth.prune_width * shape_ratio(ENVELOPE, ratio, growth))
