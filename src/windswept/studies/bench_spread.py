"""Speed of plants' spreading over a terrain, for the paper's limit of 3 s."""

from __future__ import annotations

from collections.abc import Callable

from windswept.scene.build_ground import build_terrain
from windswept.scene.build_spread import build_spread
from windswept.scene.plant_sources import Nursery
from windswept.studies.machine import median_seconds
from windswept.studies.spread_scene import MEADOW, spread_scene

COUNTS = (1_000, 10_000, 100_000)


def bench_spread(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``spread.<count>.{seconds, plants_per_second, plants}``."""
    figures: dict[str, float] = {}
    for count in COUNTS:
        say(f"spread, {count:,} plants")
        form = spread_scene(count)
        terrain = build_terrain(str(MEADOW), form.ground, form.seed)
        plants = [0]

        def run(form=form, terrain=terrain, plants=plants) -> None:  # type: ignore[no-untyped-def]
            nursery = Nursery()
            colonies = build_spread(str(MEADOW), form, terrain, nursery)
            plants[0] = sum(colony.count for colony in colonies) + sum(map(len, nursery.places.values()))

        seconds = median_seconds(run, repeats=3, warm_up=1)
        figures[f"spread.{count}.seconds"] = seconds
        figures[f"spread.{count}.plants_per_second"] = plants[0] / seconds
        figures[f"spread.{count}.plants"] = plants[0]
    return figures
