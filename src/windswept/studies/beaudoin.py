"""Beaudoin's figure 6 remade: one large tree at fewer and fewer simulated branches, with our merges and the thesis'."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from windswept.levels import Eye, Hierarchy, build_ladder, cut_level, measure, simplify
from windswept.levels.printed import printed_level, printed_merges
from windswept.motion import Level, build_model, finest_level
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.level_costs import nanoseconds_per_step

PAPER = ((77_141, 2.0), (25_434, 6.0), (12_761, 10.0), (5_654, 21.0), (1_709, 62.0), (714, 81.0), (110, 85.0))
"""Branches and frames per second of the thesis' figure 6, on an Athlon 2700."""
SEARCH_STEPS = 30


def beaudoin(
    links: int = PAPER[0][0], seconds: float = 6.0, say: Callable[[str], None] = lambda line: None
) -> list[Any]:
    """Rows of figure 6 beside ours.

    Args:
        links: of the tree; the paper's counts are scaled with it.
        seconds: of wind in which the errors are measured.
        say: told what is done.

    Returns:
        One dictionary a row: the paper's branches and frames per second; our links, steps per second, speed-up, and
        the errors of both kinds of merge; pixels are those of 1080 lines and 60 degrees from 10 crown heights away.
    """
    say(f"growing a tree of {links:,} links")
    hierarchy = simplify(build_model(plant_with_links(links)))
    merges = printed_merges(hierarchy)
    wanted = [round(count * links / PAPER[0][0]) for count, _ in PAPER]
    tolerances = [0.0, *(tolerance_for(hierarchy, count) for count in wanted[1:])]
    finest = finest_level(hierarchy.model)
    ours = [finest, *(cut_level(hierarchy, tolerance) for tolerance in tolerances[1:])]
    theirs = [finest, *(printed_level(hierarchy, merges, tolerance) for tolerance in tolerances[1:])]
    ladder = build_ladder(hierarchy)
    say("measuring both kinds of merge against every link")
    measured = [
        measure(replace(ladder, levels=tuple(levels), error=np.zeros(len(levels))), seconds)
        for levels in (ours, theirs)
    ]
    full = nanoseconds_per_step(finest)
    pixel = pixel_at_crown_distance(hierarchy)
    rows = []
    for rung, ((branches, fps), level) in enumerate(zip(PAPER, ours, strict=True)):
        nanoseconds = nanoseconds_per_step(level)
        rows.append(
            {
                "paper_branches": branches,
                "paper_fps": fps,
                "paper_speedup": round(fps / PAPER[0][1], 2),
                "branches": oscillator_count(level),
                "steps_per_second": round(1e9 / nanoseconds, 1),
                "speedup": round(full / nanoseconds, 2),
                "p95_m": round(float(measured[0].p95[rung]), 4),
                "max_m": round(float(measured[0].largest[rung]), 4),
                "p95_pixels": round(float(measured[0].p95[rung]) / pixel, 2),
                "rms_over_motion": round(float(measured[0].rms[rung] / measured[0].motion), 4),
                "printed_p95_m": round(float(measured[1].p95[rung]), 4),
                "printed_max_m": round(float(measured[1].largest[rung]), 4),
                "printed_rms_over_motion": round(float(measured[1].rms[rung] / measured[1].motion), 4),
            }
        )
    return rows


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


def pixel_at_crown_distance(hierarchy: Hierarchy) -> float:
    """Size of a pixel of 1080 lines and 60 degrees at ten times the plant's height, m."""
    skeleton = hierarchy.model.skeleton
    height = float((skeleton.base + skeleton.vector)[:, 2].max())
    return float(Eye(np.zeros(3, np.float32), np.radians(60.0)).metres(np.array([10.0 * height]))[0])
