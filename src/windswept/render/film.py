"""A scene as a picture or a video: simulate, pose, draw, frame by frame."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from windswept.errors import InputError
from windswept.geometry.detail import DetailRules
from windswept.gpu.frame import Frame
from windswept.render.offscreen import render_picture
from windswept.render.staging import frame_now, stage
from windswept.render.video import VIDEO_ENDINGS, render_video
from windswept.scene.simulation import Simulation

PICTURE_ENDINGS = (".png",)


def check_ending(path: Path) -> None:
    """Refuses a path that is neither a picture nor a video, before any work is done.

    Raises:
        InputError: unknown ending, or a folder that does not exist.
    """
    if path.suffix.lower() not in PICTURE_ENDINGS + VIDEO_ENDINGS:
        raise InputError(str(path), "", path.suffix, "a path that ends in .png, .mp4 or .webp")
    if not path.absolute().parent.is_dir():
        raise InputError(str(path), "", str(path.parent), "a folder that exists")


def film(
    simulation: Simulation,
    path: Path,
    size: tuple[int, int] = (1280, 720),
    at: float | None = None,
    progress: Callable[[int, int], None] = lambda done, total: None,
    level_colours: bool = False,
) -> None:
    """Runs a simulation and draws it.

    Args:
        simulation: at its start.
        path: .png for one picture, .mp4 or .webp for all frames of the scene.
        size: width and height, pixels.
        at: time of the picture, s; None for the middle of the scene.
        progress: told frames done and frames in all.
        level_colours: colour every plant by its simulation level.

    Raises:
        InputError: unknown ending, or a folder that does not exist.
        GraphicsError: there is no graphics adapter.
    """
    check_ending(path)
    scene = simulation.scene
    if path.suffix.lower() in PICTURE_ENDINGS:
        # A single picture may take its time: full detail on any device.
        renderer = stage(simulation, size, DetailRules())
        simulation.advance(0.5 * scene.duration if at is None else at)
        render_picture(renderer, frame_now(simulation, level_colours=level_colours), path)
        progress(1, 1)
        return
    renderer = stage(simulation, size)
    total = scene.frame_count
    render_video(
        renderer,
        _frames(simulation, total, level_colours),
        path,
        scene.frames_per_second,
        lambda done: progress(done, total),
    )


def _frames(simulation: Simulation, count: int, level_colours: bool) -> Iterator[Frame]:
    for index in range(count):
        if index:
            simulation.advance(1.0 / simulation.scene.frames_per_second)
        yield frame_now(simulation, level_colours=level_colours)
