"""Speed of `blades`: nanoseconds per blade and step, the field sampled per blade, and the machine's bandwidth."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from windswept.motion.blades.blades import CONSTANT_COUNT, STATE_COUNT, Blades, place_blades, rest_blades
from windswept.motion.blades.field import PackedField, pack_field
from windswept.motion.blades.kind import BladeKind, build_kind
from windswept.motion.blades.pose_blades import pose_blades
from windswept.motion.blades.step_blades import step_in_field
from windswept.plants.underbrush import grow_tuft, load_underbrush
from windswept.plants.underbrush.grow_tuft import GROUND, tilted_frames
from windswept.studies.machine import median_seconds, triad_bandwidth

COUNTS = (10_000, 100_000, 1_000_000)
POSED = 10_000
"""Blades near enough to be posed on the processor."""
DENSITY = 100.0
"""Blades in a square metre."""
NODES = (128, 128, 16)
LAYER = 0.25
"""Height of a cell of the field, m."""
SUBSTEPS = 4
"""Steps to one state of the field, as in a simulation."""


def bench_blades(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``blades.<count>.*``, the table's size and the time to build it.

    ``ns_per_blade_step`` samples the field at every step. ``ns_per_substep`` is with the field held for SUBSTEPS steps.
    ``times_triad_time`` is the former over the time in which the machine's triad moves ``bytes_per_blade_step``.
    """
    blade = grow_tuft(load_underbrush("meadow_fescue")).kinds[0]
    kind = build_kind(blade)
    bandwidth = triad_bandwidth()
    figures = {
        "blades.table.bytes": float(kind.table.bytes),
        "blades.table.build_ms": 1e3 * median_seconds(partial(build_kind, blade), repeats=3, warm_up=0),
    }
    for count in COUNTS:
        say(f"blades, {count}")
        blades, field = meadow(kind, count)
        state, name = rest_blades(blades), f"blades.{count}"
        every = median_seconds(partial(step_in_field, blades, state, field)) / count
        held = median_seconds(partial(step_in_field, blades, state, field, SUBSTEPS))
        moved = bytes_per_blade_step()
        figures[f"{name}.ns_per_blade_step"] = 1e9 * every
        figures[f"{name}.ns_per_substep"] = 1e9 * held / (SUBSTEPS * count)
        figures[f"{name}.bytes_per_blade_step"] = moved
        figures[f"{name}.times_triad_time"] = every * bandwidth / moved
        if count == POSED:
            figures[f"{name}.pose_ms"] = 1e3 * median_seconds(partial(pose_blades, blades, state))
    return figures


def meadow(kind: BladeKind, count: int) -> tuple[Blades, PackedField]:
    """Blades on a square of ground, neighbours in memory where they are neighbours, and a turbulent field over it."""
    rng = np.random.default_rng(0)
    side = np.sqrt(count / DENSITY)
    base = np.zeros((count, 3))
    base[:, :2] = rng.uniform(0.0, side, (count, 2))
    square = np.floor(base[:, :2])
    base = base[np.lexsort((square[:, 0], square[:, 1]))]
    frame = tilted_frames(rng.uniform(0.0, 0.5, count), rng.uniform(0.0, 2.0 * np.pi, count)) @ GROUND
    velocity = rng.normal((3.0, 0.0, 0.0), 1.0, (*NODES, 3)).astype(np.float32)
    edge = side / (NODES[0] - 1)
    field = pack_field(velocity, np.zeros_like(velocity), (0.0, 0.0), (edge, edge, LAYER))
    return place_blades(kind, base, frame, rng.uniform(0.75, 1.25, count)), field


def bytes_per_blade_step() -> float:
    """Bytes that a blade asks the memory for in one step: constants and state read, state written, 4 bytes each."""
    return 4.0 * (CONSTANT_COUNT + 2 * STATE_COUNT)
