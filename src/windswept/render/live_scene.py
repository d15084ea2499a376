"""LiveScene: a simulation that a window runs, in the wind of its sliders and for the eye of its camera."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

import numpy as np

from windswept.gpu.frame import Camera, Frame
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.render.film import Shot, frame_of
from windswept.render.live_view import Controls
from windswept.render.staging import LevelLooks, Running
from windswept.scene.camera import View
from windswept.scene.eye_at import eye_of
from windswept.wind.blown import blown

COUNT_EVERY = 15
"""Frames between two counts, for which the card has to be waited for."""


class LiveScene:
    """What ``LiveView`` draws.

    Args:
        simulation: at its start.
        level_colours: colour plants by their simulation level.
    """

    def __init__(self, simulation: Running, level_colours: bool = False) -> None:
        self.simulation = simulation
        self._shot = Shot(level_looks=LevelLooks() if level_colours else None)
        self._frames = count()

    def advance(self, seconds: float, controls: Controls, camera: Camera, size: tuple[int, int]) -> Frame:
        """Lets time pass; see ``live_view.Advance``."""
        simulation = self.simulation
        simulation.wind = blown(simulation.scene.wind, controls.wind_speed, controls.wind_heading)
        eye, target = np.array([camera.eye, camera.target], np.float32)
        simulation.eye = eye_of(View(eye, target, camera.fov_y), size[1], size[0] / size[1])
        simulation.advance(seconds)
        if next(self._frames) % COUNT_EVERY == 0:
            controls.counters = counters(simulation)
        return replace(frame_of(simulation, self._shot), camera=camera)


def counters(simulation: Running) -> str:
    """Lines of text: what is stepped, and how long the card takes for it."""
    links = (
        f"{simulation.stepped_count:,} of {simulation.link_count:,} links stepped, {simulation.time:.0f} s"
    )
    if not isinstance(simulation, GpuSimulation):
        return links
    held = simulation.refused_count
    without_room = f", {held:,} plants without room for another level" if held else ""
    stages = ", ".join(f"{stage} {ms:.1f} ms" for stage, ms in simulation.stage_milliseconds.items())
    return f"{links}{without_room}\n{stages}"
