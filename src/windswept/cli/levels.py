"""``windswept levels``."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import click
import numpy as np

from windswept.cli.numbers import SEED, FiniteRange
from windswept.cli.progress import status_line
from windswept.forms.files import check_place
from windswept.levels import (
    Eye,
    Ladder,
    bound_errors,
    build_ladder,
    measure,
    simplify,
    with_measured_errors,
)
from windswept.levels.measure import Measured
from windswept.levels.metrics import METRICS, Metric
from windswept.levels.static_shapes import STATED_WIND
from windswept.motion import build_model
from windswept.plants.sources import grow_source
from windswept.studies.level_costs import levels_bytes, merge_tree_bytes, nanoseconds_per_step, plant_bytes
from windswept.studies.levels_plot import draw_levels


@click.command("levels")
@click.argument("source")
@click.option("--seed", type=SEED, default=0, show_default=True, help="Which individual of the species.")
@click.option(
    "--seconds", type=FiniteRange(1.0, 600.0), default=20.0, show_default=True, help="Of measuring."
)
@click.option(
    "--metric",
    type=click.Choice(sorted(METRICS)),
    default="displacement",
    show_default=True,
    help="What an error is; its figures are in the metric's unit.",
)
@click.option("--multibody", is_flag=True, help="With all links coupled as level 0, springs after it.")
@click.option("--plot", help="PNG file to draw errors over links into.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object instead of a table.")
def command(
    source: str, seed: int, seconds: float, metric: str, multibody: bool, plot: str | None, as_json: bool
) -> None:
    """Build the simulation levels of SOURCE and measure each against level 0.

    Errors are those of stem tips in gusty wind up to 12 m/s; the bound is a fifth more than the largest error in the
    hardest winds up to that speed that were tried. A level is good enough from its distance on: there 95 % of errors
    are within one pixel of a picture 1080 pixels high with a field of view of 60 degrees, and the largest within
    three.

    Example: windswept levels quaking_aspen
    """
    path = None if plot is None else Path(plot)
    if path is not None:
        check_place(path, (".png",), "--plot")
    plant = grow_source(source, seed)
    model = build_model(plant)
    with status_line("building levels") as say:
        started = time.perf_counter()
        ladder = build_ladder(simplify(model), multibody)
        seconds_to_build = time.perf_counter() - started
        say("measuring every level against level 0")
        measured = measure(ladder, seconds, metric=metric)
        stated = with_measured_errors(ladder, measured, bound_errors(ladder, metric))
        rows = [level_row(stated, measured, rung, METRICS[metric]) for rung in range(len(ladder.levels))]
    report = {
        "species": plant.species,
        "stated_wind_m_s": STATED_WIND,
        "metric": metric,
        "unit": METRICS[metric].unit,
        "levels": rows,
        "build_seconds": round(seconds_to_build, 4),
        "bytes_plant": plant_bytes(plant, ladder.levels[0]),
        "bytes_levels": levels_bytes(ladder),
        "bytes_merge_tree": merge_tree_bytes(ladder),
    }
    if path is not None:
        draw_levels(report, path)
    if as_json:
        click.echo(json.dumps(report))
    else:
        _print_table(report)


def level_row(stated: Ladder, measured: Measured, rung: int, metric: Metric) -> dict[str, Any]:
    """Figures of one level of a ladder whose errors and bound are measured; only errors in metres have a distance."""
    assert stated.bound is not None
    unit = metric.suffix
    eye = Eye(np.zeros(3, np.float32), np.radians(60.0))
    level = stated.levels[rung]
    return {
        "level": rung,
        "motion": "multibody" if level.coupled else "springs",
        "links": level.link_count + level.group_count,
        "rigid_links": level.link_count,
        "groups": level.group_count,
        f"bound_{unit}": round(float(stated.bound[rung]), 5),
        f"measured_p95_{unit}": round(float(measured.p95[rung]), 5),
        f"measured_max_{unit}": round(float(measured.largest[rung]), 5),
        f"stated_{unit}": round(float(stated.error[rung]), 5),
        "rms_over_motion": round(float(measured.rms[rung] / measured.motion), 4),
        "distance_m": round(float(eye.distance(stated.error[rung])), 2) if metric.unit == "m" else None,
        "ns_per_step": round(nanoseconds_per_step(stated.hierarchy.model, level), 1),
    }


def _print_table(report: dict[str, Any]) -> None:
    click.echo(
        f"{'level':>5} {'links':>7} {'p95':>9} {'max':>9} {'bound':>9} {'rms/motion':>10} {'from m':>8}"
        f" {'ns/step':>10}   errors in {report['unit']}"
    )
    unit = METRICS[report["metric"]].suffix
    for row in report["levels"]:
        p95, largest, bound = (row[f"{name}_{unit}"] for name in ("measured_p95", "measured_max", "bound"))
        distance = "" if row["distance_m"] is None else f"{row['distance_m']:.1f}"
        click.echo(
            f"{row['level']:>5} {row['links']:>7} {p95:>9.4f} {largest:>9.4f} {bound:>9.4f}"
            f" {row['rms_over_motion']:>10.1%} {distance:>8} {row['ns_per_step']:>10.0f}"
        )
    if report["levels"][0]["motion"] == "multibody":
        coupled = [str(row["level"]) for row in report["levels"] if row["motion"] == "multibody"]
        click.echo(f"multibody: {', '.join(coupled)}; the others: springs")
    share = report["bytes_levels"] / report["bytes_plant"]
    click.echo(
        f"built in {report['build_seconds']:.3f} s; {share:.0%} of the memory of the plant and its level 0, and"
        f" {report['bytes_merge_tree'] / report['bytes_plant']:.0%} for the tree that near plants are cut from"
    )
