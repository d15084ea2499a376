"""Scattering plants over an area so that none stands too close to another: blue noise by throwing darts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from windswept.scene.area import Area

Reals = NDArray[np.float64]

DARTS = 2000
"""Places tried in a row before a stand counts as full."""
BATCH = 256
LEAST_EDGE = 0.5
"""Of a cell, m."""
BIAS_POWER = 4.0
"""How strongly a full depth bias crowds plants: their density goes as depth^4."""


Cells = dict[tuple[int, int], list[tuple[float, float]]]


@dataclass
class Ground:
    """Places that are taken, in square cells for a quick search: wide ones for trees, narrow ones for grass."""

    layers: dict[float, Cells] = field(default_factory=dict)
    """x and y of the plants of each spacing, in each cell of that edge."""

    def is_free(self, x: float, y: float, spacing: float) -> bool:
        """Whether every plant is further away than the mean of its spacing and this one's."""
        return all(
            _is_free(cells, x, y, other, 0.5 * (spacing + other)) for other, cells in self.layers.items()
        )

    def take(self, x: float, y: float, spacing: float) -> None:
        """Mark a place as taken."""
        edge = max(spacing, LEAST_EDGE)
        key = (math.floor(x / edge), math.floor(y / edge))
        self.layers.setdefault(spacing, {}).setdefault(key, []).append((x, y))


def _is_free(cells: Cells, x: float, y: float, spacing: float, least: float) -> bool:
    """Whether no plant of one spacing is nearer than ``least``."""
    edge = max(spacing, LEAST_EDGE)
    for i in range(math.floor((x - least) / edge), math.floor((x + least) / edge) + 1):
        for j in range(math.floor((y - least) / edge), math.floor((y + least) / edge) + 1):
            for other_x, other_y in cells.get((i, j), ()):
                if (x - other_x) ** 2 + (y - other_y) ** 2 < least * least:
                    return False
    return True


@dataclass(frozen=True, slots=True)
class Sort:
    """Plants of one species in a stand."""

    count: int
    spacing: float
    """Distance to the next plant of the same sort, m; between sorts the mean of both holds."""
    depth_bias: float = 0.0
    """-1 crowds at the edge of the area, 0 is even, 1 crowds at its depth."""


def scatter(
    area: Area, sorts: list[Sort], ground: Ground, rng: np.random.Generator, into: float | None = None
) -> list[Reals]:
    """Throw darts until every sort has its plants or the area is full.

    Args:
        area: where the plants may stand.
        sorts: what is wanted; the widest spaced are placed first.
        ground: places already taken; the new ones are added to it.
        rng: same state, same places.
        into: azimuth that leads deeper into the area, radians; None: away from its edge.

    Returns:
        For each sort (n, 2) places, m; n is below its count where no more fit.
    """
    places: list[Reals] = [np.zeros((0, 2))] * len(sorts)
    for index in sorted(range(len(sorts)), key=lambda i: -sorts[i].spacing):
        sort = sorts[index]
        found: list[tuple[float, float]] = []
        missed = 0
        for x, y in _darts(area, sort.depth_bias, rng, into) if sort.count else ():
            missed += 1
            if ground.is_free(x, y, sort.spacing):
                ground.take(x, y, sort.spacing)
                found.append((x, y))
                missed = 0
            if len(found) == sort.count or missed == DARTS:
                break
        places[index] = np.array(found, dtype=np.float64).reshape(-1, 2)
    return places


def _darts(
    area: Area, depth_bias: float, rng: np.random.Generator, into: float | None
) -> Iterator[tuple[float, float]]:
    """Random places in the area without end, denser where the bias wants them."""
    low, high = area.bounds
    while True:
        points = rng.uniform(low, high, (BATCH, 2))
        chance = rng.random(BATCH)
        points, chance = points[inside := area.contains(points)], chance[inside]
        if depth_bias != 0.0 and len(points):
            depth = area.depth_from_edge(points) if into is None else area.depth_along(points, into)
            wanted = depth if depth_bias > 0.0 else 1.0 - depth
            points = points[chance < wanted ** (BIAS_POWER * abs(depth_bias))]
        yield from map(tuple, points.tolist())


def share_out(count: int, weights: list[float]) -> list[int]:
    """Whole numbers that add up to ``count`` in the ratio of the weights (largest remainder)."""
    exact = count * np.array(weights) / sum(weights)
    whole = np.floor(exact).astype(int)
    first = np.argsort(whole - exact, kind="stable")[: count - int(whole.sum())]
    whole[first] += 1
    return [int(n) for n in whole]
