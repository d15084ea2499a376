"""Branches as the card holds them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from windswept.geometry.geometry import Geometry
from windswept.gpu.bend import layouts
from windswept.gpu.layouts import NONE
from windswept.gpu.plant_buffers import Kind
from windswept.motion.bend_branches import Branches
from windswept.plants.plant import Floats, Ints
from windswept.wind.mean import Profile, profile_factor

Rows = NDArray[np.void]


def branch_rows(branches: Branches) -> Rows:
    """(R,) ``BRANCH`` rows; scale, stem and look are filled in by those who know them."""
    rows = np.zeros(branches.branch_count, layouts.BRANCH)
    length = np.linalg.norm(branches.legs.astype(np.float64), axis=2)
    rows["leg0"][:, :3] = branches.legs[:, 0]
    rows["leg0"][:, 3] = branches.attach
    for name, leg in (("leg1", 1), ("leg2", 2)):
        rows[name][:, :3] = branches.legs[:, leg] / length[:, leg, None]
        rows[name][:, 3] = length[:, leg]
    rows["side"][:, :3] = branches.side
    rows["tip"][:, :2] = branches.tip[:, :2]
    rows["rows"][:, 0] = np.where(branches.parent < 0, NONE, branches.parent)
    return rows


def bend_scale(branches: Branches, profile: Profile) -> Floats:
    """(R,) bend factor per squared wind at the profile's reference height, 1/(m/s)^2."""
    height = profile_factor(profile, branches.tip[:, 2])
    return np.asarray(branches.flexibility * height * height, np.float32)


def branch_look_rows(
    branches: Branches, geometries: Sequence[Geometry], kinds: Sequence[Kind], kind: Ints
) -> tuple[Rows, Rows]:
    """(R,) ``BRANCH_LOOK`` rows and (R, 4) the ``rows`` of ``BRANCH``: how every branch is drawn.

    Args:
        branches: of P placements.
        geometries: drawn form of each kind: radii, flare, lobes and bulges of its stems are kept, its curves not.
        kinds: where each kind's stems lie on the card.
        kind: (P,) which kind each placement is.
    """
    looks = np.zeros(branches.branch_count, layouts.BRANCH_LOOK)
    rows = branch_rows(branches)["rows"].copy()
    looks["origin"][:, :3] = branches.origin
    looks["origin"][:, 3] = (branches.placement * 0.7548776662) % 1.0
    of_branch = kind[branches.placement]
    for number, (geometry, card) in enumerate(zip(geometries, kinds, strict=True)):
        own = of_branch == number
        stem = branches.stem[own]
        looks["shade"][own, 0] = geometry.piece_openness[geometry.stem_piece_start[stem], 0]
        looks["shade"][own, 1] = geometry.piece_openness[geometry.stem_piece_start[stem + 1] - 1, 1]
        rows[own, 1] = card.stem_first + card.pose.stem_rank[stem]
        rows[own, 2] = number
    return looks, rows
