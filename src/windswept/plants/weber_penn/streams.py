"""Named streams of random numbers, so that drawing more of one quantity never changes another."""

from __future__ import annotations

from zlib import crc32

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]


class Streams:
    """One independent generator for every quantity of every branching order of one plant."""

    def __init__(self, seed: int) -> None:
        self._seed = seed

    def generator(self, name: str, order: int = 0) -> np.random.Generator:
        """The stream of a quantity from its start.

        Args:
            name: what is drawn.
            order: branching order of the stems it is drawn for.
        """
        return np.random.default_rng(
            np.random.SeedSequence(self._seed, spawn_key=(crc32(name.encode()), order))
        )

    def vary(self, name: str, order: int, spread: float, count: int) -> Reals:
        """(count,) uniform in -spread..spread: Weber and Penn's "V"."""
        return vary(self.generator(name, order), spread, count)


def vary(generator: np.random.Generator, spread: float, count: int) -> Reals:
    """(count,) uniform in -spread..spread, from a stream that is drawn from several times."""
    return generator.uniform(-1.0, 1.0, count) * spread
