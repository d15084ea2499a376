"""settle: the seeds of a round take their places, the better suited first."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from windswept.scene.spread.cells import Cells, cast_shade, is_fed, is_lit, take_up
from windswept.scene.spread.claims import BASE, COLUMNS, ROWS, bucket_line, bucket_of
from windswept.scene.spread.population import Population
from windswept.scene.spread.seeds import Seeds
from windswept.scene.spread.site import Site

Ints = NDArray[np.int64]


def settle(site: Site, cells: Cells, seeds: Seeds, plants: Population, most: int) -> Population:
    """The plants with those of the seeds that win a place, in order of merit.

    Where two want the same room or food, the one of greater merit has it; of equal ones, the one shed first.

    Args:
        site: the ground and the species.
        cells: what the ground holds; the new plants take from it and shade it.
        seeds: of this round.
        plants: who stands there already.
        most: plants in all.
    """
    promising = np.flatnonzero(seeds.merit > 0.0)
    order = promising[np.argsort(-seeds.merit[promising], kind="stable")]
    new = _new_plants(seeds, order)
    ecology, claims = site.ecology, site.claims
    wanted = np.maximum(ecology.most - np.bincount(plants.species, minlength=ecology.count), 0)
    won = _settle(
        *(site.grid, cells.left, cells.depth, ecology.need, ecology.reach, ecology.shade, ecology.height),
        *(site.deepest, claims.corner, claims.edge, claims.buckets, claims.stands, claims.looks),
        *(claims.widest, np.full(claims.bucket_count, -1, np.int32), new.species, new.x, new.y, new.size),
        *(wanted, max(most - plants.count, 0)),
    )
    return plants.with_more(new.only(won))


def _new_plants(seeds: Seeds, order: Ints) -> Population:
    """Some of the seeds as plants, in this order."""
    never = np.zeros(len(order), np.bool_)
    return Population(seeds.species[order], seeds.x[order], seeds.y[order], seeds.size[order], never)


@njit(cache=True)
def _settle(  # type: ignore[no-untyped-def]
    grid,
    left,
    depth,
    need,
    reach,
    shade,
    height,
    deepest,
    corner,
    edge,
    buckets,
    stands,
    looks,
    widest,
    head,
    species,
    x,
    y,
    size,
    wanted,
    most,
):
    """(W,) which seeds win a place, at most ``wanted`` (S,) of each species and ``most`` in all."""
    won = np.zeros(len(x), np.bool_)
    # The seeds of a bucket are a linked list: ``head`` names the last to come, ``after`` the one before each.
    after = np.empty((len(x), len(edge)), np.int32)
    for seed in range(len(x)):
        kind, own_reach = species[seed], reach[species[seed]] * size[seed]
        if most == 0:
            break
        if (
            wanted[kind] > 0
            and is_lit(grid, depth, deepest, kind, x[seed], y[seed])
            and _is_clear_of_new(
                corner, edge, buckets, stands, looks, widest, head, after, species, x, y, size, seed
            )
            and is_fed(grid, left, need, kind, x[seed], y[seed], own_reach)
        ):
            take_up(grid, left, need, kind, x[seed], y[seed], own_reach)
            cast_shade(grid, depth, shade, height, kind, x[seed], y[seed], own_reach)
            for layer in range(len(edge)):
                if stands[layer, kind] > 0.0:
                    bucket = bucket_of(corner, edge, buckets, layer, x[seed], y[seed])
                    after[seed, layer] = head[bucket]
                    head[bucket] = seed
            won[seed] = True
            wanted[kind] -= 1
            most -= 1
    return won


@njit(cache=True)
def _is_clear_of_new(  # type: ignore[no-untyped-def]
    corner, edge, buckets, stands, looks, widest, head, after, species, x, y, size, seed
):
    """As is_clear, for the plants of this round, which stand in linked lists."""
    for layer in range(len(edge)):
        own = looks[layer, species[seed]] * size[seed]
        if own == 0.0:
            continue
        reach, columns = own + widest[layer], buckets[layer, COLUMNS]
        west = bucket_line(corner[0], edge[layer], columns, x[seed] - reach)
        east = bucket_line(corner[0], edge[layer], columns, x[seed] + reach)
        south = bucket_line(corner[1], edge[layer], buckets[layer, ROWS], y[seed] - reach)
        north = bucket_line(corner[1], edge[layer], buckets[layer, ROWS], y[seed] + reach)
        for row in range(south, north + 1):
            start = buckets[layer, BASE] + row * columns
            for bucket in range(start + west, start + east + 1):
                other = head[bucket]
                while other >= 0:
                    apart = own + np.float32(stands[layer, species[other]] * size[other])
                    if (x[seed] - x[other]) ** 2 + (y[seed] - y[other]) ** 2 < apart * apart:
                        return False
                    other = after[other, layer]
    return True
