"""Speed of `bend`: passes a second over all branches on the CPU, beside the paper's and the machine's bandwidth."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numba import get_num_threads, set_num_threads

from windswept.motion.bend import CONSTANT_COUNT, POSE_COUNT, Bender
from windswept.motion.bend_branches import Branches, place_branches
from windswept.motion.bend_plant import plant_branches
from windswept.plants.plant import Plant
from windswept.plants.species import load_species
from windswept.plants.weber_penn import grow
from windswept.studies.bench_plants import cut_to_links
from windswept.studies.machine import median_seconds, triad_bandwidth
from windswept.wind.mean import MeanWind
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.waves import WaveSchedule, WaveSet
from windswept.wind.wind import Wind

PAPER = {65_536: 600.0, 262_144: 180.0}
"""Iterations a second of Skjermo's section 5 on a GeForce 7900 GTX, by branches."""
STEMS = 1024
"""Branches of one tree; 64 and 256 of them make the paper's two textures."""
SPACING = 6.0
"""Between trees, m."""


def bench_bend(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``bend.<branches>.*``, in four waves, as many as the paper's.

    ``per_second`` counts lagged passes (the paper's), ``ordered_per_second`` passes level by level, ``times_paper``
    is lagged over the paper's. ``one_thread_per_second`` is what a single core does, whoever else is busy.
    ``times_triad_time`` is the lagged pass over the time in which the machine's triad moves ``bytes_per_branch``.
    """
    bandwidth, wind = triad_bandwidth(), four_waves()
    figures = {"triad.gb_per_s": bandwidth / 1e9}
    for count, paper in PAPER.items():
        say(f"bend, {count} branches")
        bender = Bender(rows_of_trees(count))
        state, name = bender.rest(), f"bend.{count}"
        lagged, ordered = (
            partial(step, state, wind, 1.0) for step in (bender.step_lagged, bender.step_ordered)
        )
        seconds = median_seconds(lagged, repeats=40)
        moved = bytes_per_branch(bender.branches)
        figures[f"{name}.per_second"] = 1.0 / seconds
        figures[f"{name}.ordered_per_second"] = 1.0 / median_seconds(ordered, repeats=40)
        figures[f"{name}.one_thread_per_second"] = 1.0 / on_one_thread(lagged)
        figures[f"{name}.times_paper"] = 1.0 / seconds / paper
        figures[f"{name}.ns_per_branch"] = 1e9 * seconds / count
        figures[f"{name}.bytes_per_branch"] = moved
        figures[f"{name}.times_triad_time"] = seconds * bandwidth / (count * moved)
    return figures


def on_one_thread(run: Callable[[], object]) -> float:
    """Median wall time of one call with a single thread, s."""
    threads = get_num_threads()
    set_num_threads(1)
    try:
        return median_seconds(run, repeats=40)
    finally:
        set_num_threads(threads)


def bytes_per_branch(branches: Branches) -> float:
    """Bytes that a lagged pass asks the memory for, per branch.

    Constants, the parent's place, tip and flexibility are read, the pose is written; a parent's pose is read once
    for all its children, which stand side by side.
    """
    parents = len(np.unique(branches.parent)) / branches.branch_count
    return 4.0 * (CONSTANT_COUNT + 1 + 3) + 4.0 * POSE_COUNT * (1.0 + parents)


def four_waves() -> Wind:
    """A mean wind with four waves on it."""
    waves = plausible_waves(6.0, 0.3, seed=3, along_count=3, cross_count=1)
    return Wind(mean=MeanWind(6.0), waves=WaveSchedule((WaveSet(waves),)))


def rows_of_trees(count: int) -> Branches:
    """Exactly ``count`` branches, a multiple of STEMS, of equal trees on a square grid."""
    trees = count // STEMS
    across = int(np.ceil(np.sqrt(trees)))
    number = np.arange(trees)
    position = SPACING * np.stack([number % across, number // across, 0 * number], axis=1)
    yaw = 2.0 * np.pi * (number * 0.6180339887 % 1.0)
    kind = plant_branches(tree_of_stems())
    return place_branches([kind], np.zeros(trees, np.int32), position.astype(np.float32), yaw)


def tree_of_stems() -> Plant:
    """A quaking aspen's first STEMS stems in depth-first order."""
    tree = grow(load_species("quaking_aspen"), 0)
    return cut_to_links(tree, int(tree.stem_link_start[STEMS]))
