"""Time and memory of simulation levels."""

from __future__ import annotations

import numpy as np

from windswept.levels import Hierarchy, Ladder
from windswept.levels.influence import Influence
from windswept.levels.training_wind import training_wind, wind_on
from windswept.motion import Level, Model, build_stepper, rest_state
from windswept.motion.lanes import WIDTH
from windswept.motion.modal import Modes
from windswept.plants.plant import Plant
from windswept.studies.machine import median_seconds


def nanoseconds_per_step(model: Model, level: Level, steps: int = 8) -> float:
    """Wall time of one inner step of one placement, in a full register of placements, ns."""
    stepper, state = build_stepper(model, level), rest_state(level, WIDTH)
    wind = wind_on(level, training_wind(), 5.0)
    return 1e9 * median_seconds(lambda: stepper.step(state, wind, wind, steps), repeats=7) / (steps * WIDTH)


def plant_bytes(plant: Plant, finest: Level) -> int:
    """Memory of a plant's arrays and of its level 0.

    Args:
        plant: the plant.
        finest: its level 0.
    """
    return _bytes_of(plant) + _bytes_of(finest) + _bytes_of(finest.modes)


def levels_bytes(ladder: Ladder) -> int:
    """Memory that the levels beyond level 0 add: their own arrays and the static shapes that all share."""
    own = [level for level in ladder.levels if level.group_count and not level.coupled]
    return ladder.hierarchy.shapes.nbytes + sum(_bytes_of(level) + _bytes_of(level.modes) for level in own)


def merge_tree_bytes(ladder: Ladder) -> int:
    """Memory of what levels are cut from: the merge tree and the first-order influence of every link."""
    return _bytes_of(ladder.hierarchy) + _bytes_of(ladder.hierarchy.influence)


def _bytes_of(one: Plant | Level | Modes | Hierarchy | Influence) -> int:
    """Memory of a dataclass' arrays, but for the static shapes of a level, which are not its own."""
    arrays = (getattr(one, name) for name in one.__dataclass_fields__ if name != "shapes")
    return sum(array.nbytes for array in arrays if isinstance(array, np.ndarray))
