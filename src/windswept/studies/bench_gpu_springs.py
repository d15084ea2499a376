"""Speed of the simulation on the card: nanoseconds per link and step, and the stages of a whole frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np

from windswept.errors import GraphicsError
from windswept.gpu.device import adapter_summary, is_software, shared_device
from windswept.gpu.springs.kinds import GrownKind, grown_kinds
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.motion import TIME_STEP, build_model
from windswept.render.staging import frame_now, stage
from windswept.scene.load_scene import load_scene
from windswept.scene.scene import Placements, PlantKind, Scene
from windswept.scene.simulation import WIND_INTERVAL
from windswept.studies.bench_forest import PLACEMENTS, forest
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.bench_springs import seconds_per_step
from windswept.studies.machine import median_seconds

SIZES = ((1_000, 128), (5_000, 128))
"""Links and placements, on any card."""
LARGE_SIZES = ((1_000, 8_192), (5_000, 4_096))
"""On a real card as well: fewer placements than it has lanes leave most of it idle."""
SPACING = 6.0
"""Between neighbours, m."""
REPEATS = 7
SIZE = (1280, 720)
FRAME_RATE = 60.0


def bench_gpu_springs(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``gpu.springs.*``, ``gpu.forest.*`` and ``gpu.frame.*``; stages by the card's own clock, if it has one.

    ``times_cpu`` is our time on the CPU, all its threads, over that on the card, in the same run. A software driver
    takes no plants as large as those of the whole frame's scene: there it is left out, and said.
    """
    say(f"gpu, on {adapter_summary()}")
    figures: dict[str, float] = {}
    sizes = SIZES if is_software(shared_device()) else SIZES + LARGE_SIZES
    for links, placements in sizes:
        say(f"gpu springs, {links} links x {placements}")
        figures |= _springs(links, placements)
    say(f"gpu forest, {PLACEMENTS} placements")
    figures |= _forest()
    say("gpu frame of the forest edge")
    try:
        return figures | _frame()
    except GraphicsError as error:
        say(f"not measured: {error}")
        return figures


def _springs(links: int, placements: int) -> dict[str, float]:
    """One plant at its finest level, many times."""
    scene, kind = grove(links, placements)
    card = GpuSimulation(scene, [kind])
    name = f"gpu.springs.{links}x{placements}"
    seconds = card_seconds_per_step(card) / (links * placements)
    on_cpu = seconds_per_step(kind.model, placements) / (links * placements)
    return {
        f"{name}.ns_per_link_step": 1e9 * seconds,
        f"{name}.bytes_per_link_step": bytes_per_link_step(),
        f"{name}.bytes": card.card.bytes,
        f"{name}.times_cpu": on_cpu / seconds,
    }


def grove(links: int, placements: int) -> tuple[Scene, GrownKind]:
    """One plant of so many links, many times, at its finest level."""
    plant = plant_with_links(links)
    side = int(np.ceil(np.sqrt(placements)))
    position = np.zeros((placements, 3), np.float32)
    position[:, :2] = SPACING * np.column_stack(np.divmod(np.arange(placements), side))
    placed = Placements(position, np.linspace(0.0, 6.0, placements).astype(np.float32))
    scene = replace(load_scene("hazel"), kinds=(PlantKind("bench", 0),), placements=(placed,))
    return scene, GrownKind(plant, build_model(plant), None, placed)


def bytes_per_link_step() -> float:
    """Bytes that one link of one placement asks the card's memory for in one step, if nothing stays in a cache.

    Its joint is read twice and written once (16 each), its parent is laid on the stack and taken up (80 each), and
    the wind at both ends of the interval is read (32). Constants are shared by the 64 placements of a block.
    """
    return 3 * 16 + 2 * 80 + 32


def card_seconds_per_step(card: GpuSimulation) -> float:
    """Median time of one inner step of all placements, s: of the steps alone where the card has a clock."""
    interval = WIND_INTERVAL * TIME_STEP

    def advance() -> float:
        card.advance(interval)
        return card.stage_milliseconds.get("simulate", 0.0)

    wall = median_seconds(advance, REPEATS)
    by_clock = float(np.median([advance() for _ in range(REPEATS)]))
    # The clock tells of the interval's last submission.
    clocked = (WIND_INTERVAL - 1) % card.steps_at_once + 1
    return 1e-3 * by_clock / clocked or wall / WIND_INTERVAL


def _forest() -> dict[str, float]:
    """The forest of ``bench forest`` with its levels chosen on the card."""
    scene: Scene = forest()
    card = GpuSimulation(scene, grown_kinds(scene, levels=True), picture_height=1080)
    card.advance(1.0)
    name = f"gpu.forest.{PLACEMENTS}"
    stages = median_stages(lambda: card.advance(WIND_INTERVAL * TIME_STEP).stage_milliseconds)
    return {
        f"{name}.oscillators_active": card.stepped_count,
        f"{name}.bytes": card.card.bytes,
        **{f"{name}.{stage}_ms": value for stage, value in stages.items()},
    }


def _frame() -> dict[str, float]:
    """Every stage of a frame of the example scene, nothing read back but the clock."""
    scene = load_scene(Path(str(files("windswept") / "scene" / "examples" / "forest_edge.toml")))
    card = GpuSimulation(scene, grown_kinds(scene, levels=True))
    renderer = stage(card, SIZE)
    card.advance(2.0)

    def one() -> dict[str, float]:
        card.advance(1.0 / FRAME_RATE)
        renderer.draw(frame_now(card))
        return card.stage_milliseconds | renderer.stage_milliseconds

    wall = median_seconds(one, REPEATS)
    stages = median_stages(one)
    return {"gpu.frame.ms": 1e3 * wall, **{f"gpu.frame.{stage}.ms": value for stage, value in stages.items()}}


def median_stages(run: Callable[[], dict[str, float]], repeats: int = REPEATS) -> dict[str, float]:
    """Median of what each stage took, ms."""
    runs = [run() for _ in range(repeats)]
    return {stage: float(np.median([one[stage] for one in runs if stage in one])) for stage in runs[0]}
