"""Speed of `springs`: nanoseconds per link and step, against MuJoCo on the same tree and the machine's bandwidth."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

import numpy as np

from windswept.motion import Model, Stepper, build_model, finest_level, rest_state
from windswept.motion.lanes import WIDTH
from windswept.motion.model import CONSTANT_COUNT
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.machine import median_seconds, triad_bandwidth

SIZES = ((1_000, 128), (5_000, 128), (77_000, 1))
"""Links and placements."""
SUBSTEPS = 4
"""Inner steps to one sample of the wind, as in a simulation."""
MUJOCO_LIMIT = 10_000
"""MuJoCo is not asked for trees with more links: its model alone would take minutes to build."""


def bench_springs(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``springs.<links>x<placements>.*``.

    ``times_mujoco`` is MuJoCo's time (Euler integrator, contacts off, the same rods) over ours per link and step; it
    is left out where MuJoCo is not installed.
    ``times_triad_time`` is our time over the time in which the machine's triad moves ``bytes_per_link_step``.
    """
    bandwidth, against_mujoco = triad_bandwidth(), mujoco_is_there(say)
    figures = {"triad.gb_per_s": bandwidth / 1e9}
    for links, placements in SIZES:
        say(f"springs, {links} links x {placements}")
        model = build_model(plant_with_links(links))
        name = f"springs.{links}x{placements}"
        seconds = seconds_per_step(model, placements) / (links * placements)
        moved = bytes_per_link_step(placements)
        figures[f"{name}.ns_per_link_step"] = seconds * 1e9
        figures[f"{name}.bytes_per_link_step"] = moved
        figures[f"{name}.times_triad_time"] = seconds * bandwidth / moved
        if against_mujoco and links <= MUJOCO_LIMIT:
            figures |= mujoco_figures(name, model, seconds)
    return figures


def seconds_per_step(model: Model, placements: int) -> float:
    """Median wall time of one inner step of all placements in turbulent wind, s."""
    level = finest_level(model)
    stepper, state = Stepper(level), rest_state(level, placements)
    rng = np.random.default_rng(0)
    shape = (placements, len(model.probe_position), 3)
    wind = rng.normal((6.0, 0.0, 0.0), 2.0, shape).astype(np.float32)
    return median_seconds(lambda: stepper.step(state, wind, wind, SUBSTEPS)) / SUBSTEPS


def bytes_per_link_step(placements: int) -> float:
    """Bytes that one link of one placement asks the memory for in one step, once the plant spills the cache.

    Joints (4 numbers, read by both walks, written by one), the link's record (13, written and read), and its
    constants and indices, read by both walks and shared by the placements of a tile. Idle lanes are not counted.
    """
    per_lane = 4 * (4 * 3 + 13 * 2)
    shared = 2 * (4 * CONSTANT_COUNT + 12)
    return per_lane + shared / min(placements, WIDTH)


def mujoco_is_there(say: Callable[[str], None]) -> bool:
    """Whether MuJoCo can be compared with; says what to install where it cannot."""
    if find_spec("mujoco") is not None:
        return True
    say("without times_mujoco, as MuJoCo is not installed: pip install mujoco")
    return False


def mujoco_figures(name: str, model: Model, seconds: float) -> dict[str, float]:
    """MuJoCo's time on a tree beside our time per link and step, s."""
    theirs = mujoco_seconds_per_step(model) / model.link_count
    return {f"{name}.mujoco_ns_per_link_step": theirs * 1e9, f"{name}.times_mujoco": theirs / seconds}


def mujoco_seconds_per_step(model: Model) -> float:
    """Median wall time of MuJoCo's step of one such tree, s."""
    import mujoco

    from windswept.studies.mujoco_tree import mujoco_tree

    tree = mujoco_tree(model)
    data = mujoco.MjData(tree)
    return median_seconds(lambda: mujoco.mj_step(tree, data), repeats=30, warm_up=5)
