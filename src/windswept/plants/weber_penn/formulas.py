"""Weber and Penn's plain formulas: crown shapes, pruning envelope, counts."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from windswept.plants.species_form import Growth

Reals = NDArray[np.float64]

LENGTH_FALL = 0.6
"""How much of its offset a child of order 2 and more lacks in length (Weber and Penn 4.3)."""
ENVELOPE = 8
"""Shape number of the pruning envelope."""


def shape_ratio(shape: int, ratio: ArrayLike, growth: Growth | None = None) -> Reals:
    """ShapeRatio: relative length of a branch at a height of the crown.

    Args:
        shape: Shape, 0..8.
        ratio: 1 at the crown's foot, 0 at its top.
        growth: the pruning parameters, for shape 8 only.
    """
    r = np.asarray(ratio, np.float64)
    if shape == ENVELOPE:
        if growth is None:
            raise ValueError("shape 8 needs the pruning parameters")
        return envelope_ratio(r, growth.prune_width_peak, growth.prune_power_low, growth.prune_power_high)
    flame = np.where(r <= 0.7, r / 0.7, (1.0 - r) / 0.3)
    by_shape = (
        0.2 + 0.8 * r,
        0.2 + 0.8 * np.sin(np.pi * r),
        0.2 + 0.8 * np.sin(0.5 * np.pi * r),
        np.ones_like(r),
        0.5 + 0.5 * r,
        flame,
        1.0 - 0.8 * r,
        0.5 + 0.5 * flame,
    )
    return np.asarray(by_shape[shape])


def envelope_ratio(ratio: ArrayLike, peak: float, power_low: float, power_high: float) -> Reals:
    """Width of the pruning envelope, 0 outside it.

    Args:
        ratio: 1 at the crown's foot, 0 at its top.
        peak: PruneWidthPeak.
        power_low: PrunePowerLow.
        power_high: PrunePowerHigh.
    """
    r = np.asarray(ratio, np.float64)
    inside = (r >= 0.0) & (r <= 1.0)
    height = np.where(inside, r, 0.5)
    above = 1.0 - peak
    width = np.where(height < above, (height / above) ** power_high, ((1.0 - height) / above) ** power_low)
    return np.where(inside, width, 0.0)


def child_length(parent_length: ArrayLike, offset: ArrayLike, longest: ArrayLike) -> Reals:
    """Length of a stem of order 2 or more, m.

    Args:
        parent_length: length of its parent, m.
        offset: where it stands along its parent, m.
        longest: its drawn nLength.
    """
    return np.asarray(longest) * (np.asarray(parent_length) - LENGTH_FALL * np.asarray(offset))


def child_radius(parent_radius: ArrayLike, length_ratio: ArrayLike, ratio_power: float) -> Reals:
    """Base radius of a child stem, m, before it is held below its parent's radius at that place."""
    return np.asarray(parent_radius) * np.asarray(length_ratio, np.float64) ** ratio_power


def child_count(order: int, branches: int, relative_length: ArrayLike, offset_ratio: ArrayLike) -> Reals:
    """Mean number of child stems on one stem.

    Args:
        order: order of the children, 1..3.
        branches: nBranches of that order.
        relative_length: (L_stem / L_parent of the stem) / nLength of the stem's order.
        offset_ratio: where the stem itself stands along its parent, 0..1.
    """
    if order == 1:
        return np.full(np.shape(relative_length), float(branches))
    if order == 2:
        return branches * (0.2 + 0.8 * np.asarray(relative_length, np.float64))
    return branches * (1.0 - 0.5 * np.asarray(offset_ratio, np.float64))
