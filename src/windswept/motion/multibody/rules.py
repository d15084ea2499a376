"""What a step reckons with besides a plant's constants.

Passed to the kernels, since a number that they read as a global is frozen into their cached machine code.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from windswept.motion.model import Model
from windswept.motion.multibody import constants


class Rules(NamedTuple):
    """Numbers of a step in single precision; see constants.py."""

    step: np.float32
    """Warped, s."""
    ahead: np.float32
    """How far into the step forces are taken, s."""
    rate_lead: np.float32
    pull_knee: np.float32
    stop_angle: np.float32
    """rad"""
    stop_stiffness: np.float32
    stop_edge: np.float32
    """rad"""
    most_angle: np.float32
    """rad"""
    rest_threshold: np.float32


def step_rules(model: Model) -> Rules:
    """Rules of a plant at its time step."""
    numbers = (
        constants.warped_step(model),
        constants.forces_at(model),
        constants.RATE_LEAD,
        constants.PULL_KNEE,
        constants.STOP_ANGLE,
        constants.STOP_STIFFNESS,
        constants.STOP_EDGE,
        constants.MOST_ANGLE,
        constants.REST_THRESHOLD,
    )
    return Rules(*(np.float32(number) for number in numbers))
