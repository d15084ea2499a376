"""The two walks on which all linear mechanics of a plant rests: root to leaf and leaf to root.

Both take the arrays of a whole subtree (one range of links in depth-first order) and ``start``, the index of its
first link in the plant; a link whose parent lies before ``start`` has its base held still.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from windswept.motion.rods import Doubles
from windswept.plants.plant import Ints


@njit(cache=True)
def joint_motion(
    parent: Ints, start: int, attach: Doubles, vector: Doubles, axes: Doubles, joint: Doubles
) -> tuple[Doubles, Doubles]:
    """Angular and base acceleration (or velocity) of every link from those of the joints, root to leaf.

    Args:
        parent: (n,) parent link in the plant.
        start: index of the subtree's first link in the plant.
        attach: (n,) fraction along the parent link.
        vector: (n, 3) base to tip, m.
        axes: (n, 2, 3) joint axes.
        joint: (n, 2) joint accelerations about the axes.

    Returns:
        (n, 3) angular and (n, 3) base acceleration.
    """
    count = len(parent)
    angular, linear = np.zeros((count, 3)), np.zeros((count, 3))
    for link in range(count):
        for i in range(3):
            angular[link, i] = axes[link, 0, i] * joint[link, 0] + axes[link, 1, i] * joint[link, 1]
        up = parent[link] - start
        if up >= 0:
            w, d, f = angular[up], vector[up], attach[link]
            linear[link, 0] = linear[up, 0] + f * (w[1] * d[2] - w[2] * d[1])
            linear[link, 1] = linear[up, 1] + f * (w[2] * d[0] - w[0] * d[2])
            linear[link, 2] = linear[up, 2] + f * (w[0] * d[1] - w[1] * d[0])
            for i in range(3):
                angular[link, i] += w[i]
    return angular, linear


@njit(cache=True)
def joint_torque(
    parent: Ints,
    start: int,
    attach: Doubles,
    vector: Doubles,
    axes: Doubles,
    force: Doubles,
    moment: Doubles,
) -> Doubles:
    """Torque about every joint axis from forces on the links beyond it, leaf to root.

    Args:
        parent: (n,) parent link in the plant.
        start: index of the subtree's first link in the plant.
        attach: (n,) fraction along the parent link.
        vector: (n, 3) base to tip, m.
        axes: (n, 2, 3) joint axes.
        force: (n, 3) force on each link, N; overwritten with the subtree's.
        moment: (n, 3) moment on each link about its base, N m; overwritten with the subtree's.

    Returns:
        (n, 2) torque, N m.
    """
    count = len(parent)
    torque = np.empty((count, 2))
    for link in range(count - 1, -1, -1):
        n, f = moment[link], force[link]
        for k in range(2):
            torque[link, k] = axes[link, k, 0] * n[0] + axes[link, k, 1] * n[1] + axes[link, k, 2] * n[2]
        up = parent[link] - start
        if up >= 0:
            d, s = vector[up], attach[link]
            moment[up, 0] += n[0] + s * (d[1] * f[2] - d[2] * f[1])
            moment[up, 1] += n[1] + s * (d[2] * f[0] - d[0] * f[2])
            moment[up, 2] += n[2] + s * (d[0] * f[1] - d[1] * f[0])
            for i in range(3):
                force[up, i] += f[i]
    return torque


@njit(cache=True)
def inertial_torque(
    parent: Ints,
    start: int,
    attach: Doubles,
    vector: Doubles,
    axes: Doubles,
    mass: Doubles,
    moment: Doubles,
    inertia: Doubles,
    joint: Doubles,
) -> Doubles:
    """The joint-space mass matrix times joint accelerations, in linear time.

    Args:
        parent: (n,) parent link in the plant.
        start: index of the subtree's first link in the plant.
        attach: (n,) fraction along the parent link.
        vector: (n, 3) base to tip, m.
        axes: (n, 2, 3) joint axes.
        mass: (n,) kg.
        moment: (n,) first moment over link length, kg.
        inertia: (n,) about an axis across the link through its base, kg m^2.
        joint: (n, 2) joint accelerations, rad/s^2.

    Returns:
        (n, 2) torque that they take, N m.
    """
    angular, linear = joint_motion(parent, start, attach, vector, axes, joint)
    count = len(parent)
    force, turning = np.empty((count, 3)), np.empty((count, 3))
    for link in range(count):
        w, a, d = angular[link], linear[link], vector[link]
        along = (w[0] * d[0] + w[1] * d[1] + w[2] * d[2]) / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            force[link, i] = mass[link] * a[i] + moment[link] * (w[j] * d[k] - w[k] * d[j])
            turning[link, i] = inertia[link] * (w[i] - along * d[i]) + moment[link] * (
                d[j] * a[k] - d[k] * a[j]
            )
    return joint_torque(parent, start, attach, vector, axes, force, turning)
