"""``windswept demo``."""

from __future__ import annotations

import os
from importlib.resources import files
from pathlib import Path

import click

from windswept.cli.progress import status_line
from windswept.cli.render import parse_size, render_scene
from windswept.motion import TIME_STEP
from windswept.scene.load_scene import load_scene

SCENE = "forest_edge.toml"
PICTURE_TIME = 5.6
"""When the gust is in the middle of the stand, s."""


@click.command("demo")
@click.option("--size", default="1280x720", show_default=True, callback=parse_size, help="Width and height.")
@click.option("--headless", is_flag=True, help="Write the files even where there is a display.")
def command(size: tuple[int, int], headless: bool) -> None:
    """Grow a forest edge with a meadow and blow a gust through it.

    Writes windswept-demo.mp4 and windswept-demo.png here; opens the live window instead where there is a display.

    Example: windswept demo
    """
    source = files("windswept") / "scene" / "examples" / SCENE
    with status_line("reading the scene"):
        scene = load_scene(Path(str(source)))
    if not headless and (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        from windswept.cli.view import view_scene

        view_scene(scene)
        return
    video, picture = Path("windswept-demo.mp4"), Path("windswept-demo.png")
    figures = render_scene(scene, video, size, still=(picture, PICTURE_TIME))
    click.echo(f"wrote {video} and {picture}")
    click.echo(f"{figures['plants']} plants of {figures['kinds']} kinds with {figures['links']:,} links")
    click.echo(f"{figures['tufts']:,} tufts of underbrush with {figures['blades']:,} blades")
    if figures["clamped"]:
        click.echo(
            f"{figures['clamped']:,} forces and speeds were held back: no number, or too large to be meant"
        )
    click.echo(f"{figures['stepped']:,} oscillators were stepped at the end of the shot:")
    for level, count in enumerate(figures["placements_by_level"]):
        if count:
            click.echo(f"  simulation level {level}: {count} plants")
    click.echo(
        f"{figures['simulated_s']:.1f} s of wind were simulated in steps of 1/{1.0 / TIME_STEP:.0f} s, "
        f"{figures['steps_per_second']:,.0f} of them a second; "
        f"growing took {figures['grow_seconds']:.0f} s, simulating and drawing {figures['draw_seconds']:.0f} s"
    )
