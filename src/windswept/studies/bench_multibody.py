"""Speed of `multibody`: nanoseconds per link and step, against MuJoCo on the same rods and against `springs`."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from windswept.motion import Model, Stepper, build_model, finest_level, rest_state
from windswept.motion.multibody import MultibodyStepper, coupled_rest
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.bench_springs import SUBSTEPS, mujoco_figures, mujoco_is_there
from windswept.studies.machine import median_seconds

SIZES = ((200, 128), (1_000, 128), (5_000, 128))
"""Links and placements."""


def bench_multibody(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``multibody.<links>x<placements>.*``.

    ``times_mujoco`` is MuJoCo's time (Euler integrator, contacts off, the same rods) over ours per link and step
    (left out where MuJoCo is not installed), ``times_springs_time`` our time over that of `springs`
    on the same tree in the same wind.
    """
    against_mujoco, figures = mujoco_is_there(say), {}
    for links, placements in SIZES:
        say(f"multibody, {links} links x {placements}")
        model = build_model(plant_with_links(links))
        name = f"multibody.{links}x{placements}"
        ours, springs = (seconds / (links * placements) for seconds in seconds_per_step(model, placements))
        figures[f"{name}.ns_per_link_step"] = ours * 1e9
        figures[f"{name}.times_springs_time"] = ours / springs
        if against_mujoco:
            figures |= mujoco_figures(name, model, ours)
    return figures


def seconds_per_step(model: Model, placements: int) -> tuple[float, float]:
    """Median wall time of one inner step of all placements in wind, by `multibody` and by `springs`, s."""
    rng, level = np.random.default_rng(0), finest_level(model)
    shape = (placements, len(model.probe_position), 3)
    wind = rng.normal((6.0, 0.0, 0.0), 2.0, shape).astype(np.float32)
    coupled, plain = coupled_rest(model, placements), rest_state(level, placements)
    multibody, springs = MultibodyStepper(model), Stepper(level)
    return (
        median_seconds(lambda: multibody.step(coupled, wind, wind, SUBSTEPS)) / SUBSTEPS,
        median_seconds(lambda: springs.step(plain, wind, wind, SUBSTEPS)) / SUBSTEPS,
    )
