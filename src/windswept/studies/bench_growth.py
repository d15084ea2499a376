"""Speed of growth: every built-in species, from its file to a Plant."""

from __future__ import annotations

from collections.abc import Callable

from windswept.plants.species import load_species, species_names
from windswept.plants.weber_penn import grow
from windswept.studies.machine import median_seconds


def bench_growth(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``growth.<species>.{ms, stems, leaves}``."""
    figures: dict[str, float] = {}
    for name in species_names():
        say(f"growth, {name}")
        species = load_species(name)
        plant = grow(species, 0)

        def run(species: object = species) -> object:
            return grow(species, 0)  # type: ignore[arg-type]

        figures[f"growth.{name}.ms"] = 1e3 * median_seconds(run, repeats=5, warm_up=1)
        figures[f"growth.{name}.stems"] = plant.stem_count
        figures[f"growth.{name}.leaves"] = plant.leaf_count
    return figures
