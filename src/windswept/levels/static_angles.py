"""static_angles: where steady wind holds every joint, however far it bends the plant."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from windswept.motion import Model, Stepper, finest_level, rest_state
from windswept.motion.lanes import WIDTH
from windswept.motion.model import HALF_STEP, MOBILITY, STEP_VV, STEP_XX, TENSION
from windswept.plants.plant import Floats

RELAXATION = 0.35
"""Share of the way to its target that a joint goes in one sweep."""
RISE, SWEEPS = 30, 120
"""Sweeps over which the wind rises, and all sweeps."""


def static_angles(model: Model, winds: Floats) -> Floats:
    """Joint angles of a plant at rest in steady, uniform winds.

    The motion's own kernel finds them: without inertia, a step is a sweep that takes every joint part of the way to
    the angle at which its spring holds the moment of the wind on the plant as it is bent now.

    Args:
        model: the plant.
        winds: (n, 3) air velocities, n at most the lanes of a register, m/s.

    Returns:
        (n, L, 2) rad.
    """
    constants = model.constants.copy()
    constants[:, STEP_XX : STEP_VV + 1] = 0.0
    constants[:, STEP_XX] = 1.0 - RELAXATION
    constants[:, (HALF_STEP, MOBILITY, TENSION)] = 0.0
    level = replace(finest_level(model), constants=constants)
    stepper, state = Stepper(level), rest_state(level, WIDTH)
    air = np.zeros((WIDTH, len(level.probe_position), 3), np.float32)
    for sweep in range(SWEEPS):
        air[: len(winds)] = winds[:, None] * np.sqrt(min(1.0, (sweep + 1) / RISE))
        stepper.step(state, air, air)
    return np.stack([state.angles(lane) for lane in range(len(winds))])
