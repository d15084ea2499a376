"""Plot: the piece of ground that a spread covers, with what grows there by nature: nothing yet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.scene.area import Area
from windswept.scene.spread.cells import Grid
from windswept.scene.spread.nutrients import Nutrient
from windswept.scene.terrain import Terrain

Reals = NDArray[np.float64]

FINEST_CELL, MOST_CELLS = 0.4, 400
"""Edge of a cell, m, unless the plot is so large that it would have more cells a side than this."""


@dataclass(frozen=True, slots=True)
class Plot:
    """R x C cells of ground with M nutrients."""

    terrain: Terrain
    low: Reals
    """(2,) south-western corner, m."""
    high: Reals
    """(2,) north-eastern corner, m."""
    grid: Grid
    supply: Reals
    """(M, R, C) nutrients of the untouched ground, amount a square metre."""
    is_open: NDArray[np.bool_]
    """(R, C) whether plants may spread to the cell."""


def build_plot(terrain: Terrain, nutrients: list[Nutrient], area: Area | None = None) -> Plot:
    """The ground of a spread.

    Args:
        terrain: heights.
        nutrients: M of them.
        area: cells that are wholly inside are open; None: all ground.
    """
    half = 0.5 * terrain.size
    low, high = area.bounds if area is not None else (np.full(2, -half), np.full(2, half))
    extent = high - low
    cell = max(FINEST_CELL, float(extent.max()) / MOST_CELLS)
    columns, rows = (max(int(np.ceil(side / cell)), 1) for side in extent)
    grid = Grid(float(low[0]), float(low[1]), cell, rows, columns)
    x, y = middles(grid)
    supply = np.array([nutrient.amount(x, y) for nutrient in nutrients]).reshape(-1, rows, columns)
    is_open = np.ones((rows, columns), bool) if area is None else _inside(area, grid)
    return Plot(terrain, low, high, grid, supply, is_open)


def middles(grid: Grid) -> tuple[Reals, Reals]:
    """(R, C) x and y of the middles of cells, m."""
    x = grid.west + (np.arange(grid.columns) + 0.5) * grid.cell
    y = grid.south + (np.arange(grid.rows) + 0.5) * grid.cell
    across, up = np.meshgrid(x, y)
    return across, up


def _inside(area: Area, grid: Grid) -> NDArray[np.bool_]:
    """(R, C) whether all four corners of a cell lie in the area."""
    x = grid.west + np.arange(grid.columns + 1) * grid.cell
    y = grid.south + np.arange(grid.rows + 1) * grid.cell
    across, up = np.meshgrid(x, y)
    corner = area.contains(np.stack([across.ravel(), up.ravel()], axis=1)).reshape(across.shape)
    return np.asarray(corner[:-1, :-1] & corner[1:, :-1] & corner[:-1, 1:] & corner[1:, 1:])
