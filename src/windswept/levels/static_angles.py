"""static_angles: where steady wind holds every joint, however far it bends the plant."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from windswept.motion import Model, Stepper, finest_level, rest_state
from windswept.motion.modal import no_modes
from windswept.motion.model import HALF_STEP, MOBILITY, STEP_VV, STEP_XX, TENSION
from windswept.plants.plant import Floats

RELAXATION = 0.35
"""Share of the way to its target that a joint goes in one sweep."""
RISE, MOST_SWEEPS = 30, 90
"""Sweeps over which the wind rises, and all sweeps, for a plant that will not come to rest."""
LOOK_EVERY = 10
"""Sweeps between two looks whether the plant is at rest."""
AT_REST = 1e-6
"""A plant is at rest when no joint turns further than this in a sweep, rad."""


def static_angles(model: Model, winds: Floats) -> Floats:
    """Joint angles of a plant at rest in steady, uniform winds.

    The motion's own kernel finds them: without inertia, a step is a sweep that takes every joint part of the way to
    the angle at which its spring holds the moment of the wind on the plant as it is bent now.

    Args:
        model: the plant.
        winds: (n, 3) air velocities, m/s.

    Returns:
        (n, L, 2) rad.
    """
    constants = model.constants.copy()
    constants[:, STEP_XX : STEP_VV + 1] = 0.0
    constants[:, STEP_XX] = 1.0 - RELAXATION
    constants[:, (HALF_STEP, MOBILITY, TENSION)] = 0.0
    level = replace(finest_level(model), constants=constants, modes=no_modes())
    stepper, state = Stepper(level), rest_state(level, len(winds))
    steady = np.broadcast_to(winds[:, None], (len(winds), len(level.probe_position), 3))
    for sweep in range(1, MOST_SWEEPS + 1):
        before = state.joints.copy() if sweep % LOOK_EVERY == 0 else state.joints
        air = steady * np.float32(np.sqrt(min(1.0, sweep / RISE)))
        stepper.step(state, air, air)
        if sweep > RISE and before is not state.joints and np.abs(state.joints - before).max() < AT_REST:
            break
    return np.stack([state.angles(lane) for lane in range(len(winds))])
