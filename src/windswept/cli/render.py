"""``windswept render``."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from windswept.cli.numbers import SEED, FiniteRange
from windswept.cli.progress import progress_bar, status_line
from windswept.errors import GraphicsError, InputError
from windswept.forms.files import check_place
from windswept.scene.load_scene import load_scene
from windswept.scene.meadow import plant_meadow
from windswept.scene.scene import Scene
from windswept.scene.simulation import Simulation

if TYPE_CHECKING:
    from windswept.gpu.springs.simulation import GpuSimulation
    from windswept.plants.plant import Plant
    from windswept.render.film import Shot, Spent
    from windswept.scene.meadow_bed import Bed

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
@click.option(
    "--gpu",
    is_flag=True,
    help="Simulate on the graphics card; on the CPU where it has too little memory or is lost.",
)
@click.option("--multibody", is_flag=True, help="Couple all links of plants near the camera.")
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
    gpu: bool,
    multibody: bool,
    as_json: bool,
) -> None:
    """Draw SCENE (a scene file, or a SOURCE: a lone plant) to a picture or a video, without a screen.

    Example: windswept render examples/forest_edge.toml -o edge.mp4
    """
    _check_asked(output, at, duration)
    with status_line(f"reading {source}"):
        scene = load_scene(source, seed)
    if duration is not None:
        scene = replace(scene, duration=duration)
    figures = render_scene(scene, output, size, at, levels, level_colours, gpu=gpu, multibody=multibody)
    if figures["clamped"]:
        line = "forces and speeds were held back: no number, or too large to be meant"
        click.echo(f"windswept: {figures['clamped']:,} {line}", err=True)
    if figures["refused"]:
        line = "plants found no room on the card and are missing from a picture"
        click.echo(f"windswept: {figures['refused']:,} {line}", err=True)
    click.echo(json.dumps(figures) if as_json else f"wrote {output}")


def _check_asked(output: Path, at: float | None, duration: float | None) -> None:
    """Refuses a file that cannot be made, and an option that it would not heed."""
    from windswept.render.film import PICTURE_ENDINGS
    from windswept.render.video import VIDEO_ENDINGS

    check_place(output, PICTURE_ENDINGS + VIDEO_ENDINGS, "--output")
    is_picture = output.suffix.lower() in PICTURE_ENDINGS
    if is_picture and duration is not None:
        raise InputError("--duration", "", duration, "a video as --output; the time of a picture is --at")
    if not is_picture and at is not None:
        raise InputError("--at", "", at, "a picture as --output; the length of a video is --duration")


def start(
    scene: Scene,
    levels: bool,
    size: tuple[int, int],
    gpu: bool,
    say: Callable[[str], None],
    multibody: bool = False,
) -> Simulation | GpuSimulation:
    """The scene in motion on the CPU, or on the card if that is asked for and it can, for pictures of a size."""
    height, aspect = size[1], size[0] / size[1]
    beds = plant_meadow(scene, height, say)
    if not gpu:
        return Simulation(
            scene, None, levels, picture_height=height, say=say, multibody=multibody, beds=beds, aspect=aspect
        )
    from windswept.gpu.multibody.simulation import CoupledSimulation
    from windswept.gpu.springs.kinds import grown_kinds
    from windswept.gpu.springs.simulation import GpuSimulation

    kinds = grown_kinds(scene, levels, say, multibody)
    run = CoupledSimulation if multibody else GpuSimulation
    try:
        return run(scene, kinds, picture_height=height, beds=beds, aspect=aspect)
    except GraphicsError as error:
        click.echo(f"windswept: {error}; simulating on the CPU", err=True)
        return _without_card(scene, [kind.plant for kind in kinds], beds, levels, size, multibody)


def _without_card(
    scene: Scene,
    plants: list[Plant],
    beds: tuple[Bed, ...],
    levels: bool,
    size: tuple[int, int],
    multibody: bool,
) -> Simulation:
    """The scene in motion on the CPU, with what has been grown and planted already."""
    height, aspect = size[1], size[0] / size[1]
    return Simulation(
        scene, plants, levels, picture_height=height, multibody=multibody, beds=beds, aspect=aspect
    )


def start_again(
    simulation: GpuSimulation, levels: bool, size: tuple[int, int], multibody: bool = False
) -> Simulation:
    """The scene of a simulation whose card was lost, on the CPU from its beginning."""
    beds = () if simulation.meadow is None else simulation.meadow.beds
    plants = [kind.plant for kind in simulation.kinds]
    return _without_card(simulation.scene, plants, beds, levels, size, multibody)


def render_scene(
    scene: Scene,
    output: Path,
    size: tuple[int, int],
    at: float | None = None,
    levels: bool = True,
    level_colours: bool = False,
    still: tuple[Path, float] | None = None,
    gpu: bool = False,
    multibody: bool = False,
) -> dict[str, Any]:
    """Simulates and draws a scene with progress on stderr, and says what it took."""
    from windswept.render.film import Shot
    from windswept.render.staging import LevelLooks

    started = time.perf_counter()
    with status_line("growing plants") as say:
        simulation = start(scene, levels, size, gpu, say, multibody)
    ready = time.perf_counter()
    with progress_bar(f"drawing {output.name}") as progress:
        shot = Shot(size, LevelLooks() if level_colours else None, progress)
        try:
            spent = _film(simulation, output, at, shot, still)
        except GraphicsError as error:
            if isinstance(simulation, Simulation):
                raise
            click.echo(f"windswept: {error}; starting again on the CPU", err=True)
            simulation = start_again(simulation, levels, size, multibody)
            spent = _film(simulation, output, at, shot, still)
    # A card works on while the CPU goes ahead: there only its own clock knows.
    speed = (
        {"steps_per_second": round(simulation.step_count / max(spent.simulating, 1e-9), 1)}
        if isinstance(simulation, Simulation)
        else {}
    )
    return {
        "output": str(output),
        "plants": scene.placement_count,
        "kinds": len(scene.kinds),
        "links": simulation.link_count,
        "stepped": simulation.stepped_count,
        "placements_by_level": simulation.placements_by_level,
        "held_levels": 0 if isinstance(simulation, Simulation) else simulation.refused_count,
        "tufts": scene.tuft_count,
        "blades": 0 if simulation.meadow is None else simulation.meadow.blade_count,
        "clamped": simulation.clamped_count,
        "refused": spent.refused,
        "simulated_s": round(simulation.time, 3),
        **speed,
        "stage_ms": {name: round(ms, 3) for name, ms in spent.stage_milliseconds.items()},
        "grow_seconds": round(ready - started, 2),
        "draw_seconds": round(time.perf_counter() - ready, 2),
    }


def _film(
    simulation: Simulation | GpuSimulation,
    output: Path,
    at: float | None,
    shot: Shot,
    still: tuple[Path, float] | None,
) -> Spent:
    """Runs and draws a simulation into the file that is asked for."""
    from windswept.render.film import PICTURE_ENDINGS, film_picture, film_video

    if output.suffix.lower() in PICTURE_ENDINGS:
        return film_picture(simulation, output, 0.5 * simulation.scene.duration if at is None else at, shot)
    return film_video(simulation, output, shot, still)
