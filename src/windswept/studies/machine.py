"""The machine that a figure was measured on, and its own limits."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

import numpy as np
from numba import get_num_threads, njit, prange

from windswept.plants.plant import Floats

TRIAD_NUMBERS = 32_000_000
"""Per array: three arrays of 128 MB are far beyond any cache that one machine gives two cores."""
LEAST_SECONDS = 0.3
"""That are measured: in less, a shared core that is taken away once changes the median."""


def machine() -> dict[str, str | int]:
    """Processor, cores, threads and versions, as they go with every figure."""
    return {
        "machine.processor": _processor_name(),
        "machine.cores": os.cpu_count() or 1,
        "machine.threads": get_num_threads(),
        "machine.system": platform.system(),
        "versions.python": platform.python_version(),
        "versions.numpy": version("numpy"),
        "versions.numba": version("numba"),
        "versions.windswept": version("windswept"),
    }


def _processor_name() -> str:
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def median_seconds(run: Callable[[], object], repeats: int = 15, warm_up: int = 2) -> float:
    """Median wall time of one call, s; over so many calls, or more until LEAST_SECONDS have passed."""
    for _ in range(warm_up):
        run()
    seconds: list[float] = []
    while len(seconds) < repeats or sum(seconds) < LEAST_SECONDS:
        started = time.perf_counter()
        run()
        seconds.append(time.perf_counter() - started)
    return float(np.median(seconds))


def triad_bandwidth() -> float:
    """Memory bandwidth of all threads on a = b + s c, bytes/s, counting 12 bytes a number."""
    a, b, c = (np.full(TRIAD_NUMBERS, value, np.float32) for value in (0.0, 1.0, 2.0))
    seconds = median_seconds(lambda: _triad(a, b, c, np.float32(3.0)), repeats=7)
    return 12.0 * TRIAD_NUMBERS / seconds


@njit(parallel=True, fastmath=True, cache=True)
def _triad(a: Floats, b: Floats, c: Floats, s: float) -> None:
    for i in prange(len(a)):
        a[i] = b[i] + s * c[i]
