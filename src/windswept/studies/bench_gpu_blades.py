"""Speed of `blades` on the card: nanoseconds per blade and step, the field sampled per blade."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from windswept.gpu.blades import Leaning
from windswept.gpu.device import adapter_summary, is_software, shared_device
from windswept.motion.blades.blades import rest_blades
from windswept.motion.blades.kind import BladeKind, build_kind
from windswept.motion.blades.step_blades import step_in_field
from windswept.plants.underbrush import grow_tuft, load_underbrush
from windswept.studies.bench_blades import SUBSTEPS, bytes_per_blade_step, meadow
from windswept.studies.machine import median_seconds

COUNTS = (10_000, 100_000, 1_000_000)
"""On any card."""
LARGE_COUNTS = (4_000_000,)
"""On a real card as well."""
REPEATS = 9


def bench_gpu_blades(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``gpu.blades.<count>.*``.

    ``ns_per_blade_step`` samples the field at every step, ``ns_per_substep`` holds it for SUBSTEPS steps; both by the
    card's own clock, if it has one. ``times_cpu`` is our time on the CPU, all its threads, over the former.
    ``upload_ms`` is what it takes to hand the card a field of 128 x 128 x 16 nodes.
    """
    say(f"gpu blades, on {adapter_summary()}")
    kind = build_kind(grow_tuft(load_underbrush("meadow_fescue")).kinds[0])
    figures: dict[str, float] = {}
    for count in COUNTS if is_software(shared_device()) else COUNTS + LARGE_COUNTS:
        say(f"gpu blades, {count}")
        figures |= _blades(kind, count)
    return figures


def _blades(kind: BladeKind, count: int) -> dict[str, float]:
    blades, field = meadow(kind, count)
    card, state, name = Leaning(shared_device(), [blades]), rest_blades(blades), f"gpu.blades.{count}"

    def upload() -> None:
        card.write_air(field)
        card.wait()

    uploaded = median_seconds(upload, REPEATS)
    every, held = _seconds(card, 1), _seconds(card, SUBSTEPS)
    on_cpu = median_seconds(partial(step_in_field, blades, state, field), REPEATS)
    return {
        f"{name}.ns_per_blade_step": 1e9 * every / count,
        f"{name}.ns_per_substep": 1e9 * held / (SUBSTEPS * count),
        f"{name}.bytes_per_blade_step": bytes_per_blade_step(),
        f"{name}.bytes": card.bytes,
        f"{name}.upload_ms": 1e3 * uploaded,
        f"{name}.times_cpu": on_cpu / every,
    }


def _seconds(card: Leaning, steps: int) -> float:
    """Median time of one call of so many steps, s, by the card's clock where it has one."""

    def step() -> float:
        card.step(steps)
        card.wait()
        return card.times.read().get("lean", 0.0)

    wall = median_seconds(step, REPEATS)
    by_clock = 1e-3 * float(np.median([step() for _ in range(REPEATS)]))
    return by_clock or wall
