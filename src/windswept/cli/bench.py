"""``windswept bench``."""

from __future__ import annotations

import importlib
import json
import math

import click

NAMES = (
    "springs",
    "multibody",
    "levels",
    "accuracy",
    "forest",
    "bend",
    "blades",
    "field",
    "growth",
    "spread",
    "draw",
    "gpu_springs",
    "gpu_bend",
    "gpu_blades",
    "gpu_meadow",
    "gpu_multibody",
    "forest_gpu",
)


@click.command("bench")
@click.argument("names", nargs=-1, type=click.Choice(NAMES), metavar="[NAME]...")
@click.option("--json", "as_json", is_flag=True, help="One flat JSON object of name: value.")
def command(names: tuple[str, ...], as_json: bool) -> None:
    """Measure speed on this machine, of some parts or of all.

    Parts: springs, multibody, levels, accuracy, forest, bend, blades, field, growth, spread, draw, gpu_springs,
    gpu_bend, gpu_blades, gpu_meadow, gpu_multibody and forest_gpu.

    Example: windswept bench springs --json
    """
    from windswept.studies.machine import machine

    figures: dict[str, object] = dict(machine())
    for name in names or NAMES:
        run = getattr(importlib.import_module(f"windswept.studies.bench_{name}"), f"bench_{name}")
        measured = run(lambda line: click.echo(line, err=True))
        figures |= {key: float(f"{value:.4g}") for key, value in measured.items() if math.isfinite(value)}
    if as_json:
        click.echo(json.dumps(figures))
        return
    width = max(map(len, figures))
    for key, value in figures.items():
        click.echo(f"{key:<{width}}  {value}")
