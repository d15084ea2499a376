"""A population of grown trees beside measured ones: lowest frequency over height and over DBH/H^2.

Run ``python -m windswept.studies.population -o population.png``.

Measured (Jackson et al. 2019, as PHYSICS part 3 sums them up): 58 forest broadleaves ring at 0.092 to 0.270 Hz,
with a median f sqrt(H) of 0.88, and DBH/H^2 explains 16 % of the variance; 970 frame models of scanned trees ring
at 0.083 to 0.513 Hz (5 to 95 %). The built-in species are trees of open ground, stouter than their kin in a forest:
so half of the population is grown slender, as a closed stand makes them.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windswept.motion.modes import plant_frequencies
from windswept.motion.rods import build_rods
from windswept.motion.skeleton import build_skeleton
from windswept.plants.plant import Plant
from windswept.plants.species import load_species
from windswept.plants.species_form import Species
from windswept.plants.weber_penn import grow
from windswept.studies.population_plot import draw_population

TREES = (
    *("european_beech", "silver_birch", "english_oak", "sugar_maple", "small_leaved_lime", "wild_cherry"),
    *("white_ash", "quaking_aspen", "norway_spruce", "european_larch", "silver_fir", "scots_pine"),
)
SIZES = (0.4, 1.35)
"""Range of a tree's size over its species' Scale."""
SLENDER = (0.4, 0.7)
"""Range of a forest tree's trunk radius over that of a tree of the open."""
CROWN = 0.6
"""Length and number of a forest tree's branches over those of a tree of the open."""
BARE_TRUNK = 0.5
"""Bare fraction of a forest tree's trunk."""


@dataclass(frozen=True, slots=True)
class Population:
    """N trees."""

    species: tuple[str, ...]
    forest: NDArray[np.bool_]
    """(N,) whether the tree has the slender trunk of a closed stand."""
    height: NDArray[np.float64]
    """(N,) m."""
    dbh: NDArray[np.float64]
    """(N,) diameter at 1.3 m, m."""
    frequency: NDArray[np.float64]
    """(N,) lowest, in leaf, Hz."""


def grow_population(
    count: int = 200, seed: int = 0, say: Callable[[str], None] = lambda line: None
) -> Population:
    """Grow trees of mixed species and sizes and take their lowest frequencies.

    Args:
        count: number of trees, half of them of the open and half of the forest.
        seed: of sizes and growth.
        say: told of each tree.
    """
    rng = np.random.default_rng(seed)
    names, rows = [], []
    for index in range(count):
        name, forest = TREES[index // 2 % len(TREES)], index % 2 == 1
        size = float(rng.uniform(*SIZES))
        slender = float(rng.uniform(*SLENDER))
        form = resized(load_species(name), size)
        plant = grow(crowded(form, slender) if forest else form, seed + index)
        frequency = float(plant_frequencies(build_skeleton(plant), build_rods(plant), 1)[0])
        say(f"{index + 1} of {count}: {name}, {plant.height:.1f} m, {frequency:.3f} Hz")
        names.append(name)
        rows.append((forest, plant.height, trunk_diameter(plant), frequency))
    table = np.array(rows, np.float64)
    return Population(tuple(names), table[:, 0] > 0, table[:, 1], table[:, 2], table[:, 3])


def resized(species: Species, size: float) -> Species:
    """The species at another size, of no spread; small trees have fewer branches, leaves keep their size."""
    growth = species.growth
    levels = [
        level.model_copy(update={"branches": math.ceil(level.branches * min(size, 1.0))})
        for level in growth.level
    ]
    changed = {"scale": growth.scale * size, "scale_v": 0.0, "level": levels}
    return species.model_copy(update={"growth": growth.model_copy(update=changed)})


def crowded(species: Species, slender: float) -> Species:
    """The species as it grows in a closed stand: a slender trunk, and a short narrow crown high up.

    Args:
        species: of the open.
        slender: factor on its trunk's radius.
    """
    growth = species.growth
    first = growth.level[1]
    narrow = {"length": first.length * CROWN, "branches": math.ceil(first.branches * CROWN)}
    levels = [growth.level[0], first.model_copy(update=narrow), *growth.level[2:]]
    changed = {
        "ratio": max(growth.ratio * slender, 0.001),
        "base_size": max(growth.base_size, BARE_TRUNK),
        "level": levels,
    }
    return species.model_copy(update={"growth": growth.model_copy(update=changed)})


def trunk_diameter(plant: Plant) -> float:
    """Diameter of the trunk at 1.3 m, m; a forked tree counts all its trunks' sections as one."""
    trunk = plant.stem_order[plant.link_stem] == 0
    cut = trunk & (plant.link_base[:, 2] <= 1.3) & (plant.link_tip[:, 2] > 1.3)
    radius = 0.5 * (plant.link_radius_base + plant.link_radius_tip)[cut].astype(np.float64)
    return 2.0 * float(np.sqrt(np.sum(radius**2)))


def figures(population: Population) -> dict[str, float]:
    """What is compared with the measured populations."""
    scaled = population.frequency * np.sqrt(population.height)
    slenderness = population.dbh / population.height**2
    explained = np.corrcoef(slenderness, population.frequency)[0, 1] ** 2
    forest = population.forest
    low, high = np.percentile(population.frequency, [5, 95])
    return {
        "trees": len(forest),
        "frequency_p5_hz": round(float(low), 3),
        "frequency_p95_hz": round(float(high), 3),
        "median_f_sqrt_h_forest": round(float(np.median(scaled[forest])), 3),
        "median_f_sqrt_h_open": round(float(np.median(scaled[~forest])), 3),
        "variance_explained_by_dbh_h2": round(float(explained), 3),
        "share_in_band_of_970": round(
            float(np.mean((population.frequency >= 0.083) & (population.frequency <= 0.513))), 3
        ),
    }


def main(arguments: list[str] | None = None) -> None:
    """The command line of the study."""
    parser = argparse.ArgumentParser(description="Frequencies of grown trees beside measured ones.")
    parser.add_argument("-o", "--output", type=Path, required=True, help="PNG file")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    population = grow_population(options.count, options.seed)
    draw_population(
        population.height, population.dbh, population.frequency, population.forest, options.output
    )
    for name, value in figures(population).items():
        print(f"{name:<30} {value}")


if __name__ == "__main__":
    main()
