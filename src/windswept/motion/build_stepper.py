"""build_stepper: what steps a simulation level."""

from __future__ import annotations

from windswept.motion.level import Level
from windswept.motion.model import Model
from windswept.motion.multibody import MultibodyStepper
from windswept.motion.springs import Stepper


def build_stepper(model: Model, level: Level) -> Stepper | MultibodyStepper:
    """`multibody` for a coupled level, `springs` for any other.

    Args:
        model: the plant's constants.
        level: what of the plant is stepped.
    """
    return MultibodyStepper(model, level) if level.coupled else Stepper(level)
