"""From joint angles and rates to what coupled links carry: the velocities that they themselves have."""

from __future__ import annotations

import numpy as np
from numba import njit

from windswept.motion.lanes import WIDTH
from windswept.motion.level import finest_level
from windswept.motion.model import Model
from windswept.motion.rods import Doubles
from windswept.motion.rotation import from_rotation_vector, multiply, rotate
from windswept.motion.state import CoupledState, State, rest_state
from windswept.plants.plant import Floats, Ints


def coupled(model: Model, state: State) -> CoupledState:
    """State of coupled links that moves as a state of level 0 does; shares that state's joints.

    Args:
        model: the plant's constants.
        state: at level 0.
    """
    carried = np.zeros((len(state.joints), model.link_count, 6, WIDTH), np.float32)
    for placement in range(state.placement_count):
        tile, lane = divmod(placement, WIDTH)
        carried[tile, :, :, lane] = link_velocities(
            model, state.angles(placement), state.velocities(placement)
        )
    return CoupledState(state.joints, state.groups, state.placement_count, state.step_count, carried)


def coupled_rest(model: Model, placement_count: int) -> CoupledState:
    """State of plants at rest."""
    return coupled(model, rest_state(finest_level(model), placement_count))


def link_velocities(model: Model, angles: Floats, rates: Floats) -> Doubles:
    """(L, 6) velocity of every link's joint, m/s, and rate of its direction, 1/s.

    Args:
        model: the plant's constants.
        angles: (L, 2) of the joints, rad.
        rates: (L, 2) rad/s.
    """
    skeleton = model.skeleton
    return _link_velocities(
        skeleton.parent,
        skeleton.axes,
        skeleton.vector,
        skeleton.attach,
        angles.astype(np.float64),
        rates.astype(np.float64),
    )


@njit(cache=True)
def _link_velocities(
    parent: Ints, axes: Doubles, vector: Doubles, attach: Doubles, angles: Doubles, rates: Doubles
) -> Doubles:
    """Root to leaf."""
    count = len(parent)
    rotation, spin, velocity = np.zeros((count + 1, 4)), np.zeros((count + 1, 3)), np.zeros((count, 6))
    rotation[0, 3] = 1.0
    for link in range(count):
        up = parent[link]
        above = rotation[up + 1]
        q = (above[0], above[1], above[2], above[3])
        turning = _turning(axes[link], angles[link], rates[link])
        turned = rotate(q, (turning[0], turning[1], turning[2]))
        a = angles[link, 0] * axes[link, 0] + angles[link, 1] * axes[link, 1]
        q = multiply(q, from_rotation_vector((a[0], a[1], a[2])))
        d = rotate(q, (vector[link, 0], vector[link, 1], vector[link, 2]))
        if up >= 0:
            reach = attach[link] * np.sqrt(np.sum(vector[up] ** 2))
            velocity[link, :3] = velocity[up, :3] + reach * velocity[up, 3:]
        for k in range(4):
            rotation[link + 1, k] = q[k]
        for k in range(3):
            spin[link + 1, k] = spin[up + 1, k] + turned[k]
        direction = np.array([d[0], d[1], d[2]]) / np.sqrt(np.sum(vector[link] ** 2))
        velocity[link, 3:] = np.cross(spin[link + 1], direction)
    return velocity


@njit(cache=True)
def _turning(axes: Doubles, angles: Doubles, rates: Doubles) -> Doubles:
    """(3,) angular velocity of a joint in its carrier's frame (joint.py)."""
    a = angles[0] * axes[0] + angles[1] * axes[1]
    rate = rates[0] * axes[0] + rates[1] * axes[1]
    angle = np.sqrt(np.sum(a * a)) + 1e-9
    lean = 2.0 * (np.sin(0.5 * angle) / angle) ** 2
    curl = (angle - np.sin(angle)) / angle**3 if angle > 1e-3 else 1.0 / 6.0
    swirl = np.cross(a, rate)
    return rate + lean * swirl + curl * np.cross(a, swirl)
