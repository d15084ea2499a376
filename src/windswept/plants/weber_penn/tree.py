"""What every step of growing one tree needs to know."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

from windswept.plants.species_form import Growth, Species
from windswept.plants.weber_penn.streams import Streams

LEAST_LINKS = (8, 4)
"""Stems of order 0 and 1 get at least so many links: fewer bend too coarsely in the wind."""
SMALLEST_SCALE = 0.25
"""No tree is smaller than this fraction of Scale: the black oak's 10 +- 10 m would reach down to nothing."""
SHORTEST_SEGMENT = 1e-3
"""Stems with shorter segments than this do not grow, m: float32 could not hold their direction."""
THINNEST = 5e-4
"""No wood is thinner than this radius, m: RatioPower 2 would spin the willow's twigs into threads."""


@dataclass(frozen=True, slots=True)
class Tree:
    """One tree while it grows: its form, its draw of the scale, its streams and its budgets."""

    species: Species
    seed: int
    scale: float
    """Drawn Scale of this tree, m."""
    streams: Streams
    link_budget: int
    leaf_budget: int

    @property
    def growth(self) -> Growth:
        """Weber and Penn's parameters."""
        return self.species.growth

    @property
    def bare_length(self) -> float:
        """Length of the trunk without branches, m."""
        return self.growth.base_size * self.scale

    def links_per_segment(self, order: int) -> int:
        """Into how many links each segment of a stem of this order is divided."""
        least = LEAST_LINKS[order] if order < len(LEAST_LINKS) else 1
        return ceil(least / self.growth.at(order).curve_res)

    def key(self, order: int, name: str) -> str:
        """Dotted key of a parameter of the level that serves an order."""
        return f"level[{min(order, len(self.growth.level) - 1)}].{name}"


def plant_tree(species: Species, seed: int, link_budget: int, leaf_budget: int) -> Tree:
    """Draw the tree's scale and open its streams."""
    growth, streams = species.growth, Streams(seed)
    drawn = growth.scale + float(streams.vary("scale", 0, growth.scale_v, 1)[0])
    scale = max(drawn, SMALLEST_SCALE * growth.scale)
    return Tree(species, seed, scale, streams, link_budget, leaf_budget)
