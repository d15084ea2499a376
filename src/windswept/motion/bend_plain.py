"""`bend` in plain double-precision NumPy: what the kernels in bend.py and ``gpu/shaders/bend.wgsl`` compute.

One branch, in the order of Skjermo's section 4 with the corrections of PHYSICS C1::

    factor   b = flexibility |U| U              U: the wind at the branch's rest tip (C1.16)
    attach   P0 = C(t) on the parent's curve, the legs turned with the parent's frame (U, S, T) there (C1.14)
    bend     the second leg turns towards b, the third turns with it and then by the rest of its own weight
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from windswept.motion.bend_branches import ROOT_FRAME, Branches, BranchPose
from windswept.wind.velocity import velocity_reference
from windswept.wind.wind import Wind

Doubles = NDArray[np.float64]

WEIGHTS = {"beam": (1.0, 1.0), "as_printed": ((1.0 / 3.0) ** 1.8, 1.0)}
"""Shares of b that turn the second and the third leg.

``beam`` is exact for a cantilever with a load at its tip: y = d x^2 (3 - x) / 2 is the Bezier curve whose legs are
both turned alike (C1.11). ``as_printed`` (Skjermo eq. 16) bends most at the tip.
"""
FOLD = -0.9
"""Along a branch towards its base, b counts no further: a branch in the wind's face turns aside, never inside out."""


def bend_factor(branches: Branches, wind: Wind, time: float) -> Doubles:
    """(R, 3) bend factor b of every branch: drag grows as the square of the wind."""
    air = velocity_reference(wind, branches.tip, branches.tip[:, 2], time)
    speed = np.linalg.norm(air, axis=1)
    return (branches.flexibility * speed)[:, None] * air


def handles(points: Doubles, side: Doubles) -> Doubles:
    """(n, 3, 3) the handles S0, S1, S2 of curves (n, 4, 3): S0 carried from leg to leg by the least rotation.

    Sloan's T1 = S0 x L1 (eq. 8) vanishes where a curve turns by 90 degrees towards S0 (C1.2); this never does.
    """
    legs = np.diff(points, axis=1)
    legs /= np.linalg.norm(legs, axis=2, keepdims=True)
    carried = [np.asarray(side, np.float64)]
    for before, after in ((legs[:, 0], legs[:, 1]), (legs[:, 1], legs[:, 2])):
        share = _dot(carried[-1], after) / (1.0 + _dot(before, after))
        carried.append(carried[-1] - share * (before + after))
    return np.stack(carried, axis=1)


def curve_frame(points: Doubles, side: Doubles, t: Doubles) -> tuple[Doubles, Doubles]:
    """Point (n, 3) and frame (n, 3, 3), rows U, S, T, of curves (n, 4, 3) at parameters (n,)."""
    s, t = 1.0 - t[:, None], t[:, None]
    cubic = np.stack([s**3, 3 * s * s * t, 3 * s * t * t, t**3], axis=1)
    square = np.stack([s * s, 2 * s * t, t * t], axis=1)
    along = _unit(np.sum(square * np.diff(points, axis=1), axis=1))
    across = np.sum(square * handles(points, side), axis=1)
    across = _unit(across - _dot(across, along) * along)
    return np.sum(cubic * points, axis=1), np.stack([along, across, np.cross(across, along)], axis=1)


def attach(
    branches: Branches, rows: slice, parent_points: Doubles, parent_side: Doubles
) -> tuple[Doubles, Doubles]:
    """Control points (n, 4, 3) and handles (n, 3) of unbent branches on their parents.

    Args:
        branches: all of them.
        rows: which n of them.
        parent_points: (n, 4, 3) control points of their parents; unread for roots.
        parent_side: (n, 3) handles of their parents.
    """
    grown = branches.parent[rows] >= 0
    base, frame = np.zeros((len(grown), 3)), np.tile(ROOT_FRAME, (len(grown), 1, 1))
    t = branches.attach[rows][grown].astype(np.float64)
    base[grown], frame[grown] = curve_frame(parent_points[grown], parent_side[grown], t)
    legs = np.einsum("nij,njk->nik", branches.legs[rows].astype(np.float64), frame)
    points = np.concatenate([base[:, None], base[:, None] + np.cumsum(legs, axis=1)], axis=1)
    return points, np.einsum("nj,njk->nk", branches.side[rows].astype(np.float64), frame)


def bend(points: Doubles, factor: Doubles, weights: tuple[float, float]) -> Doubles:
    """(n, 4, 3) branches bent by factors (n, 3), every leg as long as it was.

    Skjermo eq. 17 with the leg's length restored: P'_i = P'_(i-1) + l_i normalize(d_i + l_i b_i) (C1.10), where the
    third leg first turns with the second. P0 and P1 stay, for the branch is clamped in its parent (C1.12). The curve
    itself cuts the corner of its legs: with ``beam`` it is 2 % shorter at 31 degrees and 4 % at 45, and its
    curvature falls from base to tip up to 33 degrees.
    """
    legs = np.diff(points, axis=1)
    length = np.linalg.norm(legs, axis=2, keepdims=True)
    second, third = legs[:, 1] / length[:, 1], legs[:, 2] / length[:, 2]
    bent_second = turned_towards(second, weights[0] * factor)
    carried = _rotated(third, second, bent_second)
    bent_third = turned_towards(carried, (weights[1] - weights[0]) * factor)
    shift = length[:, 1] * (bent_second - second)
    bent = points.copy()
    bent[:, 2] += shift
    bent[:, 3] += shift + length[:, 2] * (bent_third - third)
    return bent


def turned_towards(direction: Doubles, b: Doubles) -> Doubles:
    """(n, 3) normalize(d + b) for unit vectors d, with the part of b along d held above FOLD."""
    along = _dot(direction, b)
    return _unit(direction + b + (np.maximum(along, FOLD) - along) * direction)


def step_lagged(
    branches: Branches, before: BranchPose, factor: Doubles, weights: tuple[float, float]
) -> BranchPose:
    """One pass over all branches at once: each follows its parent as it was before the step (section 4.2)."""
    parents = np.maximum(branches.parent, 0)
    rows = slice(0, branches.branch_count)
    points, side = attach(
        branches, rows, before.points[parents].astype(np.float64), before.side[parents].astype(np.float64)
    )
    return _pose(bend(points, factor, weights), side)


def step_ordered(branches: Branches, factor: Doubles, weights: tuple[float, float]) -> BranchPose:
    """Level by level, so that each branch follows its parent as it is now (C1.13)."""
    points, side = np.zeros((branches.branch_count, 4, 3)), np.zeros((branches.branch_count, 3))
    for first, end in pairwise(branches.level_start):
        rows = slice(int(first), int(end))
        parents = np.maximum(branches.parent[rows], 0)
        unbent, side[rows] = attach(branches, rows, points[parents], side[parents])
        points[rows] = bend(unbent, factor[rows], weights)
    return _pose(points, side)


def attachment_gap(branches: Branches, pose: BranchPose) -> Doubles:
    """(R,) distance from each branch's base to the point of its parent's curve that it grows out of, m."""
    child = np.flatnonzero(branches.parent >= 0)
    parent, t = branches.parent[child], branches.attach[child, None].astype(np.float64)
    s = 1.0 - t
    weights = np.stack([s**3, 3 * s * s * t, 3 * s * t * t, t**3], axis=1)
    on_parent = np.sum(weights * pose.points[parent], axis=1)
    gap = np.zeros(branches.branch_count)
    gap[child] = np.linalg.norm(pose.points[child, 0] - on_parent, axis=1)
    return gap


def _rotated(v: Doubles, before: Doubles, after: Doubles) -> Doubles:
    """(n, 3) vectors turned by the least rotation that takes unit vectors ``before`` to ``after``."""
    axis = np.cross(before, after)
    once = np.cross(axis, v)
    return v + once + np.cross(axis, once) / (1.0 + _dot(before, after))


def _pose(points: Doubles, side: Doubles) -> BranchPose:
    return BranchPose(points.astype(np.float32), side.astype(np.float32))


def _dot(a: Doubles, b: Doubles) -> Doubles:
    """(n, 1) scalar products."""
    return np.sum(a * b, axis=1, keepdims=True)


def _unit(v: Doubles) -> Doubles:
    return v / np.linalg.norm(v, axis=1, keepdims=True)
