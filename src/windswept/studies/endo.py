"""Endo, Morimoto and Fabris (2003), section 6, made by our code: a field of grass and a field of flowers.

The paper draws 200 tufts of grass, or 200 flowers with 1,000 leaves, at 500 x 500 with 10 to 20 frames per second (on
a Pentium III with 900 MHz). A frame of the paper has one look-up and one move of every blade; ours is drawn from
leans that were stepped 120 times a second before, so steps and frames are stated apart.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from windswept.gpu.device import adapter_summary
from windswept.motion import TIME_STEP
from windswept.render.staging import frame_now, stage
from windswept.scene.load_scene import build_scene
from windswept.scene.meadow import Meadow, plant_meadow
from windswept.scene.scene import Scene
from windswept.scene.simulation import WIND_INTERVAL, Simulation
from windswept.studies.machine import median_seconds

PAPER_FRAMES = (10.0, 20.0)
"""Per second, "depending on the number of instances shown and the movement of the user"."""
SIZE = (500, 500)
"""Of the paper's pictures, pixels."""
TUFTS = 200
FLOWERS = {"common_poppy": 55, "cornflower": 7, "oxeye_daisy": 3}
"""Tufts of each species that come to some 200 flowers and 1,000 leaves."""
FLOWER_STEMS, LEAVES = ("stem",), ("leaf", "rosette", "stem_leaf")
"""Components that are a flower each, and leaves."""
COUNTS = (10_000, 100_000, 1_000_000)
DENSITY = 30.0
"""Tufts on a square metre."""
EVERY_BLADE = 10**9
"""Height of a picture, pixels, for which no blade is left out when a meadow is planted."""
STEPPED = 40 * WIND_INTERVAL * TIME_STEP
"""Wind before anything is timed, s."""


def endo(
    folder: Path | None = None,
    counts: tuple[int, ...] = COUNTS,
    say: Callable[[str], None] = lambda line: None,
) -> list[dict[str, Any]]:
    """Rows of the paper's figures beside ours.

    Args:
        folder: where pictures after its figures 3, 4, 8 and 9 go; None for none.
        counts: blades of the larger fields.
        say: told what is being done.
    """
    if folder is not None:
        from windswept.studies.endo_pictures import draw_figures

        draw_figures(folder, say)
    say("200 tufts")
    rows = [_row("grass", grass_field(TUFTS), PAPER_FRAMES)]
    say("200 flowers with 1,000 leaves")
    rows.append(_row("flowers", flower_field(), PAPER_FRAMES))
    for count in counts:
        say(f"{count} blades")
        rows.append(_row("grass", grass_field(tufts_for(count)), None))
    return rows


def grass_field(tufts: int) -> Scene:
    """Tufts of fescue, seen from beside the field."""
    return _field({"meadow_fescue": tufts})


def flower_field() -> Scene:
    """Some 200 flowers with some 1,000 leaves."""
    return _field(FLOWERS)


def tufts_for(blades: int) -> int:
    """How many tufts of fescue have so many blades."""
    few = Meadow(plant_meadow(grass_field(30), EVERY_BLADE))
    return max(round(blades * 30 / few.blade_count), 1)


def _field(tufts: dict[str, int]) -> Scene:
    """Tufts scattered over a square in a gusty wind."""
    half = 0.5 * math.sqrt(sum(tufts.values()) / DENSITY)
    rng = np.random.default_rng(5)
    plants = []
    for source, count in tufts.items():
        for (x, y), yaw in zip(
            rng.uniform(-half, half, (count, 2)).tolist(),
            rng.uniform(0.0, 360.0, count).tolist(),
            strict=True,
        ):
            plants.append({"source": source, "position": [x, y], "yaw_degrees": yaw})
    data = {
        "ground": {"size_m": max(4.0 * half, 20.0)},
        "wind": {"speed_m_s": 4.0, "turbulence": 0.3},
        "plant": plants,
        "camera": {"eye": [0.0, -half - 1.8, 1.2], "target": [0.0, -0.1 * half, 0.25], "fov_degrees": 45.0},
        "sun": {"azimuth_degrees": 130.0, "elevation_degrees": 24.0},
    }
    return build_scene("endo", data)


def _row(what: str, scene: Scene, paper: tuple[float, float] | None) -> dict[str, Any]:
    """What a field has, and how fast it is stepped and drawn."""
    simulation = Simulation(scene, picture_height=EVERY_BLADE)
    simulation.advance(STEPPED)
    meadow = simulation.meadow
    assert meadow is not None
    interval = WIND_INTERVAL * TIME_STEP
    seconds = median_seconds(lambda: simulation.advance(interval), repeats=15, warm_up=2) / WIND_INTERVAL
    renderer = stage(simulation, SIZE)
    draws = []
    for _ in range(4):
        simulation.advance(interval)
        started = time.perf_counter()
        renderer.draw(frame_now(simulation))
        draws.append(time.perf_counter() - started)
    assert renderer.meadow is not None
    drawn = float(np.median(draws[1:]))
    return {
        "what": what,
        "tufts": scene.tuft_count,
        "flowers": _count(meadow, FLOWER_STEMS) if what == "flowers" else 0,
        "leaves": _count(meadow, LEAVES),
        "blades": meadow.blade_count,
        "paper_fps": None if paper is None else list(paper),
        "frames_per_second": 1.0 / drawn,
        "blades_drawn": renderer.meadow.drawn_count,
        "steps_per_second": 1.0 / seconds,
        "ns_per_blade_step": 1e9 * seconds / meadow.stepped_count,
        "on": adapter_summary(),
    }


def _count(meadow: Meadow, names: tuple[str, ...]) -> int:
    """Blades of components with some names."""
    return sum(blades.count for bed in meadow.beds for blades in bed.blades if blades.kind.name in names)
