"""What `bend` moves: every stem of every placed plant as one cubic Bezier on its parent's curve (Skjermo 2007)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from windswept.plants.plant import Floats, Ints

Doubles = NDArray[np.float64]

ROOT_FRAME = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]])
"""(3, 3) rows U, S, T = S x U of the ground, in which the legs of roots are written."""


@dataclass(frozen=True, slots=True)
class Branches:
    """R branches of P placed plants, level by level, and within a level by parent.

    A branch is written in the frame (U, S, T) of its parent's curve where it grows out: U along the curve, S and T
    the deformer's handles there, T = S x U. So the angle at which it leaves its parent is a constant.
    """

    parent: Ints
    """(R,) parent branch, smaller than the branch's own number; -1 at a root."""
    level_start: Ints
    """(D+1,) branches of level d are ``level_start[d]:level_start[d+1]``."""
    attach: Floats
    """(R,) parameter on the parent's curve at which the branch grows out; 0 for a root."""
    legs: Floats
    """(R, 3, 3) the legs P1-P0, P2-P1, P3-P2 of its control polygon at rest, in the parent's frame there, m."""
    side: Floats
    """(R, 3) its handle S0 in the same frame, unit, perpendicular to the first leg."""
    flexibility: Floats
    """(R,) bend factor b per squared speed of the air at its tip, 1/(m/s)^2."""
    tip: Floats
    """(R, 3) tip at rest: x, y in the world and height above the plant's root, m. Here the wind is sampled."""
    origin: Floats
    """(R, 3) base of its trunk in the world, m; control points are relative to it, so that far plants lose nothing."""
    stem: Ints
    """(R,) stem of the plant that the branch draws."""
    placement: Ints
    """(R,) placement that it belongs to, 0..P-1."""

    @property
    def branch_count(self) -> int:
        """Number of branches, R."""
        return len(self.parent)

    @property
    def level_count(self) -> int:
        """Number of levels, D."""
        return len(self.level_start) - 1


@dataclass(frozen=True, slots=True)
class BranchPose:
    """Where R branches are now, relative to the bases of their trunks."""

    points: Floats
    """(R, 4, 3) control points, m."""
    side: Floats
    """(R, 3) handle S0, unit."""


NOTHING = Branches(
    parent=np.zeros(0, np.int32),
    level_start=np.zeros(1, np.int32),
    attach=np.zeros(0, np.float32),
    legs=np.zeros((0, 3, 3), np.float32),
    side=np.zeros((0, 3), np.float32),
    flexibility=np.zeros(0, np.float32),
    tip=np.zeros((0, 3), np.float32),
    origin=np.zeros((0, 3), np.float32),
    stem=np.zeros(0, np.int32),
    placement=np.zeros(0, np.int32),
)
"""Not a single branch."""


def place_branches(kinds: Sequence[Branches], kind: Ints, position: Floats, yaw: Floats) -> Branches:
    """Branches of a whole scene.

    Args:
        kinds: one plant each, as ``plant_branches`` gives them.
        kind: (P,) which of them each placement is.
        position: (P, 3) roots in the world, m.
        yaw: (P,) turn about +Z, rad.

    Returns:
        No branches and no level where nothing is placed.
    """
    copies = [_placed(kinds[k], *place) for k, *place in zip(kind, position, yaw, strict=True)] or [NOTHING]
    first = np.concatenate([[0], np.cumsum([copy.branch_count for copy in copies])])
    level = np.concatenate([_level_of(copy) for copy in copies])
    # Stable: a plant's own rows are sorted by parent already, and placements follow one another in every level.
    order = np.argsort(level, kind="stable")
    row = np.empty_like(order)
    row[order] = np.arange(len(order))
    joined = {
        field.name: np.concatenate([getattr(copy, field.name) for copy in copies])[order]
        for field in fields(Branches)
        if field.name not in ("parent", "level_start", "placement")
    }
    shifted = np.concatenate(
        [np.where(copy.parent < 0, -1, copy.parent + at) for copy, at in zip(copies, first, strict=False)]
    )[order]
    placement = np.repeat(np.arange(len(copies)), np.diff(first))[order]
    return Branches(
        parent=np.where(shifted < 0, -1, row[shifted]).astype(np.int32),
        level_start=np.searchsorted(level[order], np.arange(level.max(initial=-1) + 2)).astype(np.int32),
        placement=placement.astype(np.int32),
        **joined,
    )


def _level_of(branches: Branches) -> Ints:
    """(R,) level of each branch."""
    return np.repeat(np.arange(branches.level_count, dtype=np.int32), np.diff(branches.level_start))


def _placed(branches: Branches, position: Floats, yaw: float) -> Branches:
    """One plant's branches turned by ``yaw`` and put at ``position`` (3,)."""
    cosine, sine = np.cos(yaw), np.sin(yaw)
    turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    # Only roots are written in a frame that does not turn with the plant.
    in_frame = ROOT_FRAME @ turn @ ROOT_FRAME.T
    root = branches.parent < 0
    legs, side, tip = branches.legs.copy(), branches.side.copy(), branches.tip.copy()
    legs[root] = legs[root] @ in_frame.T
    side[root] = side[root] @ in_frame.T
    tip[:, :2] = tip[:, :2] @ turn[:2, :2].T + position[:2]
    origin = (branches.origin @ turn.T + position).astype(np.float32)
    return Branches(
        parent=branches.parent,
        level_start=branches.level_start,
        attach=branches.attach,
        legs=legs,
        side=side,
        flexibility=branches.flexibility,
        tip=tip,
        origin=origin,
        stem=branches.stem,
        placement=branches.placement,
    )
