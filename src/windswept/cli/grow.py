"""``windswept grow``."""

from __future__ import annotations

import json
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click
import numpy as np

from windswept.cli.numbers import SEED, FiniteRange
from windswept.cli.progress import status_line
from windswept.errors import InputError
from windswept.forms.files import check_place
from windswept.motion.natural_frequencies import natural_frequencies
from windswept.motion.rods import build_rods
from windswept.plants.plant import Plant
from windswept.plants.save import save_plant
from windswept.plants.sources import Grown, grow_with_report
from windswept.plants.write_species import write_species

BREAST_HEIGHT = 1.3
"""Height at which foresters measure a trunk, m."""
ENDINGS = (".npz", ".toml", ".obj")
"""Of the files that a plant is saved to."""


@click.command("grow")
@click.argument("source")
@click.option("--seed", type=SEED, default=0, show_default=True, help="Which individual of the species.")
@click.option("-o", "--output", help="Save as .npz (complete), .toml (the species) or .obj (mesh at rest).")
@click.option(
    "--leaf-area",
    type=FiniteRange(0.0),
    help="Of a scan alone: m^2 of leaves; 0 is winter. [default: by the trunk]",
)
@click.option("--json", "as_json", is_flag=True, help="One JSON object instead of lines.")
def command(source: str, seed: int, output: str | None, leaf_area: float | None, as_json: bool) -> None:
    """Grow one plant from SOURCE and report its figures.

    SOURCE is the name of a built-in species or grammar, or a file: species .toml; Arbaro or Helios .xml; tree-gen
    or Sapling .py; ez-tree .json; Arbaro list .txt or .arb; L-system .l or .lpy; scanned cylinders .csv or .mat; a
    saved plant .npz.

    Example: windswept grow quaking_aspen --seed 3 --json
    """
    if output is not None:
        check_place(Path(output), ENDINGS, "--output")
    with status_line(f"growing {source}"):
        started = time.perf_counter()
        grown = grow_with_report(source, seed, leaf_area)
        figures = plant_figures(grown.plant, time.perf_counter() - started)
    if grown.report is not None:
        for line in grown.report.lines():
            click.echo(line, err=True)
        figures["import_report"] = asdict(grown.report)
    if output is not None:
        _save(source, grown, Path(output))
    if as_json:
        click.echo(json.dumps(figures))
        return
    figures.pop("import_report", None)
    for name, value in figures.items():
        shown = ", ".join(f"{v:g}" for v in value) if isinstance(value, list) else value
        click.echo(f"{name:<16} {shown:.4g}" if isinstance(shown, float) else f"{name:<16} {shown}")


def _save(source: str, grown: Grown, path: Path) -> None:
    """Write the plant, or the species it grew from."""
    ending = path.suffix.lower()
    if ending == ".npz":
        save_plant(grown.plant, path)
    elif ending == ".toml":
        if grown.species is None:
            raise InputError(
                source, "", None, "a source that is a species: this one can be saved as .npz or .obj"
            )
        write_species(grown.species, path)
    else:
        from windswept.export.obj import export_obj

        export_obj(grown.plant, path)


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
        "frequencies_hz": [round(float(f), 4) for f in natural_frequencies(plant, 5)],
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
