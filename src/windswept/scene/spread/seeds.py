"""shed: every plant's seeds of one round, and which of them could grow where they fell."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from windswept.scene.spread.cells import Cells, is_fed, is_lit
from windswept.scene.spread.chance import chance
from windswept.scene.spread.claims import Stems, is_clear
from windswept.scene.spread.site import Site

Reals = NDArray[np.float64]
Floats = NDArray[np.float32]
Ints = NDArray[np.int64]
Ints32 = NDArray[np.int32]

TAIL = math.sqrt(2.0) - 1.0
"""Of the two-dimensional t distribution with shape 2: the median's square over the scale's."""
LUCK = 0.3
"""How far chance may lower the merit of one seed below its species' suitability to the place."""
AWAY_DRAW, TURN_DRAW, SIZE_DRAW, LUCK_DRAW = range(4)


@dataclass(frozen=True, slots=True)
class Parents:
    """Q plants and propagation points that shed."""

    species: Ints32
    """(Q,)"""
    x: Floats
    """(Q,) m."""
    y: Floats
    """(Q,) m."""
    first: Ints
    """(Q + 1,) number of each one's first seed, and of all seeds."""


@dataclass(frozen=True, slots=True)
class Seeds:
    """W seeds in order of their parents."""

    species: Ints32
    """(W,)"""
    x: Floats
    """(W,) m."""
    y: Floats
    """(W,) m."""
    size: Floats
    """(W,) when grown."""
    merit: Floats
    """(W,) suitability of the place less bad luck; 0 where it cannot grow."""


def shed(site: Site, cells: Cells, stems: Stems, parents: Parents, key: np.uint64) -> Seeds:
    """Seeds of one round.

    Args:
        site: the ground and the species.
        cells: what the ground holds at the start of the round.
        stems: who stands there at the start of the round.
        parents: who sheds.
        key: of the round's random numbers.
    """
    count, ecology, claims = int(parents.first[-1]), site.ecology, site.claims
    species = np.repeat(parents.species, np.diff(parents.first))
    seeds = Seeds(species, *(np.empty(count, np.float32) for _ in range(4)))
    _scatter(
        *(parents.x, parents.y, parents.species, parents.first, ecology.distance, ecology.size_v, key),
        *(seeds.x, seeds.y, seeds.size),
    )
    _judge_room(
        *(site.grid, site.fit, claims.corner, claims.edge, claims.buckets, claims.looks, claims.widest),
        *(stems.first, stems.circle, seeds.species, seeds.x, seeds.y, seeds.size, seeds.merit),
    )
    _judge_ground(
        *(site.grid, cells.left, cells.depth, ecology.need, ecology.reach, site.deepest, ecology.ground),
        *(ecology.slope, site.terrain.heights, site.rise, site.terrain.spacing, key),
        *(seeds.species, seeds.x, seeds.y, seeds.size, seeds.merit),
    )
    return seeds


@njit(parallel=True, cache=True)
def _scatter(  # type: ignore[no-untyped-def]
    parent_x, parent_y, species, first, distance, size_v, key, x, y, size
):
    """Where seeds fall: the fat-tailed 2Dt kernel of Clark et al. (1999) with shape 2; and how they will grow."""
    for parent in prange(len(parent_x)):
        scale = distance[species[parent]] / math.sqrt(TAIL)
        for seed in range(first[parent], first[parent + 1]):
            away = scale * math.sqrt(1.0 / math.sqrt(1.0 - chance(key, seed, AWAY_DRAW)) - 1.0)
            turn = 2.0 * math.pi * chance(key, seed, TURN_DRAW)
            x[seed] = parent_x[parent] + away * math.cos(turn)
            y[seed] = parent_y[parent] + away * math.sin(turn)
            size[seed] = 1.0 + size_v[species[parent]] * (2.0 * chance(key, seed, SIZE_DRAW) - 1.0)


@njit(parallel=True, cache=True)
def _judge_room(  # type: ignore[no-untyped-def]
    grid, fit, corner, edge, buckets, looks, widest, first, circle, species, x, y, size, merit
):
    """Suitability of each seed's place, 0 off the ground and where it keeps clear of nobody."""
    for seed in prange(len(x)):
        merit[seed] = 0.0
        column, row = (x[seed] - grid.west) / grid.cell, (y[seed] - grid.south) / grid.cell
        if 0.0 <= column < grid.columns and 0.0 <= row < grid.rows:
            suits = fit[int(row), int(column), species[seed]]
            if suits > 0.0 and is_clear(
                *(corner, edge, buckets, looks, widest, first, circle),
                *(species[seed], x[seed], y[seed], size[seed]),
            ):
                merit[seed] = suits


@njit(parallel=True, cache=True)
def _judge_ground(  # type: ignore[no-untyped-def]
    grid,
    left,
    depth,
    need,
    reach,
    deepest,
    level,
    slope,
    heights,
    rise,
    spacing,
    key,
    species,
    x,
    y,
    size,
    merit,
):
    """Take all merit from seeds without light or food or on the wrong ground, and some from the unlucky."""
    for seed in prange(len(x)):
        if merit[seed] == 0.0:
            continue
        kind, place_x, place_y = species[seed], x[seed], y[seed]
        height = _between(heights, spacing, place_x, place_y)
        east = _between(rise[0], spacing, place_x, place_y)
        steep = math.hypot(east, _between(rise[1], spacing, place_x, place_y))
        if (
            level[kind, 0] <= height <= level[kind, 1]
            and slope[kind, 0] <= steep <= slope[kind, 1]
            and is_lit(grid, depth, deepest, kind, place_x, place_y)
            and is_fed(grid, left, need, kind, place_x, place_y, reach[kind] * size[seed])
        ):
            merit[seed] *= 1.0 - LUCK * chance(key, seed, LUCK_DRAW)
        else:
            merit[seed] = 0.0


@njit(cache=True)
def _between(field: Floats, spacing: float, x: float, y: float) -> float:
    """As Terrain.height, for any field at the points of a terrain."""
    last = len(field) - 1
    place_x = min(max(x / spacing + 0.5 * last, 0.0), float(last))
    place_y = min(max(y / spacing + 0.5 * last, 0.0), float(last))
    column, row = min(int(place_x), last - 1), min(int(place_y), last - 1)
    u, v = place_x - column, place_y - row
    south = field[row, column] * (1.0 - u) + field[row, column + 1] * u
    north = field[row + 1, column] * (1.0 - u) + field[row + 1, column + 1] * u
    return south * (1.0 - v) + north * v
