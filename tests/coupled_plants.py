"""Plants whose links are coupled, pulled aside, and the energy that they swing with."""

from __future__ import annotations

import numpy as np

from windswept.motion import Model, finest_level, rest_state
from windswept.motion.multibody import CoupledState, coupled
from windswept.motion.multibody.plain import energy
from windswept.studies.multibody_steps import bent_by_a_pull


def pulled(model: Model, angle: float) -> CoupledState:
    """At rest, bent as by a pull on all masses until one joint is at an angle."""
    bent = bent_by_a_pull(model)
    state = rest_state(finest_level(model), 1)
    state.angles(0)[:] = bent * angle / np.abs(bent).max()
    return coupled(model, state)


def energy_of(model: Model, state: CoupledState) -> float:
    """Of motion and springs, J."""
    carried = state.carried[0, :, :, 0].reshape(-1, 2, 3).astype(float)
    return energy(model, state.angles(0).astype(float), carried)
