"""The two nouns that the steps of growing hand each other: stems about to grow, and stems grown."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Shoots:
    """F stems about to grow."""

    parent_stem: Indices
    parent_link: Indices
    attach: Reals
    """(F,) where they stand along the parent link, 0..1."""
    base: Reals
    """(F, 3) where they stand, m."""
    frame: Reals
    """(F, 3, 3) their first frame."""
    length: Reals
    """(F,) length before pruning, m."""
    offset_ratio: Reals
    """(F,) where they stand along the parent stem, 0..1."""
    parent_length: Reals
    """(F,) m."""
    parent_radius: Reals
    """(F,) base radius of the parent stem without 0Scale, m."""
    radius_limit: Reals
    """(F,) radius of the parent where they stand, m."""


@dataclass(frozen=True, slots=True)
class Wood:
    """The S stems and L links of one order; parents are numbered through all orders, in the order of growth."""

    order: int
    first_stem: int
    """Number of this order's first stem among those of all orders."""
    first_link: int
    """Number of this order's first link among those of all orders."""
    stem_parent: Indices
    stem_length: Reals
    """(S,) full length, for a clone that of the stem it continues, m."""
    stem_start: Reals
    """(S,) Z at which a clone begins, else 0."""
    stem_radius: Reals
    """(S,) base radius before flare, m."""
    stem_offset_ratio: Reals
    """(S,) where the stem stands along its parent, 0..1; 1 for trunks, which so bear leaves to the full."""
    stem_length_ratio: Reals
    """(S,) length over the parent's length."""
    stem_link_count: Indices
    link_parent: Indices
    link_attach: Reals
    link_stem: Indices
    """(L,) stem, counted from this order's first."""
    link_base: Reals
    link_tip: Reals
    link_frame: Reals
    """(L, 3, 3) frame whose z is the link's axis."""
    link_density: Reals
    """(L,) child stems per metre against an unsplit stem."""
    link_z_base: Reals
    """(L,) distance of the link's base from the stem's base, along the unsplit stem, m."""
    link_z_tip: Reals
    link_radius_base: Reals
    link_radius_tip: Reals
