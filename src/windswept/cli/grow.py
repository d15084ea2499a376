"""``windswept grow``."""

from __future__ import annotations

import json
import time
from typing import Any

import click
import numpy as np

from windswept.motion.modes import plant_frequencies
from windswept.motion.rods import build_rods
from windswept.motion.skeleton import build_skeleton
from windswept.plants.plant import Plant
from windswept.plants.weber_penn import grow

BREAST_HEIGHT = 1.3
"""Height at which foresters measure a trunk, m."""


@click.command("grow")
@click.argument("source")
@click.option("--seed", default=0, show_default=True, help="Which individual of the species.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object instead of lines.")
def command(source: str, seed: int, as_json: bool) -> None:
    """Grow one plant from SOURCE (a species name or a .toml file) and report its figures.

    Example: windswept grow quaking_aspen --seed 3 --json
    """
    started = time.perf_counter()
    plant = grow(source, seed)
    figures = plant_figures(plant, time.perf_counter() - started)
    if as_json:
        click.echo(json.dumps(figures))
        return
    for name, value in figures.items():
        shown = ", ".join(f"{v:g}" for v in value) if isinstance(value, list) else value
        click.echo(f"{name:<16} {shown:.4g}" if isinstance(shown, float) else f"{name:<16} {shown}")


def plant_figures(plant: Plant, seconds: float) -> dict[str, Any]:
    """What ``windswept grow --json`` reports.

    Args:
        plant: the plant.
        seconds: how long it took to grow.
    """
    rods = build_rods(plant)
    wood = float(rods.mass.sum()) - plant.material.leaf_mass * float(plant.leaf_area.sum())
    away = np.linalg.norm(plant.link_tip[:, :2], axis=1)
    return {
        "species": plant.species,
        "seed": plant.seed,
        "height_m": round(plant.height, 3),
        "crown_radius_m": round(float(away.max()), 3),
        "dbh_m": round(breast_height_diameter(plant), 4),
        "stems": np.bincount(plant.stem_order).tolist(),
        "links": plant.link_count,
        "leaves": plant.leaf_count,
        "leaf_area_m2": round(float(plant.leaf_area.sum()), 3),
        "wood_mass_kg": round(wood, 3),
        "frequencies_hz": [round(float(f), 4) for f in plant_frequencies(build_skeleton(plant), rods, 5)],
        "seconds": round(seconds, 4),
    }


def breast_height_diameter(plant: Plant) -> float:
    """Diameter at 1.3 m of one stem with the wood of all trunks that stand there, m; 0 for a plant below that."""
    trunk = plant.stem_order[plant.link_stem] == 0
    low, high = plant.link_base[:, 2], plant.link_tip[:, 2]
    cut = trunk & (low <= BREAST_HEIGHT) & (high > BREAST_HEIGHT)
    along = (BREAST_HEIGHT - low[cut]) / (high[cut] - low[cut])
    radius = plant.link_radius_base[cut] + along * (plant.link_radius_tip - plant.link_radius_base)[cut]
    return 2.0 * float(np.sqrt(np.sum(radius.astype(np.float64) ** 2)))
