"""Speed of drawing: one frame of the forest edge, drawn and read back, and growing numbers of branches."""

from __future__ import annotations

from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

from windswept.gpu.device import adapter_summary
from windswept.render.staging import frame_now, stage
from windswept.scene.load_scene import load_scene
from windswept.scene.simulation import Simulation
from windswept.studies.machine import median_seconds

SIZE = (1280, 720)


def bench_draw(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``draw.*`` at 1280 x 720, drawn and read back.

    ``draw.forest_edge.ms`` is a whole frame of the example scene; ``draw.<pieces>.ms`` the same with as many stem
    pieces actually drawn.
    """
    say(f"draw, on {adapter_summary()}")
    scene = load_scene(Path(str(files("windswept") / "scene" / "examples" / "forest_edge.toml")))
    simulation = Simulation(scene).advance(4.0)
    renderer, frame = stage(simulation, SIZE), frame_now(simulation)
    seconds = median_seconds(lambda: renderer.draw(frame), repeats=7)
    pieces, leaves = renderer.drawn_counts(frame)
    return {
        "draw.forest_edge.ms": 1e3 * seconds,
        "draw.forest_edge.leaves": leaves,
        f"draw.{pieces}.ms": 1e3 * seconds,
        "draw.forest_edge.pose_ms": 1e3 * median_seconds(lambda: frame_now(simulation), repeats=7),
    }
