"""push_coupled: an impulse on one link of a plant whose links are coupled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from windswept.motion.lanes import WIDTH
from windswept.motion.model import Model
from windswept.motion.multibody.constants import RATE_LEAD
from windswept.motion.multibody.coupled_state import coupled_rest, link_velocities
from windswept.motion.multibody.stepper import MultibodyStepper
from windswept.motion.rods import Doubles
from windswept.motion.state import CoupledState
from windswept.plants.plant import Floats

MOMENT = 1e-9
"""Length of a step in which an impulse is all that happens, s."""


def push_coupled(
    model: Model, state: CoupledState, placement: int, link: int, impulse: Doubles, along: float
) -> CoupledState:
    """Adds an impulse to one link of one placement; every joint of the plant answers with what its mass asks for.

    Args:
        model: the plant's constants.
        state: changed in place and returned.
        placement: which placement.
        link: which link is hit.
        impulse: (3,) in the plant's frame, N s.
        along: where on the link, 0 at its base, 1 at its tip.

    Raises:
        ValueError: a state of merged branches, which are not joints that a push could turn.
    """
    if state.joints.shape[1] != model.link_count or state.groups.shape[1]:
        raise ValueError("a push needs every link: the state is of a level with merged branches")
    tile, lane = divmod(placement, WIDTH)
    joints, _, carried = (part[tile, ..., lane] for part in state.parts)
    gain = _rate_gain(model, joints, carried, link, _carried_gain(model, link, impulse, along))
    angles, rates = state.angles(placement), state.velocities(placement)
    before = link_velocities(model, angles, rates)
    rates += gain
    carried += (link_velocities(model, angles, rates) - before).astype(np.float32)
    return state


def _carried_gain(model: Model, link: int, impulse: Doubles, along: float) -> Doubles:
    """(6,) velocity of a link's joint and rate of its direction that an impulse gives it where it hangs on nothing."""
    rods, length = model.rods, model.skeleton.length[link]
    first = rods.moment[link] * length
    mass = np.array([[rods.mass[link], first], [first, rods.inertia[link]]])
    return np.linalg.solve(mass, np.outer([1.0, along * length], impulse)).ravel()


def _rate_gain(model: Model, joints: Floats, carried: Floats, link: int, gain: Doubles) -> Floats:
    """(L, 2) gain of all joint rates from what one link carries more, by a step too short for anything else.

    From the difference of two such steps, with and without: a step goes on beyond the rates nearest to what is
    carried (RATE_LEAD).
    """
    pair = coupled_rest(model, 2)
    pair.joints[0, ..., :2], pair.carried[0, ..., :2] = joints[..., None], carried[..., None]
    pair.carried[0, link, :, 1] += gain
    calm = np.zeros((2, len(model.probe_position), 3), np.float32)
    MultibodyStepper(replace(model, time_step=MOMENT)).step(pair, calm, calm)
    return (pair.velocities(1) - pair.velocities(0)) / (1.0 + RATE_LEAD)
