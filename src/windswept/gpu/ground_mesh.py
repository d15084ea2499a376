"""Terrain heights -> one grid mesh that runs on to the horizon, finer where the terrain is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.gpu.frame import Ground
from windswept.plants.plant import Floats, Ints

Doubles = NDArray[np.float64]

HORIZON = 6000.0
"""Half the side of the drawn ground, m."""
FINEST = 96
"""Most grid lines spent on the terrain itself, along each axis."""
SKIRT_LINES = 26
"""Grid lines between the terrain's edge and the horizon, on each side."""
HILL_HEIGHT = 240.0
"""Of the hills near the horizon, m."""


@dataclass(frozen=True, slots=True)
class GroundMesh:
    """Triangles of the ground."""

    vertices: Floats
    """(V, 6) position, m, and unit normal."""
    triangles: Ints
    """(T, 3) vertex numbers."""


def ground_mesh(ground: Ground) -> GroundMesh:
    """Mesh of the terrain, level with its edge beyond it and rising to hills towards the horizon."""
    rows, columns = ground.height.shape
    x = _lines(ground.origin[0], ground.spacing, columns)
    y = _lines(ground.origin[1], ground.spacing, rows)
    z = ground_height(ground, x[None, :], y[:, None]) + _hills(ground, x[None, :], y[:, None])
    slope_y, slope_x = np.gradient(z, y, x)
    normal = np.stack([-slope_x, -slope_y, np.ones_like(z)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    position = np.stack([*np.broadcast_arrays(x[None, :], y[:, None]), z], axis=-1)
    vertices = np.concatenate([position, normal], axis=-1).reshape(-1, 6)
    return GroundMesh(vertices.astype(np.float32), _triangles(len(y), len(x)))


def ground_height(ground: Ground, x: Doubles, y: Doubles) -> Doubles:
    """Height of the ground at x, y (arrays that broadcast), bilinear; level beyond the edge, m."""
    rows, columns = ground.height.shape
    column = np.clip((x - ground.origin[0]) / ground.spacing, 0.0, columns - 1.0)
    row = np.clip((y - ground.origin[1]) / ground.spacing, 0.0, rows - 1.0)
    j, i = np.minimum(column.astype(int), columns - 2), np.minimum(row.astype(int), rows - 2)
    u, v = column - j, row - i
    low = (1.0 - u) * ground.height[i, j] + u * ground.height[i, j + 1]
    high = (1.0 - u) * ground.height[i + 1, j] + u * ground.height[i + 1, j + 1]
    return (1.0 - v) * low + v * high


def _lines(origin: float, spacing: float, count: int) -> Doubles:
    """Grid lines along one axis: even over the terrain, ever wider out to the horizon."""
    inside = np.linspace(origin, origin + spacing * (count - 1), min(count, FINEST) if count > 2 else 24)
    step = inside[1] - inside[0]
    out = np.geomspace(step, HORIZON, SKIRT_LINES)
    return np.concatenate([inside[0] - out[::-1], inside, inside[-1] + out])


def _hills(ground: Ground, x: Doubles, y: Doubles) -> Doubles:
    """Gentle hills that begin well beyond the terrain, m."""
    rows, columns = ground.height.shape
    middle = np.asarray(ground.origin) + 0.5 * ground.spacing * np.array([columns - 1, rows - 1])
    half = 0.5 * ground.spacing * max(columns, rows)
    away = np.hypot(x - middle[0], y - middle[1])
    rise = np.clip((away - 1.5 * half - 150.0) / 2500.0, 0.0, 1.0)
    bearing = np.arctan2(y - middle[1], x - middle[0])
    waves = 0.55 + 0.25 * np.sin(3.0 * bearing + 0.7) + 0.2 * np.sin(7.0 * bearing + away / 900.0)
    return HILL_HEIGHT * rise**1.5 * waves + 6.0 * rise**0.5 * np.sin(x / 130.0) * np.cos(y / 170.0)


def _triangles(rows: int, columns: int) -> Ints:
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + columns + 1], axis=1)
    upper = np.stack([corner, corner + columns + 1, corner + columns], axis=1)
    return np.concatenate([lower, upper]).astype(np.int32)
