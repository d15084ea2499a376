"""Ecology: what the species of a spread need, what room they take, and how they shed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Ecology:
    """S species that compete for M nutrients; lengths are those of a plant of size 1."""

    foot: Reals
    """(S,) radius of the ground that the foot fills, m."""
    spacing: Reals
    """(S,) least distance between two of the species, at least twice the foot, m."""
    reach: Reals
    """(S,) radius of crown and roots, m."""
    height: Reals
    """(S,) when grown, m."""
    size_v: Reals
    """(S,) sizes go from 1 - size_v to 1 + size_v."""
    need: Reals
    """(S, M) taken from each square metre that the roots reach."""
    shade: Reals
    """(S,) optical depth of the crown."""
    light: Reals
    """(S, 2) least and most light, parts of the open sky's."""
    slope: Reals
    """(S, 2) least and greatest tangent of the ground's slope."""
    ground: Reals
    """(S, 2) least and greatest height of the ground, m."""
    vigour: Reals
    """(S,) suitability of the best ground."""
    turnover: Reals
    """(S,) chance of death in a round where the ground does not suit at all; 0 where it suits perfectly."""
    offspring: Ints
    """(S,) seeds of a plant in a round."""
    distance: Reals
    """(S,) median distance of a seed from its parent, m."""
    most: Ints
    """(S,) most plants."""

    @property
    def count(self) -> int:
        """Number of species, S."""
        return len(self.foot)


def suitability(ecology: Ecology, supply: Reals) -> NDArray[np.float32]:
    """How well each species does on each cell: the scarcest nutrient decides.

    The least of Monod's terms supply / (supply + need) (Liebig's law of the minimum), times the species' vigour:
    a species does half as well as it can where the ground has just what it takes.

    Args:
        ecology: S species.
        supply: (M, R, C) nutrients of the untouched ground, amount a square metre.

    Returns:
        (S, R, C) 0 cannot live to 1.
    """
    fit = np.ones((ecology.count, *supply.shape[1:]))
    for species, need in enumerate(ecology.need):
        for nutrient in np.flatnonzero(need > 0.0):
            term = supply[nutrient] / (supply[nutrient] + need[nutrient])
            fit[species] = np.minimum(fit[species], term)
    return (fit * ecology.vigour[:, None, None]).astype(np.float32)
