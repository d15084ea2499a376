"""Cylinders: a quantitative structure model of a scanned tree, a row for each cylinder."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Cylinders:
    """C cylinders of one tree."""

    radius: Reals
    """(C,) m."""
    length: Reals
    """(C,) m."""
    start: Reals
    """(C, 3) m."""
    axis: Reals
    """(C, 3) direction from start to end; of unit length once repaired."""
    parent: Indices
    """(C,) cylinder it grows from, -1 for a root; smaller than its own index once repaired."""

    @property
    def count(self) -> int:
        """Number of cylinders, C."""
        return len(self.radius)

    @property
    def end(self) -> Reals:
        """(C, 3) m."""
        return self.start + self.length[:, None] * self.axis

    def rows(self, kept: Indices) -> Cylinders:
        """Some of the cylinders in a new order; the parent of a kept one is kept too."""
        place = np.full(self.count + 1, -1)
        place[kept] = np.arange(len(kept))
        parent = place[self.parent[kept]]
        return Cylinders(self.radius[kept], self.length[kept], self.start[kept], self.axis[kept], parent)

    def with_parents(self, parent: Indices) -> Cylinders:
        """The same with other parents."""
        return replace(self, parent=parent)
