"""Cells: what the ground of a spread still holds, and the light that reaches it.

A plant takes its nutrients from the cells that its roots reach, in proportion to what they hold, and its crown
shades the same cells for every lower species, which get exp(-depth) of the light (Beer and Lambert's law).
Kernels here are called millions of times: they take plain arrays, as Numba counts references to those in tuples.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from windswept.scene.spread.ecology import Ecology

Reals = NDArray[np.float64]
Floats = NDArray[np.float32]

LEAST_REACH = 0.75
"""Roots reach at least this far, in cells: the middle of one cell is always within it."""


class Grid(NamedTuple):
    """R x C square cells; a tuple of numbers, which kernels take as it is."""

    west: float
    """Western edge, m."""
    south: float
    """Southern edge, m."""
    cell: float
    """Edge of a cell, m."""
    rows: int
    columns: int


@dataclass(frozen=True, slots=True)
class Cells:
    """What changes from plant to plant."""

    left: Reals
    """(R, C, M) amount of each nutrient left in a cell."""
    depth: Floats
    """(R, C, S) optical depth of all crowns higher than the species."""


def fresh_cells(grid: Grid, ecology: Ecology, supply: Reals) -> Cells:
    """Untouched ground under an open sky."""
    left = np.ascontiguousarray(np.moveaxis(supply, 0, -1)) * grid.cell**2
    return Cells(left, np.zeros((grid.rows, grid.columns, ecology.count), np.float32))


@njit(cache=True)
def row_of(grid: Grid, y: float) -> int:
    """Row of a place; the nearest one outside the grid."""
    return min(max(int((y - grid.south) / grid.cell), 0), grid.rows - 1)


@njit(cache=True)
def column_of(grid: Grid, x: float) -> int:
    """Column of a place; the nearest one outside the grid."""
    return min(max(int((x - grid.west) / grid.cell), 0), grid.columns - 1)


@njit(cache=True)
def cells_reached(grid: Grid, reach: float) -> float:
    """How far the roots look for the middles of cells, m."""
    return max(reach, LEAST_REACH * grid.cell)


@njit(cache=True)
def rows_within(grid: Grid, y: float, reach: float) -> tuple[int, int]:
    """First row whose middle is within reach of a place, and the one after the last."""
    first = math.ceil((y - reach - grid.south) / grid.cell - 0.5)
    stop = math.floor((y + reach - grid.south) / grid.cell - 0.5) + 1
    return max(int(first), 0), min(int(stop), grid.rows)


@njit(cache=True)
def columns_within(grid: Grid, x: float, y: float, reach: float, row: int) -> tuple[int, int]:
    """As rows_within, for the columns of one of these rows."""
    up = grid.south + (row + 0.5) * grid.cell - y
    half = math.sqrt(max(reach * reach - up * up, 0.0))
    first = math.ceil((x - half - grid.west) / grid.cell - 0.5)
    stop = math.floor((x + half - grid.west) / grid.cell - 0.5) + 1
    return max(int(first), 0), min(int(stop), grid.columns)


@njit(cache=True)
def amount_within(grid: Grid, left: Reals, nutrient: int, x: float, y: float, reach: float) -> float:
    """Sum of a nutrient over the cells within reach."""
    total = 0.0
    first_row, stop_row = rows_within(grid, y, reach)
    for row in range(first_row, stop_row):
        first, stop = columns_within(grid, x, y, reach, row)
        for column in range(first, stop):
            total += left[row, column, nutrient]
    return total


@njit(cache=True)
def is_fed(grid: Grid, left: Reals, need: Reals, species: int, x: float, y: float, reach: float) -> bool:
    """Whether the ground within reach still holds all that a plant takes."""
    for nutrient in range(need.shape[1]):
        demand = need[species, nutrient] * math.pi * reach * reach
        if demand > 0.0 and amount_within(grid, left, nutrient, x, y, cells_reached(grid, reach)) < demand:
            return False
    return True


@njit(cache=True)
def take_up(grid: Grid, left: Reals, need: Reals, species: int, x: float, y: float, reach: float) -> None:
    """A plant takes its nutrients, or what there is of them: the same part of every cell within reach."""
    for nutrient in range(need.shape[1]):
        demand = need[species, nutrient] * math.pi * reach * reach
        if demand == 0.0:
            continue
        roots = cells_reached(grid, reach)
        there = amount_within(grid, left, nutrient, x, y, roots)
        kept = max(1.0 - demand / max(there, 1e-30), 0.0)
        first_row, stop_row = rows_within(grid, y, roots)
        for row in range(first_row, stop_row):
            first, stop = columns_within(grid, x, y, roots, row)
            for column in range(first, stop):
                left[row, column, nutrient] *= kept


@njit(cache=True)
def cast_shade(
    grid: Grid, depth: Floats, shade: Reals, height: Reals, species: int, x: float, y: float, reach: float
) -> None:
    """A crown's depth times its content, spread over the cells within reach, for all lower species."""
    count = 0
    crown = cells_reached(grid, reach)
    first_row, stop_row = rows_within(grid, y, crown)
    for row in range(first_row, stop_row):
        first, stop = columns_within(grid, x, y, crown, row)
        count += max(stop - first, 0)
    cover = math.pi * reach * reach / (max(count, 1) * grid.cell**2)
    more = np.float32(shade[species] * min(cover, 1.0))
    for row in range(first_row, stop_row):
        first, stop = columns_within(grid, x, y, crown, row)
        for column in range(first, stop):
            for lower in range(len(height)):
                if height[lower] < height[species]:
                    depth[row, column, lower] += more


@njit(cache=True)
def is_lit(grid: Grid, depth: Floats, deepest: Reals, species: int, x: float, y: float) -> bool:
    """Whether what taller plants leave of the light suits a plant."""
    there = depth[row_of(grid, y), column_of(grid, x), species]
    return deepest[species, 0] <= there <= deepest[species, 1]
