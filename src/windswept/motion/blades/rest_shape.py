"""Where a blade comes to rest: Endo's pass from base to tip, or the true equilibrium; both by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.motion.blades.chain import Chain, weight_share
from windswept.motion.blades.newton import pose_chain, settle
from windswept.motion.rods import Doubles

Method = Literal["equilibrium", "sequential"]
GRAVITY = 9.81
"""m/s^2."""
SEED_TURN = 1e-3
"""By which the base joint is nudged before every search, rad: a straight column that bears more than it can is in
equilibrium, but not in a stable one (PHYSICS C2.2)."""
RAMP = 8
"""Steps in which the load is raised from zero, so that the equilibrium is the one that a blade would come to."""


@dataclass(frozen=True, slots=True)
class RestShape:
    """How a blade hangs, in its base frame (axis, normal, side)."""

    turns: Doubles
    """(K, 2) of every joint, rad."""
    joint: Doubles
    """(K + 1, 3) joints and tip, m."""
    frame: Doubles
    """(K, 3, 3) rows axis, normal, side of every section."""
    broken: NDArray[np.bool_]
    """(K,) joints that bore more than their strength, now or before."""


def rest_shape(
    chain: Chain,
    load: Doubles,
    method: Method = "equilibrium",
    broken: NDArray[np.bool_] | None = None,
) -> RestShape:
    """Shape in which the springs of a blade hold a load.

    A joint that bears more than its strength breaks: it keeps 10 % of its stiffness, and stays so when the shape's
    ``broken`` is handed to the next call.

    Args:
        chain: the blade.
        load: (3,) force in the base frame that is spread as the blade's mass is, as its weight; or (K, 3) a force
            at the centre of every section, N.
        method: "equilibrium" is right under any load. "sequential" is the paper's: it bends joint after joint from
            the base with the rest of the blade held stiff, across the flat face only; good to 2 % of length up to
            a weight of 2 EI/L^2 (PHYSICS C2.5).
        broken: (K,) joints that broke before; None for none.
    """
    force = np.asarray(load, np.float64)
    if not np.isfinite(force).all():
        raise InputError("rest shape", "load", float(force[~np.isfinite(force)][0]), "a finite force (N)")
    if force.ndim == 1:
        force = weight_share(chain)[:, None] * force
    gone = np.zeros(chain.section_count, np.bool_) if broken is None else broken.copy()
    solve = _sequential if method == "sequential" else _equilibrium
    while True:
        left = chain.softened(gone)
        turns = solve(left, force)
        strain = moment(left, turns) / left.strength
        if strain.max() <= 1.0:
            return posed(chain, turns, gone)
        gone[np.argmax(strain)] = True


def posed(chain: Chain, turns: Doubles, broken: NDArray[np.bool_] | None = None) -> RestShape:
    """The shape of given joint turns (K, 2)."""
    count = chain.section_count
    joint, axes, frame = np.empty((count + 1, 3)), np.empty((2 * count, 3)), np.empty((count, 3, 3))
    pose_chain(turns, chain.length, joint, axes, frame)
    return RestShape(turns, joint, frame, np.zeros(count, np.bool_) if broken is None else broken)


def natural_turns(chain: Chain) -> Doubles:
    """(K, 2) joint turns of a blade without any load, rad."""
    return np.stack([chain.turn, np.zeros_like(chain.turn)], axis=1)


def moment(chain: Chain, turns: Doubles) -> Doubles:
    """(..., K) elastic moment in every joint at turns (..., K, 2), N m."""
    return np.linalg.norm(chain.stiffness * (turns - natural_turns(chain)), axis=-1)


def _equilibrium(chain: Chain, force: Doubles) -> Doubles:
    """(K, 2) turns of the equilibrium to which a slowly growing load leads."""
    turns = natural_turns(chain)
    for part in np.arange(1, RAMP + 1) / RAMP:
        turns[0, 0] += SEED_TURN
        settle(turns, chain.length, chain.turn, chain.stiffness, part * force)
    return turns


def _sequential(chain: Chain, force: Doubles) -> Doubles:
    """(K, 2) turns by Endo's equation 1 at one joint after the other, from the base to the tip.

    With R from the joint to the centre of the forces beyond it, gamma the angle of R against the force's opposite
    and K = k / (R F), the joint gives way by alpha = atan2(sin gamma, K - cos gamma) (PHYSICS C2.1, C2.2).
    """
    turns = natural_turns(chain)
    for i in range(chain.section_count):
        joint = posed(chain, turns).joint
        centre = 0.5 * (joint[i:-1] + joint[i + 1 :])
        beyond = force[i:].sum(axis=0)
        size = np.linalg.norm(force[i:], axis=1)
        arm = (size @ centre) / max(size.sum(), 1e-300) - joint[i]
        # In the plane of axis and normal; gamma grows from the axis towards the normal.
        lever, pull = np.hypot(arm[0], arm[1]), np.hypot(beyond[0], beyond[1])
        up = np.arctan2(-beyond[1], -beyond[0])
        gamma = np.arctan2(arm[1], arm[0]) - up
        ratio = chain.stiffness[i, 0] / max(lever * pull, 1e-300)
        turns[i, 0] += np.arctan2(np.sin(gamma), ratio - np.cos(gamma))
    return turns
