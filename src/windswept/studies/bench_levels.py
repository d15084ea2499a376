"""What simulation levels cost and bring: speed-up over level 0, time to build, memory."""

from __future__ import annotations

import time
from collections.abc import Callable

from windswept.levels import Ladder, bound_errors, build_ladder, measure, simplify
from windswept.levels.training_wind import training_air
from windswept.motion import build_model
from windswept.plants.weber_penn import grow
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.level_costs import levels_bytes, nanoseconds_per_step, plant_bytes
from windswept.studies.merges import links_needed

SPECIES = (
    "quaking_aspen",
    "black_tupelo",
    "weeping_willow",
    "california_black_oak",
    "scots_pine",
    "hazel",
)
LARGE = 77_141
"""Branches of the tree in Beaudoin's figure 6."""
MEASURE_SECONDS = 10.0


def bench_levels(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``levels.<species>.*`` and ``levels.<species>.<level>.*``; the large tree's errors are not measured."""
    figures: dict[str, float] = {}
    for species in (*SPECIES, f"tupelo_{LARGE}"):
        say(f"levels, {species}")
        large = species not in SPECIES
        plant = plant_with_links(LARGE) if large else grow(species, 1)
        model = build_model(plant)
        build_ladder(simplify(model))
        started = time.perf_counter()
        ladder = build_ladder(simplify(model))
        name = f"levels.{species}"
        figures[f"{name}.links"] = plant.link_count
        figures[f"{name}.build_seconds"] = time.perf_counter() - started
        figures[f"{name}.bytes_ratio"] = levels_bytes(ladder) / plant_bytes(plant, ladder.levels[0])
        full = nanoseconds_per_step(model, ladder.levels[0])
        for rung, level in enumerate(ladder.levels):
            at = f"{name}.{rung}"
            figures[f"{at}.links"] = level.link_count + level.group_count
            figures[f"{at}.speedup"] = full / nanoseconds_per_step(model, level)
        if not large:
            figures |= _accuracy(ladder, name)
    return figures


def _accuracy(ladder: Ladder, name: str) -> dict[str, float]:
    """Errors of every level in a wind other than the one that they are stated from, and links for one pixel."""
    measured, bound = measure(ladder, MEASURE_SECONDS, training_air(seed=1)), bound_errors(ladder)
    figures = {}
    for rung in range(1, len(ladder.levels)):
        at = f"{name}.{rung}"
        figures[f"{at}.p95_m"] = float(measured.p95[rung])
        figures[f"{at}.rms_over_motion"] = float(measured.rms[rung] / measured.motion)
        figures[f"{at}.bound_over_max"] = float(bound[rung] / measured.largest[rung])
    needed = links_needed(ladder)
    return figures | {
        f"{name}.links_for_a_pixel": needed.ours,
        f"{name}.links_for_a_pixel_printed": needed.printed,
    }
