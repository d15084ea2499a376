"""survive: who lives on to the next round, and what the ground then holds."""

from __future__ import annotations

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from windswept.scene.spread.cells import Cells, cast_shade, column_of, is_fed, is_lit, row_of, take_up
from windswept.scene.spread.chance import chance
from windswept.scene.spread.population import Population
from windswept.scene.spread.site import Site

Marks = NDArray[np.bool_]
Reals = NDArray[np.float64]


def survivors(site: Site, cells: Cells, plants: Population, turnover: Reals, key: np.uint64) -> Marks:
    """(P,) which plants live on: those in the right light, unless chance takes them.

    Args:
        site: the ground and the species.
        cells: the light.
        plants: all that stand there.
        turnover: (S,) chance of death where the ground does not suit at all; 0 where it suits perfectly.
        key: of the round's random numbers.
    """
    lives = plants.placed.copy()
    _survive(
        *(site.grid, site.fit, cells.depth, site.deepest, plants.species, plants.x, plants.y),
        *(turnover, key, lives),
    )
    return lives


@njit(parallel=True, cache=True)
def _survive(  # type: ignore[no-untyped-def]
    grid, fit, depth, deepest, species, x, y, turnover, key, lives
):
    """Mark those who live."""
    for plant in prange(len(x)):
        kind = species[plant]
        suits = fit[row_of(grid, y[plant]), column_of(grid, x[plant]), kind]
        lucky = chance(key, plant, 0) >= turnover[kind] * (1.0 - suits)
        lives[plant] |= lucky and is_lit(grid, depth, deepest, kind, x[plant], y[plant])


def feed(site: Site, cells: Cells, plants: Population) -> Marks:
    """(P,) which plants find enough when all take from fresh cells, the oldest first; they take it.

    Args:
        site: the ground and the species.
        cells: untouched before, what the plants leave after.
        plants: in order of age.
    """
    ecology, fed = site.ecology, plants.placed.copy()
    _feed(
        *(site.grid, cells.left, cells.depth, ecology.need, ecology.reach, ecology.shade, ecology.height),
        *(plants.species, plants.x, plants.y, plants.size, fed),
    )
    return fed


@njit(cache=True)
def _feed(  # type: ignore[no-untyped-def]
    grid, left, depth, need, reach, shade, height, species, x, y, size, fed
):
    """Mark those who are fed, besides those marked already."""
    for plant in range(len(x)):
        kind, roots = species[plant], reach[species[plant]] * size[plant]
        if fed[plant] or is_fed(grid, left, need, kind, x[plant], y[plant], roots):
            fed[plant] = True
            take_up(grid, left, need, kind, x[plant], y[plant], roots)
            cast_shade(grid, depth, shade, height, kind, x[plant], y[plant], roots)
