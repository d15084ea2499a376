"""What moves when all links are coupled: joint angles and rates, and the velocities that the links themselves carry."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numba import njit

from windswept.motion.lanes import WIDTH
from windswept.motion.level import finest_level
from windswept.motion.model import Model
from windswept.motion.pose_links import pose_links
from windswept.motion.rods import Doubles
from windswept.motion.state import State, rest_state
from windswept.plants.plant import Floats, Ints


@dataclass(slots=True)
class CoupledState(State):
    """A State at level 0 that also says how the links moved at the end of the last step."""

    carried: Floats = field(default_factory=lambda: np.zeros((0, 0, 6, WIDTH), np.float32))
    """(T, L, 6, WIDTH) velocity of every link's joint (m/s) and rate of its direction (1/s)."""


def coupled(model: Model, state: State) -> CoupledState:
    """State of coupled links that moves as a state of level 0 does; shares that state's joints.

    Args:
        model: the plant's constants.
        state: at level 0.
    """
    tiles = len(state.joints)
    carried = np.zeros((tiles, WIDTH, model.link_count, 6), np.float32)
    rotation = pose_links(model, finest_level(model), state).rotation.astype(np.float64)
    skeleton = model.skeleton
    for placement in range(state.placement_count):
        angles = state.angles(placement).astype(np.float64)
        rates = state.velocities(placement).astype(np.float64)
        tile, lane = divmod(placement, WIDTH)
        carried[tile, lane] = _link_velocities(
            skeleton.parent,
            skeleton.axes,
            skeleton.vector,
            skeleton.attach,
            rotation[placement],
            angles,
            rates,
        )
    lanes_last = np.ascontiguousarray(carried.transpose(0, 2, 3, 1))
    return CoupledState(state.joints, state.groups, state.placement_count, state.step_count, lanes_last)


def coupled_rest(model: Model, placement_count: int) -> CoupledState:
    """State of plants at rest."""
    return coupled(model, rest_state(finest_level(model), placement_count))


@njit(cache=True)
def _link_velocities(
    parent: Ints,
    axes: Doubles,
    vector: Doubles,
    attach: Doubles,
    rotation: Doubles,
    angles: Doubles,
    rates: Doubles,
) -> Doubles:
    """(L, 6) velocity of every joint and rate of every link's direction, root to leaf."""
    count = len(parent)
    spin, velocity = np.zeros((count, 3)), np.zeros((count, 6))
    for link in range(count):
        up = parent[link]
        turning = _turning(axes[link], angles[link], rates[link])
        if up >= 0:
            turning = spin[up] + _turned(rotation[up], turning)
            velocity[link, :3] = velocity[up, :3]
            velocity[link, :3] += attach[link] * np.sqrt(np.sum(vector[up] ** 2)) * velocity[up, 3:]
        spin[link] = turning
        direction = _turned(rotation[link], vector[link]) / np.sqrt(np.sum(vector[link] ** 2))
        velocity[link, 3:] = np.cross(turning, direction)
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


@njit(cache=True)
def _turned(q: Doubles, v: Doubles) -> Doubles:
    """(3,) vector turned by an (x, y, z, w) quaternion."""
    t = 2.0 * np.cross(q[:3], v)
    return v + q[3] * t + np.cross(q[:3], t)
