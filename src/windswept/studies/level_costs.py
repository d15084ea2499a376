"""Time and memory of simulation levels."""

from __future__ import annotations

import numpy as np

from windswept.levels import Ladder
from windswept.levels.training_wind import training_wind, wind_on
from windswept.motion import Level, Stepper, rest_state
from windswept.motion.lanes import WIDTH
from windswept.plants.plant import Plant
from windswept.studies.machine import median_seconds


def nanoseconds_per_step(level: Level, steps: int = 8) -> float:
    """Wall time of one inner step of one placement, in a full register of placements, ns."""
    stepper, state = Stepper(level), rest_state(level, WIDTH)
    wind = wind_on(level, training_wind(), 5.0)
    return 1e9 * median_seconds(lambda: stepper.step(state, wind, wind, steps), repeats=7) / (steps * WIDTH)


def plant_bytes(plant: Plant) -> int:
    """Memory of a plant's arrays."""
    arrays = (getattr(plant, name) for name in plant.__dataclass_fields__)
    return sum(array.nbytes for array in arrays if isinstance(array, np.ndarray))


def levels_bytes(ladder: Ladder) -> int:
    """Memory that the levels beyond level 0 add: their own arrays and the static shapes that all share."""
    shared = ladder.hierarchy.shapes
    arrays = (getattr(level, name) for level in ladder.levels[1:] for name in level.__dataclass_fields__)
    return shared.nbytes + sum(a.nbytes for a in arrays if isinstance(a, np.ndarray) and a is not shared)
