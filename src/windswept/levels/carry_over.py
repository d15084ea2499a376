"""carry_over: the state of one placement, from one level to another."""

from __future__ import annotations

import numpy as np
from numba import njit

from windswept.levels.hierarchy import Hierarchy
from windswept.motion import Level, Model, State
from windswept.motion.multibody import link_velocities
from windswept.motion.rods import Doubles
from windswept.motion.rotation import from_rotation_vector, multiply, rotate, rotate_back
from windswept.motion.shapes import shape_slopes, shaped
from windswept.plants.plant import Floats

REGULAR = 2e-5
"""Relative weight that pulls a group's pressure to zero along directions that its joints hardly feel."""
MOST_ROUNDS = 12
"""Of Gauss and Newton's method for a group's pressure; where shapes are nearly linear, three are enough."""
CLOSE = 1e-5
"""Change of a pressure over the greatest that shapes hold for, at which no further round is taken."""
MOMENT = 1e-3
"""Time over which the pressure's rate is followed to find the joints' velocities, s."""


def joint_motion_of(model: Model, level: Level, state: State, placement: int) -> tuple[Floats, Floats]:
    """(L, 2) angles and (L, 2) velocities of all joints of one placement, whatever moves them.

    Args:
        model: the plant.
        level: that the placement is simulated at.
        state: of that level.
        placement: index in that state.
    """
    listens = level.listens
    motion = np.zeros((model.link_count, 4), np.float64)
    own = listens >= 0
    motion[own, :2] = state.angles(placement)[listens[own]]
    motion[own, 2:] = state.velocities(placement)[listens[own]]
    pressures = state.pressures(placement).reshape(-1, 6).astype(np.float64)
    skeleton = model.skeleton
    _walk(
        skeleton.parent, skeleton.axes, listens, level.group_carrier, level.shapes, level.shape_limit,
        pressures, motion,
    )  # fmt: skip
    return motion[:, :2].astype(np.float32), motion[:, 2:].astype(np.float32)


def carry_over(hierarchy: Hierarchy, angles: Floats, velocities: Floats, level: Level) -> tuple[Floats, ...]:
    """State at a level that moves the plant as given joint angles and velocities do.

    Links take their own, and carry the velocities that follow where they are coupled; a group takes the pressure
    whose static shape is nearest in elastic energy.

    Args:
        hierarchy: of the plant.
        angles: (L, 2) rad.
        velocities: (L, 2) rad/s.
        level: to go to.

    Returns:
        The parts of ``State``: (A, 4) joints and (G, 6) groups, and (A, 6) what links carry at a coupled level.
    """
    joints = np.empty((level.link_count, 4), np.float32)
    joints[:, 0::2] = angles[level.link]
    joints[:, 1::2] = velocities[level.link]
    groups = _pressures(hierarchy, angles, velocities, level)
    if not level.coupled:
        return joints, groups
    carried = link_velocities(hierarchy.model, angles, velocities)[level.link]
    return joints, groups, carried.astype(np.float32)


def _pressures(hierarchy: Hierarchy, angles: Floats, velocities: Floats, level: Level) -> Floats:
    """(G, 6) pressure of every group, and its rate, whose static shapes are nearest in elastic energy."""
    if level.group_count == 0 or not level.group_constants.any():
        return np.zeros((level.group_count, 6), np.float32)
    skeleton = hierarchy.model.skeleton
    listens = level.listens
    motion = np.concatenate([angles, velocities], axis=1).astype(np.float64)
    rotation = _walk(
        skeleton.parent, skeleton.axes, np.zeros_like(listens), level.group_carrier, level.shapes,
        level.shape_limit, np.zeros((0, 6)), motion,
    )  # fmt: skip
    pressure = np.zeros((level.group_count, 6))
    for _ in range(MOST_ROUNDS):
        normal, right = _normal_equations(
            skeleton.parent, listens, level.group_carrier, level.shapes, level.shape_limit,
            1.0 / hierarchy.model.rods.compliance, rotation, motion, pressure,
        )  # fmt: skip
        pull = REGULAR * np.trace(normal, axis1=1, axis2=2)[:, None]
        normal += (pull + 1e-30)[..., None] * np.eye(3)
        right[:, 0] -= pull * pressure[:, :3]
        change = np.linalg.solve(normal, right.transpose(0, 2, 1))
        pressure[:, :3] += change[..., 0]
        pressure[:, 3:] = change[..., 1]
        if np.abs(change[..., 0]).max() < CLOSE * level.shape_limit:
            break
    return pressure.astype(np.float32)


@njit(cache=True)
def _walk(  # type: ignore[no-untyped-def]
    parent, axes, listens, carrier, shapes, limit, pressure, motion
):
    """Root to tip: fills in the motion of joints that listen to groups; gives (L + 1, 4) rotations, ground first."""
    count = len(parent)
    rotation = np.zeros((count + 1, 4))
    rotation[0, 3] = 1.0
    for link in range(count):
        q_parent = _quaternion(rotation, parent[link] + 1)
        if listens[link] < 0:
            group = -1 - listens[link]
            q = _quaternion(rotation, carrier[group] + 1)
            u = (pressure[group, 0], pressure[group, 1], pressure[group, 2])
            rate = (pressure[group, 3], pressure[group, 4], pressure[group, 5])
            later = (u[0] + MOMENT * rate[0], u[1] + MOMENT * rate[1], u[2] + MOMENT * rate[2])
            now = shaped(shapes[link], rotate_back(q_parent, rotate(q, u)), limit)
            then = shaped(shapes[link], rotate_back(q_parent, rotate(q, later)), limit)
            motion[link, 0], motion[link, 1] = now
            motion[link, 2], motion[link, 3] = (then[0] - now[0]) / MOMENT, (then[1] - now[1]) / MOMENT
        turn = motion[link, 0] * axes[link, 0] + motion[link, 1] * axes[link, 1]
        q = multiply(q_parent, from_rotation_vector((turn[0], turn[1], turn[2])))
        for k in range(4):
            rotation[link + 1, k] = q[k]
    return rotation


@njit(cache=True)
def _normal_equations(  # type: ignore[no-untyped-def]
    parent, listens, carrier, shapes, limit, stiffness, rotation, motion, pressure
):
    """(G, 3, 3) and (G, 2, 3): what the joints of each group ask of a change of its pressure, and of its rate."""
    normal, right = np.zeros((len(pressure), 3, 3)), np.zeros((len(pressure), 2, 3))
    for link in range(len(parent)):
        if listens[link] >= 0:
            continue
        group = -1 - listens[link]
        q_parent, q = _quaternion(rotation, parent[link] + 1), _quaternion(rotation, carrier[group] + 1)
        u = (pressure[group, 0], pressure[group, 1], pressure[group, 2])
        felt = rotate_back(q_parent, rotate(q, u))
        now = shaped(shapes[link], felt, limit)
        slopes = shape_slopes(shapes[link], felt, limit)
        for k in range(2):
            slope = rotate_back(q, rotate(q_parent, slopes[k]))
            weight = stiffness[link, k]
            missing, speed = weight * (motion[link, k] - now[k]), weight * motion[link, k + 2]
            for i in range(3):
                for j in range(3):
                    normal[group, i, j] += weight * slope[i] * slope[j]
                right[group, 0, i] += slope[i] * missing
                right[group, 1, i] += slope[i] * speed
    return normal, right


@njit(cache=True)
def _quaternion(rotation: Doubles, row: int) -> tuple[float, float, float, float]:
    return rotation[row, 0], rotation[row, 1], rotation[row, 2], rotation[row, 3]
