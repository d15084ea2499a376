"""``windswept render``."""

from __future__ import annotations

import json
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from windswept.cli.numbers import SEED, FiniteRange
from windswept.cli.progress import progress_bar, status_line
from windswept.errors import InputError
from windswept.scene.load_scene import load_scene
from windswept.scene.scene import Scene
from windswept.scene.simulation import Simulation

LARGEST_SIDE = 8192
"""Pixels: what every graphics adapter can draw."""


def parse_size(_context: object, _parameter: object, text: str) -> tuple[int, int]:
    """Width and height from "1280x720"."""
    parts = text.lower().split("x")
    if len(parts) == 2 and all(part.isdigit() and 16 <= int(part) <= LARGEST_SIDE for part in parts):
        return int(parts[0]), int(parts[1])
    raise InputError("--size", "", text, f"WIDTHxHEIGHT of 16 to {LARGEST_SIDE} pixels, like 1280x720")


@click.command("render")
@click.argument("source", metavar="SCENE")
@click.option("-o", "--output", required=True, type=click.Path(path_type=Path), help=".png, .mp4 or .webp")
@click.option("--size", default="1280x720", show_default=True, callback=parse_size, help="Width and height.")
@click.option(
    "--at", type=FiniteRange(0.0, 3600.0), help="Time of a picture, s; the scene's middle if not given."
)
@click.option(
    "--duration", type=FiniteRange(0.01, 3600.0), help="Length of a video instead of the scene's, s."
)
@click.option("--seed", type=SEED, help="Instead of the scene's.")
@click.option(
    "--levels/--no-levels", default=True, help="Simulate far plants at coarser levels (default) or not."
)
@click.option(
    "--level-colours", is_flag=True, help="Colour plants by simulation level: red every link, violet one."
)
@click.option("--json", "as_json", is_flag=True, help="Report as one JSON object.")
def command(
    source: str,
    output: Path,
    size: tuple[int, int],
    at: float | None,
    duration: float | None,
    seed: int | None,
    levels: bool,
    level_colours: bool,
    as_json: bool,
) -> None:
    """Draw SCENE (a scene file, or a SOURCE: a lone plant) to a picture or a video, without a screen.

    Example: windswept render examples/forest_edge.toml -o edge.mp4
    """
    from windswept.render.film import check_film

    check_film(output)
    scene = load_scene(source, seed)
    if duration is not None:
        scene = replace(scene, duration=duration)
    figures = render_scene(scene, output, size, at, levels, level_colours)
    if as_json:
        click.echo(json.dumps(figures))


def render_scene(
    scene: Scene,
    output: Path,
    size: tuple[int, int],
    at: float | None = None,
    levels: bool = True,
    level_colours: bool = False,
    still: tuple[Path, float] | None = None,
) -> dict[str, Any]:
    """Simulates and draws a scene with progress on stderr, and says what it took."""
    from windswept.render.film import PICTURE_ENDINGS, Shot, film_picture, film_video

    started = time.perf_counter()
    with status_line("growing plants") as say:
        simulation = Simulation(scene, levels=levels, picture_height=size[1], say=say)
    ready = time.perf_counter()
    with progress_bar(f"drawing {output.name}") as progress:
        shot = Shot(size, level_colours, progress)
        if output.suffix.lower() in PICTURE_ENDINGS:
            simulating = film_picture(simulation, output, 0.5 * scene.duration if at is None else at, shot)
        else:
            simulating = film_video(simulation, output, shot, still)
    return {
        "output": str(output),
        "plants": scene.placement_count,
        "kinds": len(scene.kinds),
        "links": simulation.link_count,
        "stepped": simulation.stepped_count,
        "placements_by_level": simulation.placements_by_level,
        "simulated_s": round(simulation.time, 3),
        "steps_per_second": round(simulation.step_count / max(simulating, 1e-9), 1),
        "grow_seconds": round(ready - started, 2),
        "draw_seconds": round(time.perf_counter() - ready, 2),
    }
