"""A hundred thousand placed trees, simulated, chosen and drawn on the card, seen by somebody who walks among them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from windswept.geometry.detail import SOFTWARE_RULES, DetailRules
from windswept.gpu.device import adapter_summary, is_software, shared_device
from windswept.gpu.renderer import Renderer
from windswept.gpu.springs.kinds import GrownKind, grown_kinds
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.render.staging import frame_now, stage
from windswept.scene.scene import Scene
from windswept.scene.simulation import WIND_INTERVAL
from windswept.studies.bench_forest import forest
from windswept.studies.bench_gpu_springs import median_stages
from windswept.studies.machine import median_seconds

PLACEMENTS = 100_000
FRAME_RATE = 60.0
LEAF_SCALE_LIMIT = 25.0
"""Most that a leaf is enlarged: one of 17 cm has 3 pixels as far as 900 m away in 720 lines; with the default of 5 it
has one pixel at half a kilometre."""
SIZE, FRAMES, REPEATS = (1280, 720), 16, 15
SOFTWARE_SIZE, SOFTWARE_FRAMES, SOFTWARE_REPEATS = (320, 180), 1, 3
"""Where the CPU plays the card."""


def bench_forest_gpu(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``gpu.forest.100000.*``: memory, what is drawn, stages by the card's own clock, frames a second."""
    software = is_software(shared_device())
    size = SOFTWARE_SIZE if software else SIZE
    say(f"gpu forest of {PLACEMENTS} trees at {size[0]} x {size[1]}, on {adapter_summary()}")
    scene = forest(PLACEMENTS)
    rules = replace(SOFTWARE_RULES if software else DetailRules(), leaf_scale_limit=LEAF_SCALE_LIMIT)
    walk = forest_walk(scene, grown_kinds(scene, levels=True), size, rules)
    frames, repeats = (SOFTWARE_FRAMES, SOFTWARE_REPEATS) if software else (FRAMES, REPEATS)
    return forest_figures(walk, frames, repeats)


@dataclass(frozen=True, slots=True)
class ForestWalk:
    """A forest on the card and who draws it."""

    simulation: GpuSimulation
    renderer: Renderer

    def draw(self, frames: int) -> None:
        """Lets time pass and draws, as a window does: only tallies are read back. The last frame is waited for."""
        for _ in range(frames):
            self.simulation.advance(1.0 / FRAME_RATE)
            self.renderer.draw_aside(frame_now(self.simulation))
        _ = self.renderer.told_now


def forest_walk(
    scene: Scene, kinds: list[GrownKind], size: tuple[int, int], rules: DetailRules
) -> ForestWalk:
    """Puts a forest on the card, in motion."""
    simulation = GpuSimulation(scene, kinds, picture_height=size[1], aspect=size[0] / size[1])
    renderer = stage(simulation, size, rules)
    # A picture, unlike a window, waits until there is as much room for everybody as this card gives.
    renderer.draw(frame_now(simulation.advance(0.5)))
    return ForestWalk(simulation, renderer)


def forest_figures(walk: ForestWalk, frames: int, repeats: int) -> dict[str, float]:
    """What a frame comes to, over so many repeats of so many frames."""
    simulation, renderer = walk.simulation, walk.renderer
    placements = sum(kind.placements.count for kind in simulation.kinds)

    def stages() -> dict[str, float]:
        walk.draw(WIND_INTERVAL)
        return simulation.stage_milliseconds | renderer.stage_milliseconds

    by_stage = median_stages(stages, repeats)
    seconds = median_seconds(lambda: walk.draw(frames), repeats, warm_up=1) / frames
    told = renderer.told_now
    # Both count the winds in the crowns, which the simulation lends.
    memory = simulation.card.bytes + renderer.plant_bytes - simulation.card.resources["speeds"].size
    figures = {
        "bytes": memory,
        "bytes_per_placement": memory / placements,
        "drawn": told.placements,
        "refused": told.refused,
        "pieces": told.pieces,
        "leaves": told.leaves,
        "poses": told.wanted[0],
        "oscillators_active": simulation.stepped_count,
        "frame.ms": 1e3 * seconds,
        "frames_per_second": 1.0 / seconds,
        **{f"{stage}.ms": value for stage, value in by_stage.items()},
    }
    return {f"gpu.forest.{placements}.{name}": float(value) for name, value in figures.items()}
