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


def fit_lengths(
    tree: Tree, base: Reals, length: Reals, family: Indices, point: Reals, start: Indices
) -> Reals:
    """Lengths after pruning, m; a stem and its clones are shortened together.

    Args:
        tree: what is grown.
        base: (F, 3) where the stems stand, m.
        length: (F,) their lengths before pruning, m.
        family: (S,) row of base and length that each stem or clone belongs to.
        point: (S, K+1, 3) link ends from the base for a length of 1.
        start: (S,) first link of each stem.
    """
    if tree.growth.prune_ratio == 0:
        return length
    fitted = length.copy()
    trying = np.arange(len(family))
    while len(trying):
        own = family[trying]
        reach = _first_outside(tree, base[own], fitted[own], point[trying], start[trying]) / (
            point.shape[1] - 1
        )
        shortest = np.full(len(length), np.inf)
        np.minimum.at(shortest, own, reach)
        outside = np.isfinite(shortest)
        retry = np.maximum(fitted * np.minimum(shortest, 1.0), fitted * MOST_CUT)
        retry = np.minimum(retry, fitted - length * LEAST_CUT)
        retry = np.where(retry < 1e-3 * length, 0.0, retry)
        fitted = np.where(outside, retry, fitted)
        trying = trying[(outside & (fitted > 0.0))[family[trying]]]
    return length - (length - fitted) * tree.growth.prune_ratio


def is_inside(tree: Tree, point: Reals) -> NDArray[np.bool_]:
    """Whether points (..., 3) in m lie inside the pruning envelope."""
    growth = tree.growth
    ratio = (tree.scale - point[..., 2]) / (tree.scale * (1.0 - growth.base_size))
    radius = np.hypot(point[..., 0], point[..., 1]) / tree.scale
    return np.asarray(radius < growth.prune_width * shape_ratio(ENVELOPE, ratio, growth))


def _first_outside(tree: Tree, base: Reals, length: Reals, point: Reals, start: Indices) -> Reals:
    """(n,) index of the first link end outside the envelope; infinite where all are inside."""
    place = base[:, None, :] + length[:, None, None] * point
    own = np.arange(point.shape[1]) >= start[:, None]
    outside = own & ~is_inside(tree, place)
    return np.where(outside.any(axis=1), outside.argmax(axis=1), np.inf)
