"""spread: plants of many species take possession of a piece of ground, generation by generation.

Endo et al. (2003, section 5.2) let underbrush spread from propagation points to where the ground has the nutrients
that it needs, and let kinds compete for them and for space. Here trees join in, and light counts too. One round:

1. Plants die that stand in the wrong light, and by chance, the sooner the less the ground suits them.
2. Those who live on take their nutrients again, the oldest first; who finds too little dies too.
3. Every plant and every propagation point sheds seeds; where a seed finds room, light and food among those who
   stand there, its merit is the suitability of the place to its species, less some bad luck.
4. The seeds take their places in order of merit: where two want the same room or food, the better suited has it.

The suitability of a place is that of its scarcest nutrient (see ecology.py). Every random number belongs to a seed
or a plant of a round, and steps whose order matters run in one thread: the result is the same on any machine's cores.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.scene.spread.cells import fresh_cells
from windswept.scene.spread.claims import sort_stems
from windswept.scene.spread.ecology import Ecology
from windswept.scene.spread.plot import Plot
from windswept.scene.spread.population import Population
from windswept.scene.spread.seeds import Parents, shed
from windswept.scene.spread.settle import settle
from windswept.scene.spread.site import build_site
from windswept.scene.spread.survive import feed, survivors

Reals = NDArray[np.float64]

POINT_SEEDS = 16
"""Seeds of a propagation point over those of one plant."""


def spread(
    plot: Plot, ecology: Ecology, points: Population, placed: Population, rounds: int, most: int, seed: int
) -> Population:
    """Let plants spread.

    Args:
        plot: the ground.
        ecology: the species.
        points: propagation points; of their fields, species and place count.
        placed: plants that stand there for good, and spread too.
        rounds: generations.
        most: plants in all, the placed ones not counted.
        seed: same seed, same plants.

    Returns:
        The plants that came up, the oldest first; those of ``placed`` are not among them.
    """
    site = build_site(plot, ecology)
    keys = np.random.default_rng(seed).integers(0, 2**63, (rounds + 1, 2)).astype(np.uint64)
    plants = placed
    cells = fresh_cells(plot.grid, ecology, plot.supply)
    for life_key, seed_key in keys[:-1]:
        plants = plants.only(survivors(site, cells, plants, ecology.turnover, life_key))
        cells = fresh_cells(plot.grid, ecology, plot.supply)
        plants = plants.only(feed(site, cells, plants))
        parents = _parents(plants.with_more(points), ecology, points.count)
        seeds = shed(site, cells, sort_stems(site.claims, plants), parents, seed_key)
        plants = settle(site, cells, seeds, plants, most + placed.count)
    plants = plants.only(survivors(site, cells, plants, np.zeros(ecology.count), keys[-1, 0]))
    return plants.only(~plants.placed)


def _parents(plants: Population, ecology: Ecology, points: int) -> Parents:
    """Plants, the last of them propagation points, with the numbers of their seeds."""
    shed_by = ecology.offspring[plants.species]
    shed_by[len(shed_by) - points :] *= POINT_SEEDS
    first = np.concatenate([[0], np.cumsum(shed_by)])
    return Parents(plants.species, plants.x, plants.y, first)
