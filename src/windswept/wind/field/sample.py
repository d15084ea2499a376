"""sample: what a field adds to the wind at points."""

from __future__ import annotations

import numpy as np
from numba import njit, prange

from windswept.wind.field.field import Field
from windswept.wind.field.flows import FAST_MATH
from windswept.wind.field.grid import Floats

BLOCK = 512
"""Points that a thread takes at a time."""
_F = np.float32


def sample(field: Field, points: Floats, height: Floats) -> Floats:
    """What the field adds to its wind at points: the air there is the sum of both.

    Args:
        field: at its time.
        points: (N, 3) float32 world positions, m; only x and y are read.
        height: (N,) float32 height of each point above the ground, m; below it counts as on it.

    Returns:
        (N, 3) float32, m/s, trilinear between nodes; 0 outside the field.
    """
    grid = field.plan.grid
    out = np.zeros((len(points), 3), np.float32)
    frame = np.array([*grid.origin, *(1.0 / cell for cell in grid.cell)], np.float32)
    _sample(field.velocity, field.ambient, field.profile, frame, points, height, out)
    return out


@njit(parallel=True, cache=True, fastmath=FAST_MATH)
def _sample(velocity, ambient, profile, frame, points, height, out):  # type: ignore[no-untyped-def]
    """Blocks of points over the threads."""
    for block in prange((len(points) + BLOCK - 1) // BLOCK):
        for p in range(block * BLOCK, min((block + 1) * BLOCK, len(points))):
            x = (points[p, 0] - frame[0]) * frame[2]
            y = (points[p, 1] - frame[1]) * frame[3]
            z = max(height[p], _F(0.0)) * frame[4]
            _add_point(velocity, ambient, profile, x, y, z, out[p])


@njit(cache=True, fastmath=FAST_MATH)
def _add_point(velocity, ambient, profile, x, y, z, out):  # type: ignore[no-untyped-def]
    """One point, its place counted in cells; what is outside, or no number, is left at 0."""
    nx, ny, nz = velocity.shape[:3]
    if not (x >= 0.0 and x <= nx - 1 and y >= 0.0 and y <= ny - 1 and z >= 0.0 and z <= nz - 1):
        return
    i, j, k = min(int(x), nx - 2), min(int(y), ny - 2), min(int(z), nz - 2)
    u, v, w = x - _F(i), y - _F(j), z - _F(k)
    for di in range(2):
        for dj in range(2):
            for dk in range(2):
                weight = (u if di else _F(1.0) - u) * (v if dj else _F(1.0) - v) * (w if dk else _F(1.0) - w)
                for c in range(3):
                    wind = ambient[i + di, j + dj, c] * profile[k + dk]
                    out[c] += weight * (velocity[i + di, j + dj, k + dk, c] - wind)
