"""carry_over: the state of one placement, from one level to another."""

from __future__ import annotations

import numpy as np

from windswept.levels.hierarchy import Hierarchy
from windswept.motion import Level, State
from windswept.plants.plant import Floats

REGULAR = 1e-6
"""Relative weight that keeps a group's pressure determined where its joints hardly feel one direction."""


def joint_motion_of(level: Level, state: State, placement: int) -> tuple[Floats, Floats]:
    """(L, 2) angles and (L, 2) velocities of all joints of one placement, whatever moves them.

    Args:
        level: that the placement is simulated at.
        state: of that level.
        placement: index in that state.
    """
    own = level.listens >= 0
    angles = np.empty((len(level.listens), 2), np.float32)
    velocities = np.empty_like(angles)
    angles[own] = state.angles(placement)[level.listens[own]]
    velocities[own] = state.velocities(placement)[level.listens[own]]
    pressures = state.pressures(placement)[-1 - level.listens[~own]]
    angles[~own] = np.einsum("lij,lj->li", level.influence[~own], pressures[:, 0])
    velocities[~own] = np.einsum("lij,lj->li", level.influence[~own], pressures[:, 1])
    return angles, velocities


def carry_over(
    hierarchy: Hierarchy, angles: Floats, velocities: Floats, level: Level
) -> tuple[Floats, Floats]:
    """State at a level that moves the plant as given joint angles and velocities do.

    Links take their own; a group takes the pressure whose static shape is nearest in elastic energy.

    Args:
        hierarchy: of the plant.
        angles: (L, 2) rad.
        velocities: (L, 2) rad/s.
        level: to go to.

    Returns:
        (A, 4) joints and (G, 6) groups, in the order of ``State``.
    """
    joints = np.empty((level.link_count, 4), np.float32)
    joints[:, 0::2] = angles[level.link]
    joints[:, 1::2] = velocities[level.link]
    if level.group_count == 0 or not level.group_constants.any():
        return joints, np.zeros((level.group_count, 6), np.float32)
    own = level.listens < 0
    group = -1 - level.listens[own]
    shape = level.influence[own].astype(np.float64)
    stiff = shape / hierarchy.model.rods.compliance[own][:, :, None]
    normal = _sum_by(group, np.einsum("lki,lkj->lij", stiff, shape), level.group_count)
    normal += REGULAR * np.trace(normal, axis1=1, axis2=2)[:, None, None] * np.eye(3) + 1e-30 * np.eye(3)
    pressure = np.empty((level.group_count, 6))
    for column, motion in enumerate((angles, velocities)):
        right = _sum_by(group, np.einsum("lki,lk->li", stiff, motion[own]), level.group_count)
        pressure[:, 3 * column : 3 * column + 3] = np.linalg.solve(normal, right[..., None])[..., 0]
    return joints, pressure.astype(np.float32)


def _sum_by(group: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Sum of values over each group."""
    total = np.zeros((count, *values.shape[1:]))
    np.add.at(total, group, values)
    return total
