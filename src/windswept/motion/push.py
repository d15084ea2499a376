"""Impulses from outside: a bird that lands, a hand that lets go, a ball that hits a branch."""

from __future__ import annotations

import numpy as np

from windswept.motion.level import finest_level
from windswept.motion.model import Model
from windswept.motion.multibody.push_coupled import push_coupled
from windswept.motion.pose_links import pose_links
from windswept.motion.rods import Doubles
from windswept.motion.state import CoupledState, State


def push(
    model: Model, state: State, placement: int, link: int, impulse: Doubles, along: float = 1.0
) -> State:
    """Adds an impulse to one link of one placement at level 0; all joints between it and the root take their part.

    Coupled links take it as their masses ask for, each joint of the plant; see push_coupled.py.

    Args:
        model: the plant's constants.
        state: changed in place and returned.
        placement: which placement.
        link: which link is hit.
        impulse: (3,) in the plant's frame, N s.
        along: where on the link, 0 at its base, 1 at its tip.

    """
    if isinstance(state, CoupledState):
        return push_coupled(model, state, placement, link, impulse, along)
    pose = pose_links(model, finest_level(model), state)
    position, rotation = pose.position[placement], pose.rotation[placement].astype(np.float64)
    skeleton = model.skeleton
    struck = position[link] + along * turn(rotation[link], skeleton.vector[link])
    velocities = state.velocities(placement)
    while link >= 0:
        parent = int(skeleton.parent[link])
        axes = skeleton.axes[link]
        if parent >= 0:
            axes = np.array([turn(rotation[parent], axis) for axis in axes])
        angular_impulse = axes @ np.cross(struck - position[link], impulse)
        velocities[link] += angular_impulse / model.joint_inertia[link]
        link = parent
    return state


def turn(quaternion: Doubles, vector: Doubles) -> Doubles:
    """(3,) vector turned by an (x, y, z, w) quaternion."""
    q, w = quaternion[:3], quaternion[3]
    t = 2.0 * np.cross(q, vector)
    return vector + w * t + np.cross(q, t)
