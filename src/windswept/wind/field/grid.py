"""Grid: the nodes at which a field knows the air."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError

Floats = NDArray[np.float32]
Reals = NDArray[np.float64]

MOST_NODES = 1 << 23
"""A field of so many nodes takes half a gigabyte."""


@dataclass(frozen=True, slots=True)
class Grid:
    """Nodes (i, j, k) at origin + (i dx, j dy), k dz above the ground: the grid follows the terrain."""

    origin: tuple[float, float]
    """x and y of node (0, 0), m."""
    cell: tuple[float, float, float]
    """Distance between nodes along x, y and up: dx, dy, dz, m."""
    shape: tuple[int, int, int]
    """Nodes along x, y and up: nx, ny, nz."""

    def __post_init__(self) -> None:
        self.validate()

    def validate(self) -> None:
        """Raise InputError for cells without size, fewer than 4 nodes a side, or more nodes than memory bears."""
        if not all(math.isfinite(place) for place in self.origin):
            raise InputError("field grid", "origin", self.origin, "finite numbers")
        if not all(math.isfinite(edge) and edge > 0.0 for edge in self.cell):
            raise InputError("field grid", "cell", self.cell, "lengths above 0 m")
        if min(self.shape) < 4 or math.prod(self.shape) > MOST_NODES:
            expected = f"4 nodes or more a side, at most {MOST_NODES:,} together"
            raise InputError("field grid", "shape", self.shape, expected)

    @property
    def heights(self) -> Reals:
        """(nz,) of the layers above the ground, m."""
        return self.cell[2] * np.arange(self.shape[2], dtype=np.float64)

    def ground_points(self) -> Floats:
        """(nx * ny, 3) x, y and 0 of every column of nodes, m."""
        nx, ny, _ = self.shape
        points = np.zeros((nx, ny, 3), np.float32)
        points[..., 0] = (self.origin[0] + self.cell[0] * np.arange(nx))[:, None]
        points[..., 1] = self.origin[1] + self.cell[1] * np.arange(ny)
        return points.reshape(-1, 3)

    def nodes(self) -> Reals:
        """(nx, ny, nz, 3) x, y and height above ground of every node, m."""
        nx, ny, nz = self.shape
        nodes = np.empty((nx, ny, nz, 3))
        nodes[..., 0] = (self.origin[0] + self.cell[0] * np.arange(nx))[:, None, None]
        nodes[..., 1] = (self.origin[1] + self.cell[1] * np.arange(ny))[:, None]
        nodes[..., 2] = self.heights
        return nodes

    def nearest(self, x: float, y: float, height: float) -> tuple[int, int, int]:
        """Node nearest to a place; on the border for one outside."""
        place = ((x - self.origin[0]), (y - self.origin[1]), height)
        steps = (round(p / d) for p, d in zip(place, self.cell, strict=True))
        i, j, k = (min(max(step, 0), n - 1) for step, n in zip(steps, self.shape, strict=True))
        return i, j, k
