"""join: attaches every cylinder to the axis of its parent (PHYSICS, measured tree T14)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.plants.scans.cylinders import Cylinders, Reals

SNAP = 0.02
"""A child that starts this near an end of its parent, as a fraction of its length, starts at the end."""
SHORTEST = 1e-3
"""No joined cylinder is shorter, m: float32 could not hold its direction."""


@dataclass(frozen=True, slots=True)
class Joined:
    """C cylinders as straight rods that hang together."""

    base: Reals
    """(C, 3) on the parent's axis, m."""
    tip: Reals
    """(C, 3) the cylinder's own end, m."""
    attach: Reals
    """(C,) where the base lies on the parent's rod, 0..1; 0 for a root."""


def join(cylinders: Cylinders) -> Joined:
    """Rods that start at the projection of their cylinder's start on the parent's rod and run to its own end.

    Args:
        cylinders: repaired: unit axes, parents first.
    """
    base, tip = cylinders.start.copy(), cylinders.end
    attach = np.zeros(cylinders.count)
    for child in range(cylinders.count):
        up = cylinders.parent[child]
        if up >= 0:
            along = tip[up] - base[up]
            share = float((cylinders.start[child] - base[up]) @ along / (along @ along))
            attach[child] = _snapped(share)
            base[child] = base[up] + attach[child] * along
        if np.linalg.norm(tip[child] - base[child]) < SHORTEST:
            tip[child] = base[child] + max(cylinders.length[child], SHORTEST) * cylinders.axis[child]
    return Joined(base, tip, attach)


def _snapped(share: float) -> float:
    """Place along the parent, at an end where it is near one."""
    if share <= SNAP:
        return 0.0
    return 1.0 if share >= 1.0 - SNAP else share
