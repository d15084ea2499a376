"""Our merges beside the thesis' on the same plants: how many links each needs for the same error."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from windswept.levels import Eye, Ladder, measure
from windswept.levels.printed import printed_level, printed_merges
from windswept.motion.rods import Doubles

CROWN_HEIGHTS = 10.0
"""Distance from which plants are looked at, in their own heights."""


@dataclass(frozen=True, slots=True)
class LinksNeeded:
    """Oscillators with which 95 % of tips are within one pixel of level 0, seen from CROWN_HEIGHTS away."""

    ours: float
    printed: float


def links_needed(ladder: Ladder, seconds: float = 10.0) -> LinksNeeded:
    """Measures both kinds of merge at the same cuts, in the same wind.

    Args:
        ladder: of one plant.
        seconds: of wind.
    """
    printed = printed_ladder(ladder)
    pixel = pixel_at_crown_distance(ladder)
    counts = np.array(ladder.oscillators[: len(printed.levels)], np.float64)
    ours = measure(replace(printed, levels=ladder.levels[: len(printed.levels)]), seconds)
    return LinksNeeded(*(_needed(counts, one.p95, pixel) for one in (ours, measure(printed, seconds))))


def printed_ladder(ladder: Ladder) -> Ladder:
    """The levels of a ladder that keep inertia, moved by the thesis' merges; errors are left unmeasured."""
    merges = printed_merges(ladder.hierarchy)
    cuts = ladder.tolerance[1:-2]
    levels = (ladder.levels[0], *(printed_level(ladder.hierarchy, merges, float(cut)) for cut in cuts))
    return replace(ladder, levels=levels, error=np.zeros(len(levels)), tolerance=ladder.tolerance[:-2])


def pixel_at_crown_distance(ladder: Ladder) -> float:
    """Size of a pixel of 1080 lines and 60 degrees at CROWN_HEIGHTS heights from the plant, m."""
    skeleton = ladder.hierarchy.model.skeleton
    height = float((skeleton.base + skeleton.vector)[:, 2].max())
    eye = Eye(np.zeros(3, np.float32), np.radians(60.0))
    return float(eye.metres(np.array([CROWN_HEIGHTS * height]))[0])


def _needed(counts: Doubles, error: Doubles, allowed: float) -> float:
    """Oscillators at which the error comes to what is allowed, between levels by logarithms."""
    worst = np.maximum.accumulate(error)
    first = int(np.searchsorted(worst, allowed, side="right"))
    if first == len(worst):
        return float(counts[-1])
    low = max(worst[first - 1], 1e-3 * allowed)
    share = np.log(allowed / low) / np.log(worst[first] / low)
    return float(np.exp((1.0 - share) * np.log(counts[first - 1]) + share * np.log(counts[first])))
