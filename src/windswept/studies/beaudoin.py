"""Beaudoin's figure 6 remade: one large tree at fewer and fewer simulated branches, with our merges and the thesis'."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from windswept.levels import Hierarchy, bound_errors, build_ladder, cut_level, measure, simplify
from windswept.levels.measure import Measured
from windswept.levels.printed import printed_level, printed_merges
from windswept.motion import Level, build_model, finest_level
from windswept.studies.beaudoin_pictures import draw_beaudoin
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.level_costs import nanoseconds_per_step
from windswept.studies.merges import pixel_at_crown_distance

PAPER = ((77_141, 2.0), (25_434, 6.0), (12_761, 10.0), (5_654, 21.0), (1_709, 62.0), (714, 81.0), (110, 85.0))
"""Branches and frames per second of the thesis' figure 6, on an Athlon 2700."""
SEARCH_STEPS = 30


def beaudoin(
    links: int = PAPER[0][0],
    seconds: float = 6.0,
    folder: Path | None = None,
    say: Callable[[str], None] = lambda line: None,
) -> list[Any]:
    """Rows of figure 6 beside ours, and pictures like figures 1, 6 and 7.

    Args:
        links: of the tree; the paper's counts are scaled with it.
        seconds: of wind in which the errors are measured.
        folder: for the pictures; None for none.
        say: told what is done.

    Returns:
        One dictionary a row: the paper's branches and frames per second; our links, steps per second, speed-up, and
        the errors of both kinds of merge; pixels are those of 1080 lines and 60 degrees from 10 crown heights away.
    """
    say(f"growing a tree of {links:,} links")
    plant = plant_with_links(links)
    hierarchy = simplify(build_model(plant))
    merges = printed_merges(hierarchy)
    wanted = [round(count * links / PAPER[0][0]) for count, _ in PAPER]
    tolerances = [0.0, *(tolerance_for(hierarchy, count) for count in wanted[1:])]
    finest = finest_level(hierarchy.model)
    ours = [finest, *(cut_level(hierarchy, tolerance) for tolerance in tolerances[1:])]
    theirs = [finest, *(printed_level(hierarchy, merges, tolerance) for tolerance in tolerances[1:])]
    ladder = build_ladder(hierarchy)
    say("measuring both kinds of merge against every link")
    one, other = (
        replace(ladder, levels=tuple(levels), error=np.zeros(len(levels))) for levels in (ours, theirs)
    )
    measured, printed = measure(one, seconds), measure(other, seconds)
    say("trying our levels in the hardest winds")
    bound = bound_errors(one)
    if folder is not None:
        draw_beaudoin(plant, hierarchy.model, ours, folder, say)
    nanoseconds = [nanoseconds_per_step(hierarchy.model, level) for level in ours]
    pixel = pixel_at_crown_distance(ladder)
    rows = []
    for rung, ((branches, fps), level) in enumerate(zip(PAPER, ours, strict=True)):
        row: dict[str, float] = {
            "paper_branches": branches,
            "paper_fps": fps,
            "paper_speedup": round(fps / PAPER[0][1], 2),
            "branches": oscillator_count(level),
            "steps_per_second": round(1e9 / nanoseconds[rung], 1),
            "speedup": round(nanoseconds[0] / nanoseconds[rung], 2),
            "bound_m": round(float(bound[rung]), 4),
        }
        rows.append(row | _errors(measured, rung, pixel) | _errors(printed, rung, pixel, "printed_"))
    return rows


def _errors(measured: Measured, rung: int, pixel: float, prefix: str = "") -> dict[str, float]:
    """Measured errors of one level."""
    return {
        f"{prefix}p95_m": round(float(measured.p95[rung]), 4),
        f"{prefix}max_m": round(float(measured.largest[rung]), 4),
        f"{prefix}p95_pixels": round(float(measured.p95[rung]) / pixel, 2),
        f"{prefix}rms_over_motion": round(float(measured.rms[rung] / measured.motion), 4),
    }


def oscillator_count(level: Level) -> int:
    """Links and groups that a level steps."""
    return level.link_count + level.group_count


def tolerance_for(hierarchy: Hierarchy, count: int) -> float:
    """Tolerance whose level has about so many oscillators, found by halving in the logarithm."""
    error = hierarchy.error
    low, high = np.log(error[error > 0].min()), np.log(error[hierarchy.root] * 1.01)
    for _ in range(SEARCH_STEPS):
        middle = 0.5 * (low + high)
        if oscillator_count(cut_level(hierarchy, float(np.exp(middle)))) > count:
            low = middle
        else:
            high = middle
    return float(np.exp(high))
