"""A meadow on the card, from the wind over leans, choice and poses to the picture, with nothing read back."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from windswept.gpu.device import adapter_summary
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.motion import TIME_STEP
from windswept.render.staging import frame_now, stage
from windswept.scene.camera import View
from windswept.scene.meadow import plant_meadow
from windswept.scene.scene import Scene
from windswept.scene.simulation import WIND_INTERVAL
from windswept.studies.bench_gpu_springs import median_stages
from windswept.studies.endo import EVERY_BLADE, grass_field, tufts_for
from windswept.studies.machine import median_seconds

COUNT = 1_000_000
"""Blades."""
SIZE = (1280, 720)
FRAME_RATE = 60.0
FRAMES, REPEATS = 4, 9


def bench_gpu_meadow(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``gpu.meadow.<blades>.*``: stages by the card's own clock, frames a second, memory of the motion.

    ``lean.ms`` is four steps.
    """
    say(f"gpu meadow of {COUNT} blades at {SIZE[0]} x {SIZE[1]}, on {adapter_summary()}")
    return meadow_figures(grass_field(tufts_for(COUNT)), SIZE, REPEATS)


def meadow_figures(scene: Scene, size: tuple[int, int], repeats: int) -> dict[str, float]:
    """What a frame of a field of grass comes to, as an eye goes by."""
    simulation = GpuSimulation(scene, [], picture_height=size[1], beds=plant_meadow(scene, EVERY_BLADE))
    meadow, interval = simulation.meadow, WIND_INTERVAL * TIME_STEP
    assert meadow is not None
    leaning = median_stages(lambda: simulation.advance(interval).stage_milliseconds, repeats)
    renderer = stage(simulation, size)
    assert renderer.meadow is not None
    width = 0.25 * scene.terrain.size

    def draw(frames: int) -> None:
        for _ in range(frames):
            simulation.advance(1.0 / FRAME_RATE)
            along = 0.1 * width * math.sin(simulation.time)
            eye, target = np.array([[along, -0.5 * width, 1.5], [along, 0.0, 0.2]], np.float32)
            renderer.draw_aside(frame_now(simulation, View(eye, target, 0.8)))
        meadow.leaning.wait()

    def stages() -> dict[str, float]:
        draw(1)
        return renderer.stage_milliseconds

    drawing = median_stages(stages, repeats)
    seconds = median_seconds(lambda: draw(FRAMES), repeats, warm_up=1) / FRAMES
    figures = {
        "drawn": renderer.meadow.drawn_count,
        "bytes": meadow.leaning.bytes,
        "frame.ms": 1e3 * seconds,
        "frames_per_second": 1.0 / seconds,
        **{f"{name}.ms": value for name, value in (leaning | drawing).items()},
    }
    return {f"gpu.meadow.{meadow.blade_count}.{name}": float(value) for name, value in figures.items()}
