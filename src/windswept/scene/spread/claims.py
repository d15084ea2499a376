"""Claims: who may not stand how near to whom, in layers of circles of like size.

A seed keeps clear of a plant by the sum of their circles. The feet of all species are such circles, sorted into
layers by size so that few buckets are searched; a species that keeps a greater distance among its own has one
more layer, which only its own seeds look at.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from windswept.scene.spread.ecology import Ecology
from windswept.scene.spread.population import Population

Reals = NDArray[np.float64]
Floats = NDArray[np.float32]
Ints = NDArray[np.int64]
Ints32 = NDArray[np.int32]

FINEST = 1024
"""Most buckets along a side."""
ROWS, COLUMNS, BASE = range(3)
"""Columns of Claims.buckets."""


@dataclass(frozen=True, slots=True)
class Claims:
    """H layers of buckets over a piece of ground."""

    corner: Reals
    """(2,) south-western corner, m."""
    stands: Reals
    """(H, S) radius that a plant of size 1 holds in the layer, m; 0 where its species is not in it."""
    looks: Reals
    """(H, S) radius with which a seed of size 1 looks at the layer, m; 0 where it does not."""
    widest: Reals
    """(H,) greatest radius held in the layer, m."""
    edge: Reals
    """(H,) of a bucket, m."""
    buckets: Ints
    """(H, 3) rows and columns of buckets, and the number of the layer's first bucket."""
    bucket_count: int
    """Of all layers."""


@dataclass(frozen=True, slots=True)
class Stems:
    """N circles sorted by bucket."""

    first: Ints32
    """(buckets + 1,) first circle of each bucket."""
    circle: Floats
    """(N, 3) x, y and radius, m."""


def build_claims(ecology: Ecology, low: Reals, high: Reals) -> Claims:
    """Layers for the feet, from the smallest up in powers of two, and for wider spacings.

    Args:
        ecology: S species.
        low: (2,) south-western corner of the ground, m.
        high: (2,) north-eastern corner, m.
    """
    size_class = np.floor(np.log2(ecology.foot / ecology.foot.min())).astype(int)
    stands = [np.where(size_class == k, ecology.foot, 0.0) for k in np.unique(size_class)]
    looks = [ecology.foot] * len(stands)
    for species in np.flatnonzero(ecology.spacing > 2.0 * ecology.foot):
        own = np.where(np.arange(ecology.count) == species, 0.5 * ecology.spacing, 0.0)
        stands.append(own)
        looks.append(own)
    widest = np.array([np.max(layer * (1.0 + ecology.size_v)) for layer in stands])
    extent = high - low
    edge = np.maximum(2.0 * widest, extent.max() / FINEST)
    columns, rows = np.ceil(extent[:, None] / edge).astype(np.int64)
    base = np.concatenate([[0], np.cumsum(rows * columns)])
    buckets = np.stack([rows, columns, base[:-1]], axis=1)
    return Claims(low, np.array(stands), np.array(looks), widest, edge, buckets, int(base[-1]))


@njit(cache=True)
def bucket_line(corner: float, edge: float, lines: int, place: float) -> int:
    """Row or column of a place along one axis; the nearest one outside the ground."""
    return min(max(int((place - corner) / edge), 0), lines - 1)


@njit(cache=True)
def bucket_of(corner: Reals, edge: Reals, buckets: Ints, layer: int, x: float, y: float) -> int:
    """Number of the bucket of a place."""
    rows, columns, base = buckets[layer, ROWS], buckets[layer, COLUMNS], buckets[layer, BASE]
    row = bucket_line(corner[1], edge[layer], rows, y)
    return base + row * columns + bucket_line(corner[0], edge[layer], columns, x)


def sort_stems(claims: Claims, plants: Population) -> Stems:
    """All circles of all plants by bucket."""
    first = np.zeros(claims.bucket_count + 1, np.int32)
    members = np.count_nonzero(claims.stands, axis=0)[plants.species].sum()
    circle = np.empty((members, 3), np.float32)
    _sort_stems(
        *(claims.corner, claims.edge, claims.buckets, claims.stands),
        *(plants.species, plants.x, plants.y, plants.size, first, circle),
    )
    return Stems(first, circle)


@njit(cache=True)
def _sort_stems(  # type: ignore[no-untyped-def]
    corner, edge, buckets, stands, species, x, y, size, first, circle
):
    """A counting sort: numbers of circles, their running sum, then every circle to its place."""
    for plant in range(len(x)):
        for layer in range(len(edge)):
            if stands[layer, species[plant]] > 0.0:
                first[bucket_of(corner, edge, buckets, layer, x[plant], y[plant])] += 1
    total = 0
    for bucket in range(len(first)):
        total += first[bucket]
        first[bucket] = total
    for plant in range(len(x) - 1, -1, -1):
        for layer in range(len(edge)):
            held = stands[layer, species[plant]]
            if held > 0.0:
                bucket = bucket_of(corner, edge, buckets, layer, x[plant], y[plant])
                first[bucket] -= 1
                at = first[bucket]
                circle[at, 0], circle[at, 1], circle[at, 2] = x[plant], y[plant], held * size[plant]


@njit(cache=True)
def is_clear(  # type: ignore[no-untyped-def]
    corner, edge, buckets, looks, widest, first, circle, species, x, y, size
):
    """Whether no circle of a sorted plant overlaps those of a seed."""
    for layer in range(len(edge)):
        own = looks[layer, species] * size
        if own == 0.0:
            continue
        reach, columns, base = own + widest[layer], buckets[layer, COLUMNS], buckets[layer, BASE]
        left = bucket_line(corner[0], edge[layer], columns, x - reach)
        right = bucket_line(corner[0], edge[layer], columns, x + reach)
        south = bucket_line(corner[1], edge[layer], buckets[layer, ROWS], y - reach)
        north = bucket_line(corner[1], edge[layer], buckets[layer, ROWS], y + reach)
        for row in range(south, north + 1):
            # Buckets of one row lie side by side: one run of circles.
            start = base + row * columns
            for stem in range(first[start + left], first[start + right + 1]):
                apart = own + circle[stem, 2]
                if (x - circle[stem, 0]) ** 2 + (y - circle[stem, 1]) ** 2 < apart * apart:
                    return False
    return True
