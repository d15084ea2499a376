"""One hour of a scene in the viewer's loop, without a window: neither memory nor the card's objects may grow.

``python -m windswept.studies.one_hour [SCENE] [--seconds 3600] [--rate 60] [--draw-every 60]``
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import wgpu

from windswept.gpu.device import adapter_summary
from windswept.gpu.springs.kinds import GrownKind, grown_kinds
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.levels import Eye
from windswept.render.staging import frame_now, stage
from windswept.scene.camera import View
from windswept.scene.load_scene import build_scene, load_scene
from windswept.scene.meadow import plant_meadow
from windswept.scene.scene import Scene
from windswept.wind.blown import blown

SIZE = (640, 360)
STROLL = 7.0
"""Seconds in which the walker crosses the grass."""
ROUND = 40.0
"""Seconds in which the eye goes once round, far off and back."""


def one_hour(
    scene: Scene, kinds: list[GrownKind], seconds: float, rate: float, draw_every: int, size: tuple[int, int]
) -> Iterator[dict[str, float]]:
    """Runs the loop; figures at a tenth of the way, where everything is warm, and at every further tenth.

    Underbrush and a force field of the scene run along.

    The eye moves, so that levels change all the time, and the wind is set anew at every frame, as sliders do.

    Args:
        scene: to run.
        kinds: its plants.
        seconds: simulated.
        rate: frames a simulated second.
        draw_every: one frame of so many is drawn.
        size: of the picture, pixels.
    """
    beds = plant_meadow(scene, size[1])
    card = GpuSimulation(scene, kinds, picture_height=size[1], beds=beds, aspect=size[0] / size[1])
    renderer = stage(card, size)
    total = math.ceil(seconds * rate)
    for frame in range(1, total + 1):
        view = _view(card.time)
        card.eye = Eye(view.eye, view.fov_y, size[1])
        card.wind = blown(scene.wind, 6.0 + 4.0 * math.sin(0.1 * card.time), 0.02 * card.time)
        card.advance(1.0 / rate)
        if frame % draw_every == 0:
            renderer.draw(frame_now(card, view))
        if frame % max(total // 10, 1) == 0:
            yield {"simulated_s": card.time, "steps": card.step_count, "frames": frame, **_memory()}


def hazel_in_grass(seconds: float) -> Scene:
    """A hazel with grass and daisies round it, through which somebody walks to and fro."""
    stops = [
        {"time_s": STROLL * n, "position": [2.0 - 4.0 * (n % 2), 0.5]}
        for n in range(math.ceil(seconds / STROLL) + 1)
    ]
    tufts = {
        "count": 40,
        "area": {"rectangle": [-2.0, -2.0, 2.0, 2.0]},
        "source": [{"source": name, "spacing_m": 0.2} for name in ("meadow_fescue", "oxeye_daisy")],
    }
    return build_scene(
        "hazel in grass",
        {
            "plant": [{"source": "hazel", "position": [0.0, -1.0]}],
            "stand": [tufts],
            "field": {
                "area": [-3.0, -3.0, 3.0, 3.0],
                "cell_m": 0.3,
                "layer_m": 0.3,
                "height_m": 2.4,
                "agent": [{"kind": "person", "stop": stops}],
            },
            "camera": {"eye": [9.0, -9.0, 3.0], "target": [0.0, 0.0, 1.0]},
        },
    )


def _view(time: float) -> View:
    """Where the eye is at a time."""
    turn = 2.0 * math.pi * time / ROUND
    away = 12.0 + 60.0 * (1.0 - math.cos(turn))
    eye = np.array([away * math.cos(0.3 * turn), away * math.sin(0.3 * turn), 4.0], np.float32)
    return View(eye, np.array([0.0, 0.0, 3.0], np.float32), 0.8)


def _memory() -> dict[str, float]:
    """Memory of this process, and what of the card's it holds on to."""
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    resident = next(line for line in status.splitlines() if line.startswith("VmRSS"))
    counts = wgpu.diagnostics.object_counts.get_dict()
    return {
        "resident_mb": int(resident.split()[1]) / 1024.0,
        "card_objects": counts["total"]["count"],
        "card_mb": counts["total"]["resource_mem"] / 1e6,
    }


def main() -> None:
    """Runs the study and prints a JSON object a line; a validation error ends it with a traceback."""
    parser = argparse.ArgumentParser(description="A scene in the viewer's loop, without a window.")
    parser.add_argument("scene", nargs="?", help="a hazel in grass if not given")
    parser.add_argument("--seconds", type=float, default=3600.0)
    parser.add_argument("--rate", type=float, default=60.0)
    parser.add_argument("--draw-every", type=int, default=60)
    asked = parser.parse_args()
    scene = load_scene(asked.scene) if asked.scene else hazel_in_grass(asked.seconds)
    print(json.dumps({"adapter": adapter_summary(), "scene": asked.scene or "hazel in grass"}))
    kinds = grown_kinds(scene, levels=True)
    for figures in one_hour(scene, kinds, asked.seconds, asked.rate, asked.draw_every, SIZE):
        print(json.dumps({name: round(value, 2) for name, value in figures.items()}), flush=True)


if __name__ == "__main__":
    main()
