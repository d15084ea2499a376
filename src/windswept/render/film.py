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
from windswept.render.offscreen import render_picture
from windswept.render.staging import LevelLooks, Running, frame_now, stage
from windswept.render.video import VIDEO_ENDINGS, render_video

PICTURE_ENDINGS = (".png",)


@dataclass(frozen=True, slots=True)
class Shot:
    """How a scene is drawn."""

    size: tuple[int, int] = (1280, 720)
    """Width and height, pixels."""
    level_looks: LevelLooks | None = None
    """Colours every plant by its simulation level; None for its own colours."""
    progress: Callable[[int, int], None] = lambda done, total: None
    """Told frames done and frames in all."""


@dataclass(frozen=True, slots=True)
class Spent:
    """What a film took."""

    simulating: float
    """Wall time, s; a card works on while the CPU goes ahead."""
    stage_milliseconds: dict[str, float]
    """By the card's clock, of the simulation's last steps if it ran there, and of the last picture."""
    refused: int
    """Placements that the card had no room to draw, in the frame that lacked most."""


def check_film(path: Path) -> None:
    """Refuses a path that can become neither a picture nor a video, before any work is done.

    Raises:
        InputError: unknown ending, or a place that cannot be written to.
    """
    check_place(path, PICTURE_ENDINGS + VIDEO_ENDINGS)


def film_picture(simulation: Running, path: Path, at: float, shot: Shot) -> Spent:
    """Runs a simulation to a moment and draws it in full detail.

    Args:
        simulation: at its start.
        path: .png
        at: time of the picture, s.
        shot: how it is drawn.

    Raises:
        InputError: unknown ending, or a place that cannot be written to.
        GraphicsError: there is no graphics adapter.
    """
    check_film(path)
    renderer, meter = _stage(simulation, shot.size, DetailRules()), _Meter()
    meter.advance(simulation, at)
    frame = frame_of(simulation, shot)
    render_picture(renderer, frame, path)
    meter.note_refused(renderer, frame)
    shot.progress(1, 1)
    return Spent(meter.simulating, _stage_times(simulation, renderer), meter.refused)


def film_video(simulation: Running, path: Path, shot: Shot, still: tuple[Path, float] | None = None) -> Spent:
    """Runs a simulation through its scene and draws all frames.

    Args:
        simulation: at its start.
        path: .mp4 or .webp
        shot: how it is drawn.
        still: a .png and a time, s: that moment is drawn in full detail as well, on the way.

    Raises:
        InputError: unknown ending, or a place that cannot be written to.
        GraphicsError: there is no graphics adapter.
    """
    check_film(path)
    if still:
        check_place(still[0], PICTURE_ENDINGS)
    scene, meter = simulation.scene, _Meter()
    total = scene.frame_count
    renderer = _stage(simulation, shot.size)
    frames = _frames(simulation, renderer, shot, meter, still)
    render_video(renderer, frames, path, scene.frames_per_second, lambda done: shot.progress(done, total))
    return Spent(meter.simulating, _stage_times(simulation, renderer), meter.refused)


def _stage_times(simulation: Running, renderer: Renderer) -> dict[str, float]:
    """How long every stage took on the card when it last ran."""
    on_card = simulation.stage_milliseconds if isinstance(simulation, GpuSimulation) else {}
    return on_card | renderer.stage_milliseconds


@dataclass(slots=True)
class _Meter:
    """What a film takes, added up frame by frame; see ``Spent``."""

    simulating: float = 0.0
    refused: int = 0

    def advance(self, simulation: Running, seconds: float) -> None:
        """Lets time pass in a simulation, by the clock."""
        started = time.perf_counter()
        simulation.advance(seconds)
        self.simulating += time.perf_counter() - started

    def note_refused(self, renderer: Renderer, frame: Frame) -> None:
        """Takes down who found no room in the frame that was drawn last; those whose poses come from the CPU all do."""
        if frame.motion is not None:
            self.refused = max(self.refused, renderer.told_now.refused)


def _frames(
    simulation: Running, renderer: Renderer, shot: Shot, meter: _Meter, still: tuple[Path, float] | None
) -> Iterator[Frame]:
    """All frames of a scene; each is drawn by ``renderer`` before the next is asked for."""
    step = 1.0 / simulation.scene.frames_per_second
    for index in range(simulation.scene.frame_count):
        if index:
            meter.advance(simulation, step)
        frame = frame_of(simulation, shot)
        if still and abs(index * step - still[1]) <= 0.5 * step:
            finest = _stage(simulation, shot.size, DetailRules())
            render_picture(finest, frame, still[0])
            meter.note_refused(finest, frame)
        yield frame
        meter.note_refused(renderer, frame)


def _stage(simulation: Running, size: tuple[int, int], rules: DetailRules | None = None) -> Renderer:
    """A renderer for a simulation; what is spent on its plants is spent on its underbrush as well."""
    return stage(simulation, size, rules, None if rules is None else BladeRules())


def frame_of(simulation: Running, shot: Shot) -> Frame:
    """What is to be seen at this moment."""
    return frame_now(simulation, level_looks=shot.level_looks)
