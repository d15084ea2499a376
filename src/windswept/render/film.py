"""A scene as a picture or a video: simulate, pose, draw, frame by frame."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from windswept.forms.files import check_place
from windswept.geometry.detail import DetailRules
from windswept.gpu.frame import Frame
from windswept.render.offscreen import render_picture
from windswept.render.staging import frame_now, stage
from windswept.render.video import VIDEO_ENDINGS, render_video
from windswept.scene.simulation import Simulation

PICTURE_ENDINGS = (".png",)


@dataclass(frozen=True, slots=True)
class Shot:
    """How a scene is drawn."""

    size: tuple[int, int] = (1280, 720)
    """Width and height, pixels."""
    level_colours: bool = False
    """Colour every plant by its simulation level."""
    progress: Callable[[int, int], None] = lambda done, total: None
    """Told frames done and frames in all."""


def check_film(path: Path) -> None:
    """Refuses a path that can become neither a picture nor a video, before any work is done.

    Raises:
        InputError: unknown ending, or a place that cannot be written to.
    """
    check_place(path, PICTURE_ENDINGS + VIDEO_ENDINGS)


def film_picture(simulation: Simulation, path: Path, at: float, shot: Shot) -> float:
    """Runs a simulation to a moment and draws it in full detail.

    Args:
        simulation: at its start.
        path: .png
        at: time of the picture, s.
        shot: how it is drawn.

    Returns:
        Wall time that the simulation took, s.

    Raises:
        InputError: unknown ending, or a place that cannot be written to.
        GraphicsError: there is no graphics adapter.
    """
    check_film(path)
    renderer = stage(simulation, shot.size, DetailRules())
    started = time.perf_counter()
    simulation.advance(at)
    seconds = time.perf_counter() - started
    render_picture(renderer, frame_now(simulation, level_colours=shot.level_colours), path)
    shot.progress(1, 1)
    return seconds


def film_video(
    simulation: Simulation, path: Path, shot: Shot, still: tuple[Path, float] | None = None
) -> float:
    """Runs a simulation through its scene and draws all frames.

    Args:
        simulation: at its start.
        path: .mp4 or .webp
        shot: how it is drawn.
        still: a .png and a time, s: that moment is drawn in full detail as well, on the way.

    Returns:
        Wall time that the simulation took, s.

    Raises:
        InputError: unknown ending, or a place that cannot be written to.
        GraphicsError: there is no graphics adapter.
    """
    check_film(path)
    if still:
        check_place(still[0], PICTURE_ENDINGS)
    scene, clock = simulation.scene, _Clock()
    total = scene.frame_count
    frames = _frames(simulation, total, shot, clock, still)
    render_video(
        stage(simulation, shot.size),
        frames,
        path,
        scene.frames_per_second,
        lambda done: shot.progress(done, total),
    )
    return clock.seconds


class _Clock:
    """Wall time spent on one thing among others."""

    seconds = 0.0


def _frames(
    simulation: Simulation, count: int, shot: Shot, clock: _Clock, still: tuple[Path, float] | None
) -> Iterator[Frame]:
    step = 1.0 / simulation.scene.frames_per_second
    for index in range(count):
        if index:
            started = time.perf_counter()
            simulation.advance(step)
            clock.seconds += time.perf_counter() - started
        frame = frame_now(simulation, level_colours=shot.level_colours)
        if still and abs(index * step - still[1]) <= 0.5 * step:
            render_picture(stage(simulation, shot.size, DetailRules()), frame, still[0])
        yield frame
