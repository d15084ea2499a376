"""One hour of a scene in the viewer's loop, without a window: neither memory nor the card's objects may grow.

``python -m windswept.studies.one_hour [SCENE] [--seconds 3600] [--rate 30]``
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import wgpu

from windswept.gpu.device import adapter_summary, shared_device
from windswept.gpu.renderer import PICTURE_FORMAT
from windswept.gpu.springs.kinds import GrownKind, grown_kinds
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.render.live_scene import LiveScene
from windswept.render.live_view import TURN_PER_PIXEL, ZOOM_PER_STEP, Controls, LiveView
from windswept.render.orbit import orbit_from
from windswept.render.staging import camera_of, stage
from windswept.scene.camera import view_at
from windswept.scene.load_scene import build_scene, load_scene
from windswept.scene.meadow import plant_meadow
from windswept.scene.scene import Scene

SIZE = (96, 64)
"""Small, so that every frame of an hour can be drawn where the CPU plays the card."""
STROLL = 7.0
"""Seconds in which the walker crosses the grass."""
ROUND = 37.0
"""Seconds in which the eye goes once round, far off and back."""
FARTHEST = 20.0
"""How often as far as at the start the eye goes."""
BETWEEN_GUSTS, MOST_GUSTS = 60.0, 64
"""Seconds, and how many a scene may have."""


def one_hour(
    scene: Scene, kinds: list[GrownKind], seconds: float, rate: float, size: tuple[int, int]
) -> Iterator[dict[str, float]]:
    """Runs the loop; figures at a tenth of the way, where everything is warm, and at every further tenth.

    `LiveView` and `LiveScene` run as under ``windswept view --gpu``, every frame is drawn and copied into a texture as
    into a window's, and what stands below the sliders is read back as often; what is missing is the window itself, its
    panel and the wall's clock. Somebody drags, scrolls and moves the sliders at every frame, so that levels change.

    Args:
        scene: to run.
        kinds: its plants.
        seconds: simulated.
        rate: frames a simulated second.
        size: of the picture, pixels.
    """
    beds = plant_meadow(scene, size[1])
    card = GpuSimulation(scene, kinds, picture_height=size[1], beds=beds, aspect=size[0] / size[1])
    renderer, controls, target = stage(card, size), Controls(), _target(size)
    total, frame = math.ceil(seconds * rate), 0
    orbit = orbit_from(camera_of(view_at(scene.camera, 0.0)))
    view = LiveView(renderer, LiveScene(card).advance, orbit, controls, clock=lambda: frame / rate)
    for frame in range(1, total + 1):
        for event in _gestures(frame / rate, rate):
            view.handle(event)
        controls.wind_speed = 6.0 + 4.0 * math.sin(0.1 * card.time)
        controls.wind_heading = math.remainder(0.02 * card.time, math.tau)
        view.draw(size)
        renderer.copy_into(target)
        if frame % max(total // 10, 1) == 0:
            yield {
                "simulated_s": card.time,
                "steps": card.step_count,
                "frames": frame,
                "stepped": card.stepped_count,
                **_memory(),
            }


def aspen_in_grass(seconds: float) -> Scene:
    """An aspen and a hazel in grass and daisies, through which somebody walks to and fro; a gust a minute."""
    stops = [
        {"time_s": STROLL * n, "position": [2.0 - 4.0 * (n % 2), 0.5]}
        for n in range(math.ceil(seconds / STROLL) + 1)
    ]
    gusts = [
        {"start_s": BETWEEN_GUSTS * n, "strength_m_s": 6.0} for n in range(math.ceil(seconds / BETWEEN_GUSTS))
    ]
    tufts = {
        "count": 40,
        "area": {"rectangle": [-2.0, -2.0, 2.0, 2.0]},
        "source": [{"source": name, "spacing_m": 0.2} for name in ("meadow_fescue", "oxeye_daisy")],
    }
    return build_scene(
        "aspen and hazel in grass",
        {
            "wind": {"gust": gusts[:MOST_GUSTS]},
            "plant": [
                {"source": "hazel", "position": [0.0, -1.0]},
                {"source": "quaking_aspen", "position": [1.0, 6.0]},
            ],
            "stand": [tufts],
            "field": {
                "area": [-3.0, -3.0, 3.0, 3.0],
                "cell_m": 0.3,
                "layer_m": 0.3,
                "height_m": 2.4,
                "agent": [{"kind": "person", "stop": stops}],
            },
            "camera": {"eye": [2.5, -3.5, 1.8], "target": [0.0, 0.5, 1.2]},
        },
    )


def _gestures(time: float, rate: float) -> list[dict[str, Any]]:
    """Pointer and wheel as a window tells of them: in a round the eye goes once about its target, far off and back."""
    turn, frames = 2.0 * math.pi * time / ROUND, ROUND * rate
    pixels = 2.0 * math.pi / TURN_PER_PIXEL / frames
    steps = math.pi * math.log(FARTHEST) / math.log(ZOOM_PER_STEP) / frames
    return [
        {"event_type": "wheel", "dy": steps * math.sin(turn)},
        *({"event_type": "pointer_move", "buttons": (1,), "x": x, "y": 0.0} for x in (0.0, pixels)),
    ]


def _target(size: tuple[int, int]) -> Any:
    """A texture as windows have them."""
    usage = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_DST
    return shared_device().create_texture(size=(*size, 1), format=PICTURE_FORMAT, usage=usage)


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
    parser.add_argument("scene", nargs="?", help="an aspen and a hazel in grass if not given")
    parser.add_argument("--seconds", type=float, default=3600.0)
    parser.add_argument("--rate", type=float, default=30.0)
    asked = parser.parse_args()
    scene = load_scene(asked.scene) if asked.scene else aspen_in_grass(asked.seconds)
    print(json.dumps({"adapter": adapter_summary(), "scene": asked.scene or "aspen and hazel in grass"}))
    kinds = grown_kinds(scene, levels=True)
    for figures in one_hour(scene, kinds, asked.seconds, asked.rate, SIZE):
        print(json.dumps({name: round(value, 2) for name, value in figures.items()}), flush=True)


if __name__ == "__main__":
    main()
