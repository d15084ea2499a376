"""``windswept view``."""

from __future__ import annotations

import math

import click

from windswept.cli.numbers import SEED
from windswept.cli.progress import status_line
from windswept.cli.render import start, start_again
from windswept.errors import GraphicsError
from windswept.scene.camera import view_at
from windswept.scene.load_scene import load_scene
from windswept.scene.scene import Scene
from windswept.scene.simulation import Simulation


@click.command("view")
@click.argument("source", metavar="SCENE")
@click.option("--seed", type=SEED, help="Instead of the scene's.")
@click.option(
    "--level-colours", is_flag=True, help="Colour plants by simulation level: red every link, violet one."
)
@click.option(
    "--gpu",
    is_flag=True,
    help="Simulate on the graphics card; on the CPU where it has too little memory, in a new window if it is lost.",
)
@click.option("--multibody", is_flag=True, help="Couple all links of plants near the camera.")
def command(source: str, seed: int | None, level_colours: bool, gpu: bool, multibody: bool) -> None:
    """Open a live window on SCENE: drag to orbit, scroll to zoom, sliders for the wind, pause.

    Example: windswept view weeping_willow
    """
    view_scene(load_scene(source, seed), level_colours, gpu, multibody)


def view_scene(scene: Scene, level_colours: bool = False, gpu: bool = False, multibody: bool = False) -> None:
    """Opens the window and runs until it is closed; where the card that simulates is lost, once more on the CPU.

    Args:
        scene: to show.
        level_colours: colour plants by their simulation level.
        gpu: simulate on the card.
        multibody: couple the links of plants near the camera.

    Raises:
        GraphicsError: no display, no adapter, the window libraries are not installed, or the card was lost again.
    """
    from windswept.render.live_scene import LiveScene
    from windswept.render.live_view import Controls
    from windswept.render.staging import camera_of
    from windswept.render.window import SIZE, require_window, show_window

    require_window()
    with status_line("growing plants") as say:
        simulation = start(scene, True, SIZE, gpu, say, multibody)
    mean, camera = scene.wind.mean, camera_of(view_at(scene.camera, 0.0))
    controls = Controls(wind_speed=mean.speed, wind_heading=math.remainder(mean.azimuth, math.tau))
    try:
        show_window(LiveScene(simulation, level_colours), camera, controls)
        return
    except GraphicsError as error:
        if isinstance(simulation, Simulation):
            raise
        click.echo(f"windswept: {error}; starting again on the CPU", err=True)
    with status_line("measuring levels"):
        simulation = start_again(simulation, True, SIZE, multibody)
    show_window(LiveScene(simulation, level_colours), camera, controls)
