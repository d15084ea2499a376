"""``windswept view``."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import count
from typing import TYPE_CHECKING

import click
import numpy as np

from windswept.cli.numbers import SEED
from windswept.cli.progress import status_line
from windswept.cli.render import start
from windswept.scene.camera import View, view_at
from windswept.scene.eye_at import eye_of
from windswept.scene.load_scene import load_scene
from windswept.scene.scene import Scene
from windswept.scene.simulation import Simulation
from windswept.wind.blown import blown

if TYPE_CHECKING:
    from windswept.gpu.springs.simulation import GpuSimulation

SIZE = (1280, 720)
"""Pixels that the window opens with: underbrush is planted for it, levels are chosen for the size it has."""
COUNT_EVERY = 15
"""Frames between two counts, for which the card has to be waited for."""


@click.command("view")
@click.argument("source", metavar="SCENE")
@click.option("--seed", type=SEED, help="Instead of the scene's.")
@click.option(
    "--level-colours", is_flag=True, help="Colour plants by simulation level: red every link, violet one."
)
@click.option(
    "--gpu", is_flag=True, help="Simulate on the graphics card; on the CPU where it has too little memory."
)
@click.option(
    "--multibody",
    is_flag=True,
    help="Move plants near the camera with all their links coupled; with --gpu all plants, without levels.",
)
def command(source: str, seed: int | None, level_colours: bool, gpu: bool, multibody: bool) -> None:
    """Open a live window on SCENE: drag to orbit, scroll to zoom, sliders for the wind, pause.

    Example: windswept view weeping_willow
    """
    view_scene(load_scene(source, seed), level_colours, gpu, multibody)


def view_scene(scene: Scene, level_colours: bool = False, gpu: bool = False, multibody: bool = False) -> None:
    """Opens the window and runs until it is closed.

    Args:
        scene: to show.
        level_colours: colour plants by their simulation level.
        gpu: simulate on the card.
        multibody: couple the links of plants near the camera; on the card those of all plants.

    Raises:
        GraphicsError: no display, no adapter, or the window libraries are not installed.
    """
    from windswept.geometry.curves import build_geometry
    from windswept.gpu.frame import Camera, Frame
    from windswept.render.film import Shot, frame_of
    from windswept.render.staging import LEVEL_LOOKS, LevelLooks, camera_of, ground_grid
    from windswept.render.window import Controls, require_display, show_window

    require_display()
    with status_line("growing plants") as say:
        simulation = start(scene, True, SIZE, gpu, say, multibody)
        plants = [kind.plant for kind in simulation.kinds]
        geometries = [build_geometry(plant) for plant in plants]

    shot, frames = Shot(level_looks=LevelLooks() if level_colours else None), count()

    def advance(seconds: float, controls: Controls, camera: Camera, size: tuple[int, int]) -> Frame:
        simulation.wind = blown(scene.wind, controls.wind_speed, controls.wind_heading)
        eye, target = np.array([camera.eye, camera.target], np.float32)
        simulation.eye = eye_of(View(eye, target, camera.fov_y), size[1], size[0] / size[1])
        simulation.advance(seconds)
        if next(frames) % COUNT_EVERY == 0:
            controls.counters = _counters(simulation)
        return replace(frame_of(simulation, shot), camera=camera)

    mean = scene.wind.mean
    show_window(
        plants,
        geometries,
        advance,
        camera_of(view_at(scene.camera, 0.0)),
        ground_grid(scene.terrain),
        Controls(wind_speed=mean.speed, wind_heading=math.remainder(mean.azimuth, math.tau)),
        "windswept",
        LEVEL_LOOKS,
        () if simulation.meadow is None else simulation.meadow.beds,
    )


def _counters(simulation: Simulation | GpuSimulation) -> str:
    """Lines of text below the sliders: what is stepped, and how long the card takes for it."""
    links = (
        f"{simulation.stepped_count:,} of {simulation.link_count:,} links stepped, {simulation.time:.0f} s"
    )
    if isinstance(simulation, Simulation):
        return links
    held = simulation.refused_count
    without_room = f", {held:,} plants without room for another level" if held else ""
    stages = ", ".join(f"{stage} {ms:.1f} ms" for stage, ms in simulation.stage_milliseconds.items())
    return f"{links}{without_room}\n{stages}"
