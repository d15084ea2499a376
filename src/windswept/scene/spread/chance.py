"""Random numbers by name: each belongs to a key, an index and a draw, whichever thread asks for it first."""

from __future__ import annotations

import numpy as np
from numba import njit

GOLDEN = np.uint64(0x9E3779B97F4A7C15)
FIRST, SECOND = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
DRAWS = 8
"""Numbers that one index may draw."""


@njit(cache=True)
def chance(key: np.uint64, index: int, draw: int) -> float:
    """Uniform in 0..1: the SplitMix64 generator (Steele, Lea and Flood 2014), entered at any step.

    Args:
        key: of a purpose and a round.
        index: of the plant or seed.
        draw: which of its numbers, below DRAWS.
    """
    z = key + GOLDEN * np.uint64(index * DRAWS + draw + 1)
    z = (z ^ (z >> np.uint64(30))) * FIRST
    z = (z ^ (z >> np.uint64(27))) * SECOND
    z = z ^ (z >> np.uint64(31))
    return np.float64(z >> np.uint64(11)) * 2.0**-53
