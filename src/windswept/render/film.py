"""A scene as a picture or a video: simulate, pose, draw, frame by frame."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from windswept.forms.files import check_place
from windswept.geometry.detail import DetailRules
from windswept.gpu.frame import Frame
from windswept.gpu.meadow.blade_list import BladeRules
from windswept.gpu.renderer import Renderer
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.render.card_staging import frame_on_card, stage_on_card
from windswept.render.offscreen import render_picture
from windswept.render.staging import frame_now, stage
from windswept.render.video import VIDEO_ENDINGS, render_video
from windswept.scene.simulation import Simulation

PICTURE_ENDINGS = (".png",)
Running = Simulation | GpuSimulation
"""A scene in motion, on the CPU or on the card."""


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


def film_picture(simulation: Running, path: Path, at: float, shot: Shot) -> float:
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
    renderer = _stage(simulation, shot.size, DetailRules())
    started = time.perf_counter()
    simulation.advance(at)
    seconds = time.perf_counter() - started
    render_picture(renderer, frame_of(simulation, shot), path)
    shot.progress(1, 1)
    return seconds


def film_video(simulation: Running, path: Path, shot: Shot, still: tuple[Path, float] | None = None) -> float:
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
        _stage(simulation, shot.size),
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
    simulation: Running, count: int, shot: Shot, clock: _Clock, still: tuple[Path, float] | None
) -> Iterator[Frame]:
    step = 1.0 / simulation.scene.frames_per_second
    for index in range(count):
        if index:
            started = time.perf_counter()
            simulation.advance(step)
            clock.seconds += time.perf_counter() - started
        frame = frame_of(simulation, shot)
        if still and abs(index * step - still[1]) <= 0.5 * step:
            render_picture(_stage(simulation, shot.size, DetailRules()), frame, still[0])
        yield frame


def _stage(simulation: Running, size: tuple[int, int], rules: DetailRules | None = None) -> Renderer:
    """A renderer for a simulation, wherever it runs."""
    if isinstance(simulation, GpuSimulation):
        return stage_on_card(simulation, size, rules)
    return stage(simulation, size, rules, None if rules is None else BladeRules())


def frame_of(simulation: Running, shot: Shot) -> Frame:
    """What is to be seen at this moment."""
    if isinstance(simulation, GpuSimulation):
        return frame_on_card(simulation, level_colours=shot.level_colours)
    return frame_now(simulation, level_colours=shot.level_colours)
