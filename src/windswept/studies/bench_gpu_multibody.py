"""Speed of `multibody` on the card: nanoseconds per link and step, against the CPU and against `springs` there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from windswept.gpu.device import adapter_summary, is_software, shared_device
from windswept.gpu.layouts import CARRIED_ROWS, RECORD_ROWS
from windswept.gpu.multibody.simulation import CoupledSimulation
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.studies.bench_gpu_springs import card_seconds_per_step, grove
from windswept.studies.bench_multibody import seconds_per_step

SIZES = ((200, 128), (1_000, 128))
"""Links and placements, on any card."""
LARGE_SIZES = ((1_000, 8_192), (5_000, 4_096))
"""On a real card as well."""
ROW = 16
"""Bytes of a ``vec4f``."""


def bench_gpu_multibody(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``gpu.multibody.<links>x<placements>.*``; steps by the card's own clock, if it has one.

    ``times_cpu`` is our time on the CPU, all its threads, over that on the card; ``times_springs_time`` our time over
    that of `springs` on the same card, both in the same run.
    """
    say(f"gpu, on {adapter_summary()}")
    figures: dict[str, float] = {}
    sizes = SIZES if is_software(shared_device()) else SIZES + LARGE_SIZES
    for links, placements in sizes:
        say(f"gpu multibody, {links} links x {placements}")
        figures |= _multibody(links, placements)
    return figures


def _multibody(links: int, placements: int) -> dict[str, float]:
    """One plant at its finest level, many times."""
    scene, kind = grove(links, placements)
    card = CoupledSimulation(scene, [replace(kind, multibody=True)])
    count = links * placements
    seconds = card_seconds_per_step(card) / count
    springs = card_seconds_per_step(GpuSimulation(scene, [kind])) / count
    on_cpu = seconds_per_step(kind.model, placements)[0] / count
    name = f"gpu.multibody.{links}x{placements}"
    return {
        f"{name}.ns_per_link_step": 1e9 * seconds,
        f"{name}.bytes_per_link_step": bytes_per_link_step(),
        f"{name}.bytes_per_link": sum(card.bytes.values()) / count,
        f"{name}.times_springs_time": seconds / springs,
        f"{name}.times_cpu": on_cpu / seconds,
    }


def bytes_per_link_step() -> float:
    """Bytes that one link of one placement asks the card's memory for in one step, along a stem, if nothing stays in a
    cache.

    Its joint is read by all three walks and written by one, what it carries is read and written by two; its record is
    written and read, and again with the joint's answer; the wind at both ends of the interval is read.
    """
    return ROW * (4 + 4 * CARRIED_ROWS + 4 * RECORD_ROWS + 2)
