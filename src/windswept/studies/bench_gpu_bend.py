"""Speed of `bend` on the card: nanoseconds per branch and pass, in one pass over all branches and level by level."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from windswept.gpu.bend import Bending
from windswept.gpu.bend.layouts import BENT_BRANCH, BRANCH
from windswept.gpu.device import adapter_summary, is_software, shared_device
from windswept.motion.bend import Bender
from windswept.motion.bend_branches import Branches
from windswept.studies.bench_bend import PAPER, four_waves, rows_of_trees
from windswept.studies.bench_gpu_springs import median_stages
from windswept.studies.machine import median_seconds
from windswept.wind.wind import Wind

PASSES, SOFTWARE_PASSES = 100, 4
"""Taken at once, on a real card and where the CPU plays it: what it costs to ask the card is shared among them."""
REPEATS = 9


def bench_gpu_bend(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``gpu.bend.<branches>.*``, in four waves, as many as the paper's.

    A lagged pass (the paper's) is one dispatch over all branches, an ordered one is a dispatch a level. PASSES are
    submitted at once, each on the pose that the one before wrote: ``ns_per_branch`` and ``per_second`` (passes), the
    same after ``ordered_``. The card's own clock times them from the first to the last, without the wind's upload or
    any reading back; on software drivers it is SOFTWARE_PASSES by the clock on the wall, from call to answer.
    ``times_paper`` is lagged over the paper's, ``times_cpu`` our time on the CPU, all its threads, over the card's. A
    card whose cache holds all ``bytes`` reads little from its memory.
    """
    say(f"gpu bend, on {adapter_summary()}")
    figures: dict[str, float] = {}
    for count, paper in PAPER.items():
        say(f"gpu bend, {count} branches")
        figures |= _bent(rows_of_trees(count), paper)
    return figures


def _bent(branches: Branches, paper: float) -> dict[str, float]:
    """Both kinds of passes over the same branches."""
    card, bender, wind = Bending(shared_device(), branches), Bender(branches), four_waves()
    lagged, ordered = (_seconds(card, step, wind) for step in (card.step_lagged, card.step_ordered))
    on_cpu = median_seconds(partial(bender.step_lagged, bender.rest(), wind, 1.0), REPEATS)
    name = f"gpu.bend.{branches.branch_count}"
    return {
        f"{name}.ns_per_branch": 1e9 * lagged / branches.branch_count,
        f"{name}.ordered_ns_per_branch": 1e9 * ordered / branches.branch_count,
        f"{name}.per_second": 1.0 / lagged,
        f"{name}.ordered_per_second": 1.0 / ordered,
        f"{name}.bytes_per_branch": bytes_per_branch(branches),
        f"{name}.bytes": card.bytes,
        f"{name}.times_paper": 1.0 / lagged / paper,
        f"{name}.times_cpu": on_cpu / lagged,
    }


def _seconds(card: Bending, step: Callable[[Wind, float, int], None], wind: Wind) -> float:
    """Median time of one pass, s: by the card's clock where it has one, but not by that of Mesa's software driver,
    which after a picture may begin to count at a second dispatch only (``gpu/kernel.py``).
    """
    software = is_software(shared_device())
    passes = SOFTWARE_PASSES if software else PASSES

    def run() -> dict[str, float]:
        step(wind, 1.0, passes)
        card.wait()
        return card.times.read()

    wall = median_seconds(run, REPEATS)
    if software:
        return wall / passes
    return (1e-3 * median_stages(run, REPEATS).get("bend", 0.0) or wall) / passes


def bytes_per_branch(branches: Branches) -> float:
    """Bytes that a lagged pass asks the card's memory for, per branch.

    Its row is read and its pose written; a parent's pose is read once for all its children, which stand side by side.
    """
    parents = np.unique(branches.parent[branches.parent >= 0]).size / branches.branch_count
    return BRANCH.itemsize + BENT_BRANCH.itemsize * (1.0 + parents)
