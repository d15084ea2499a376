"""Where blades of meadow grass stand: fixed places in the world, thinned out with distance from the camera.

``lawn.py`` finds the same on the card; a test holds the two together.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.gpu import layouts
from windswept.gpu.frame import Ground
from windswept.gpu.ground_mesh import ground_height

Doubles = NDArray[np.float64]

RINGS = ((0.060, 0.0, 7.0), (0.125, 7.0, 19.0), (0.32, 19.0, 48.0))
"""Lattice spacing, inner and outer radius round the camera of each ring of blades, m."""
BLEND = 0.25
"""Share of a ring's radius over which blades shrink into the next ring."""
MARGIN = 0.5
"""How far out of the picture a blade's foot may be, m."""


def grass_field(ground: Ground, eye: Doubles, planes: Doubles) -> NDArray[np.void]:
    """(n,) ``GRASS_BLADE`` rows of the blades in sight, near rings first.

    Args:
        ground: what they stand on.
        eye: (3,) the camera, m.
        planes: (5, 4) planes of its frustum.
    """
    rings = [_ring(ground, eye, planes, *ring) for ring in RINGS]
    return np.concatenate(rings)


def ring_cells(spacing: float, inner: float, outer: float) -> int:
    """Cells of a ring's lattice from the camera's own to the last one on either side."""
    return int(np.ceil(outer * (1.0 + BLEND) / spacing))


def _ring(
    ground: Ground, eye: Doubles, planes: Doubles, spacing: float, inner: float, outer: float
) -> NDArray[np.void]:
    reach = ring_cells(spacing, inner, outer)
    middle = np.floor(eye[:2] / spacing).astype(np.int64)
    steps = np.arange(-reach, reach + 1)
    x, y = np.meshgrid(middle[0] + steps, middle[1] + steps)
    near = _in_sight(ground, planes, x * spacing, y * spacing)
    cells = np.stack([x[near], y[near]], axis=1)
    chance = _chances(cells)
    root = (cells + chance[:, :2]) * spacing
    away = np.hypot(*(root - eye[:2]).T)
    size = np.clip((outer * (1.0 + BLEND) - away) / (BLEND * outer), 0.0, 1.0)
    if inner:
        size *= np.clip((away - inner) / (BLEND * inner), 0.0, 1.0)
    grown = size > 0.0
    rows = np.zeros(int(grown.sum()), layouts.GRASS_BLADE)
    rows["root"][:, :2] = root[grown]
    rows["root"][:, 2] = ground_height(ground, *root[grown].T)
    rows["root"][:, 3] = size[grown]
    rows["chance"] = chance[grown]
    return rows


def _in_sight(ground: Ground, planes: Doubles, x: Doubles, y: Doubles) -> NDArray[np.bool_]:
    """Whether the ground at x, y lies in the frustum or within a margin of it."""
    height = ground_height(ground, x, y)
    inside = np.ones(height.shape, bool)
    for a, b, c, d in planes:
        inside &= a * x + b * y + c * height + d > -MARGIN
    return inside


def _chances(cells: NDArray[np.int64]) -> Doubles:
    """(n, 4) random numbers in 0..1 that belong to lattice cells (n, 2) for ever (an integer hash)."""
    mixed = cells[:, 0].astype(np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    mixed ^= cells[:, 1].astype(np.uint64) * np.uint64(0xC2B2AE3D27D4EB4F)
    mixed ^= mixed >> np.uint64(29)
    mixed *= np.uint64(0xBF58476D1CE4E5B9)
    mixed ^= mixed >> np.uint64(32)
    parts = [(mixed >> np.uint64(16 * k)) & np.uint64(0xFFFF) for k in range(4)]
    return np.stack(parts, axis=1) / 65536.0
