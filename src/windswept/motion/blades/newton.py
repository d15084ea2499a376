"""Equilibrium of a chain under dead forces: Newton's method on its energy, for one blade in double precision.

Energy is 1/2 k (turn - natural turn)^2 over all joints, less force x place of every section's centre. With the axes e
of the 2 K turns in the order from base to tip, r from a joint to a section's centre and S the sum of r f^T beyond it::

    gradient    k (turn - natural turn) - e . sum(r x f)
    Hessian     k delta - e_i . S_k e_k + tr(S_k) e_i . e_k       for k at or beyond i

Where the Hessian is not positive definite (a column about to buckle) a multiple of unity is added to it, and a step
that does not lower the energy is halved, so the way always leads down to a stable equilibrium.
"""

from __future__ import annotations

import numpy as np
from numba import njit, prange

from windswept.motion.rods import Doubles

MOST_STEPS = 200
MOST_HALVINGS = 30
LONGEST_STEP = 0.3
"""Largest change of a turn in one step, rad."""
CLOSE_ENOUGH = 1e-9
"""A step smaller than this ends the search, rad."""


@njit(cache=True)
def pose_chain(turns: Doubles, length: Doubles, joint: Doubles, axes: Doubles, frame: Doubles) -> None:
    """Places joints (K + 1, 3), turning axes (2 K, 3) and section frames (K, 3, 3) in the base frame.

    Rows of a frame are axis, normal and side; see chain.py for the two turns of a joint.
    """
    t, n, s = np.zeros(3), np.zeros(3), np.zeros(3)
    t[0] = n[1] = s[2] = 1.0
    for a in range(3):
        joint[0, a] = 0.0
    for i in range(len(length)):
        flat_cosine, flat_sine = np.cos(turns[i, 0]), np.sin(turns[i, 0])
        side_cosine, side_sine = np.cos(turns[i, 1]), np.sin(turns[i, 1])
        for a in range(3):
            axes[2 * i, a] = s[a]
            bent = t[a] * flat_cosine + n[a] * flat_sine
            n[a] = n[a] * flat_cosine - t[a] * flat_sine
            axes[2 * i + 1, a] = -n[a]
            t[a] = bent * side_cosine + s[a] * side_sine
            s[a] = s[a] * side_cosine - bent * side_sine
            frame[i, 0, a], frame[i, 1, a], frame[i, 2, a] = t[a], n[a], s[a]
            joint[i + 1, a] = joint[i, a] + length[i] * t[a]


@njit(cache=True)
def _energy(turns, natural, stiffness, force, joint):  # type: ignore[no-untyped-def]
    energy = 0.0
    for i in range(len(natural)):
        bend, swing = turns[i, 0] - natural[i], turns[i, 1]
        energy += 0.5 * (stiffness[i, 0] * bend * bend + stiffness[i, 1] * swing * swing)
        for a in range(3):
            energy -= 0.5 * force[i, a] * (joint[i, a] + joint[i + 1, a])
    return energy


@njit(cache=True)
def _slopes(turns, natural, stiffness, force, joint, axes, gradient, hessian):  # type: ignore[no-untyped-def]
    """Gradient (2 K) and Hessian (2 K, 2 K); the module's docstring has the formulas."""
    total, first, beyond, pulled = np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3)), np.zeros(3)
    for k in range(len(natural) - 1, -1, -1):
        for a in range(3):
            total[a] += force[k, a]
        for a in range(3):
            for b in range(3):
                first[a, b] += 0.5 * (joint[k, a] + joint[k + 1, a]) * force[k, b]
                beyond[a, b] = first[a, b] - joint[k, a] * total[b]
        trace = beyond[0, 0] + beyond[1, 1] + beyond[2, 2]
        for at in range(2 * k, 2 * k + 2):
            e, bend = axes[at], at - 2 * k
            torque = e[0] * (beyond[1, 2] - beyond[2, 1]) + e[1] * (beyond[2, 0] - beyond[0, 2])
            torque += e[2] * (beyond[0, 1] - beyond[1, 0])
            rest = natural[k] if bend == 0 else 0.0
            gradient[at] = stiffness[k, bend] * (turns[k, bend] - rest) - torque
            for a in range(3):
                pulled[a] = trace * e[a] - beyond[a, 0] * e[0] - beyond[a, 1] * e[1] - beyond[a, 2] * e[2]
            for i in range(at + 1):
                value = axes[i, 0] * pulled[0] + axes[i, 1] * pulled[1] + axes[i, 2] * pulled[2]
                hessian[i, at] = value
                hessian[at, i] = value
            hessian[at, at] += stiffness[k, bend]


@njit(cache=True)
def factorise(matrix, shift, lower):  # type: ignore[no-untyped-def]
    """Cholesky's factor of matrix + shift; False where there is none."""
    for i in range(len(matrix)):
        for j in range(i + 1):
            value = matrix[i, j] + (shift if i == j else 0.0)
            for k in range(j):
                value -= lower[i, k] * lower[j, k]
            if i == j:
                if value <= 1e-12 * abs(matrix[i, i]):
                    return False
                lower[i, i] = np.sqrt(value)
            else:
                lower[i, j] = value / lower[j, j]
    return True


@njit(cache=True)
def solve(lower, right):  # type: ignore[no-untyped-def]
    """Solves in place with Cholesky's factor."""
    count = len(right)
    for i in range(count):
        for k in range(i):
            right[i] -= lower[i, k] * right[k]
        right[i] /= lower[i, i]
    for i in range(count - 1, -1, -1):
        for k in range(i + 1, count):
            right[i] -= lower[k, i] * right[k]
        right[i] /= lower[i, i]


@njit(cache=True)
def _longest(values):  # type: ignore[no-untyped-def]
    longest = 0.0
    for i in range(len(values)):
        longest = max(longest, abs(values[i]))
    return longest


@njit(cache=True)
def _newton_step(hessian, gradient, lower, step):  # type: ignore[no-untyped-def]
    """The step downhill, at most LONGEST_STEP in any turn."""
    unit = 0.0
    for i in range(len(gradient)):
        step[i] = -gradient[i]
        unit = max(unit, 1e-3 * abs(hessian[i, i]))
    shift = 0.0
    while not factorise(hessian, shift, lower):
        shift = max(4.0 * shift, unit)
    solve(lower, step)
    shorter = min(1.0, LONGEST_STEP / (_longest(step) + 1e-300))
    for i in range(len(step)):
        step[i] *= shorter


@njit(cache=True)
def settle(turns: Doubles, length: Doubles, natural: Doubles, stiffness: Doubles, force: Doubles) -> None:
    """Moves turns (K, 2) to the stable equilibrium below them under forces (K, 3) at the sections' centres."""
    count = len(length)
    joint, axes, frame = np.empty((count + 1, 3)), np.empty((2 * count, 3)), np.empty((count, 3, 3))
    gradient, hessian = np.empty(2 * count), np.empty((2 * count, 2 * count))
    lower, step, before = np.zeros_like(hessian), np.empty_like(gradient), np.empty_like(gradient)
    pose_chain(turns, length, joint, axes, frame)
    energy = _energy(turns, natural, stiffness, force, joint)
    for _ in range(MOST_STEPS):
        _slopes(turns, natural, stiffness, force, joint, axes, gradient, hessian)
        _newton_step(hessian, gradient, lower, step)
        for i in range(2 * count):
            before[i] = turns[i // 2, i % 2]
        part = 1.0
        for _halving in range(MOST_HALVINGS):
            for i in range(2 * count):
                turns[i // 2, i % 2] = before[i] + part * step[i]
            pose_chain(turns, length, joint, axes, frame)
            lowered = _energy(turns, natural, stiffness, force, joint)
            if lowered <= energy + 1e-14 * abs(energy):
                break
            part *= 0.5
        energy = min(energy, lowered)
        if part * _longest(step) < CLOSE_ENOUGH:
            return


@njit(cache=True)
def _follow_ray(turns, length, natural, stiffness, share, load, nudge):  # type: ignore[no-untyped-def]
    """Turns (R, K, 2) of equilibria under growing loads (R, 3), N, each from the one before it."""
    now, force = np.empty((len(length), 2)), np.empty((len(length), 3))
    now[:] = turns[0]
    for r in range(len(load)):
        for i in range(len(length)):
            for a in range(3):
                force[i, a] = share[i] * load[r, a]
        now[0, 0] += nudge
        settle(now, length, natural, stiffness, force)
        turns[r] = now


@njit(parallel=True, cache=True)
def settle_rays(turns, length, natural, stiffness, share, load, nudge):  # type: ignore[no-untyped-def]
    """Turns (D, R, K, 2) of equilibria along D rays of growing load (D, R, 3), N, each from the one before it.

    The load is spread over the sections by their share (K,). The first pose of a ray starts from ``turns[d, 0]``;
    ``nudge`` (D,) turns the base joint before every search, rad.
    """
    for d in prange(len(load)):
        _follow_ray(turns[d], length, natural, stiffness, share, load[d], nudge[d])
