"""Speed of the field: one step of a busy piece of ground, against the machine's bandwidth."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from windswept.studies.machine import median_seconds, triad_bandwidth
from windswept.wind.field import (
    Ball,
    Box,
    Cylinder,
    Field,
    FieldPlan,
    Grid,
    Helicopter,
    Path,
    Rain,
    Spheroid,
    Walker,
    sample,
    start_field,
    step_field,
)
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.waves import WaveSchedule, WaveSet
from windswept.wind.wind import Wind

SHAPE = (128, 128, 16)
STEP = 1.0 / 30.0
"""s, as the simulation samples its wind."""
POINTS = 100_000
"""Probes that read the field."""
BYTES_PER_NODE = 4 * (4 + 4 + 4 * 3 + 3)
"""The departure read and written by the transport, then once more each by the sum; the air written, read and written;
the pushes written."""


def bench_field(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``field.<nx>x<ny>x<nz>.*``.

    ``ms`` is a step in turbulence and a gust, past three obstacles, with a ball and a walker; ``rain_ms`` and
    ``downwash_ms`` what rain and a helicopter add to it; ``times_triad_time`` is ``ms`` over the time in which the
    machine's triad moves ``bytes``; ``start_seconds`` goes into solving the deflection. ``divergence`` is what is left
    round a post in steady wind, as root mean square over the nodes within four radii, over wind speed per cell.
    """
    name = "field." + "x".join(map(str, SHAPE))
    say(name)
    walk = Path(np.array([0.0, 600.0]), np.array([[-30.0, -5.0], [30.0, 5.0]]))
    busy = busy_field(Ball(walk, 0.5), Walker(walk))
    seconds = seconds_per_step(busy)
    moved = BYTES_PER_NODE * np.prod(SHAPE)
    points = np.random.default_rng(0).uniform(-60.0, 60.0, (POINTS, 3)).astype(np.float32)
    height = (np.abs(points[:, 2]) / 6.0).astype(np.float32)
    return {
        f"{name}.ms": 1e3 * seconds,
        f"{name}.bytes": float(moved),
        f"{name}.times_triad_time": seconds * triad_bandwidth() / moved,
        f"{name}.rain_ms": 1e3 * (seconds_per_step(busy_field(Rain(10.0))) - seconds_per_step(busy_field())),
        f"{name}.downwash_ms": 1e3
        * (seconds_per_step(busy_field(Helicopter(walk))) - seconds_per_step(busy_field())),
        f"{name}.sample_ns_per_point": 1e9 * median_seconds(lambda: sample(busy, points, height)) / POINTS,
        f"{name}.divergence_without_wake": remaining_divergence(wakes=False),
        f"{name}.divergence_with_wake": remaining_divergence(wakes=True),
        f"{name}.start_seconds": median_seconds(busy_field, repeats=3, warm_up=0),
    }


def busy_field(*agents: Ball | Walker | Rain | Helicopter) -> Field:
    """Turbulent wind and a gust over 127 m of ground with a post, a house and a crown."""
    waves = WaveSchedule((WaveSet(plausible_waves(6.0, 0.25, 1, 0.3)),))
    wind = Wind(mean=MeanWind(6.0, 0.3), waves=waves, gusts=(Gust(0.0, 6.0, hold_length=400.0),))
    obstacles = (
        Cylinder((0.0, 0.0), 2.0, 12.0),
        Box((-20.0, -10.0), (8.0, 12.0), 5.0, 0.3),
        Spheroid((20.0, 10.0, 6.0), 5.0, 4.0, 0.4),
    )
    plan = FieldPlan(Grid((-63.5, -63.5), (1.0, 1.0, 1.0), SHAPE), obstacles=obstacles, agents=agents)
    return start_field(plan, wind)


def seconds_per_step(field: Field) -> float:
    """Median wall time of one step, once wakes have grown, s."""
    return median_seconds(lambda: step_field(field, STEP), repeats=60, warm_up=60)


def remaining_divergence(wakes: bool) -> float:
    """Root mean square divergence round a post of 4 cells' radius, 1 is the wind's speed lost within one cell."""
    post, speed = Cylinder((0.0, 0.0), 4.0, 12.0), 6.0
    grid = Grid((-32.0, -32.0), (1.0, 1.0, 1.0), (65, 65, 16))
    field = start_field(FieldPlan(grid, obstacles=(post,)), Wind(mean=MeanWind(speed)))
    step_field(field, 15.0 if wakes else 1e-3)
    air = field.velocity.astype(np.float64)
    divergence = sum(np.gradient(air[..., axis], axis=axis) for axis in range(3))
    x, y, z = np.moveaxis(grid.nodes(), -1, 0)
    near = (np.hypot(x, y) < 16.0) & (np.hypot(x, y) > 5.0) & (z > 0.0) & (z < 15.0)
    return float(np.sqrt(np.mean(np.asarray(divergence)[near] ** 2)) / speed)
