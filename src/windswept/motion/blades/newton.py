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
LONGEST_STEP = 0.3
"""Largest change of a turn in one step, rad."""
CLOSE_ENOUGH = 1e-9
"""A step smaller than this ends the search, rad."""


@njit(cache=True)
def pose_chain(turns: Doubles, length: Doubles, joint: Doubles, axes: Doubles, frame: Doubles) -> None:
    """Places joints (K + 1, 3), turning axes (2 K, 3) and section frames (K, 3, 3) in the base frame.

    Rows of a frame are axis, normal and side; see chain.py for the two turns of a joint.
    """
    t, n, s = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    joint[0] = 0.0
    for i in range(len(length)):
        axes[2 * i] = s
        cosine, sine = np.cos(turns[i, 0]), np.sin(turns[i, 0])
        t, n = t * cosine + n * sine, n * cosine - t * sine
        axes[2 * i + 1] = -n
        cosine, sine = np.cos(turns[i, 1]), np.sin(turns[i, 1])
        t, s = t * cosine + s * sine, s * cosine - t * sine
        frame[i, 0], frame[i, 1], frame[i, 2] = t, n, s
        joint[i + 1] = joint[i] + length[i] * t


@njit(cache=True)
def _energy(turns, natural, stiffness, force, joint):  # type: ignore[no-untyped-def]
    energy = 0.0
    for i in range(len(natural)):
        bend, swing = turns[i, 0] - natural[i], turns[i, 1]
        energy += 0.5 * (stiffness[i, 0] * bend * bend + stiffness[i, 1] * swing * swing)
        energy -= 0.5 * np.dot(force[i], joint[i] + joint[i + 1])
    return energy


@njit(cache=True)
def _slopes(turns, natural, stiffness, force, joint, axes, gradient, hessian):  # type: ignore[no-untyped-def]
    """Gradient (2 K) and Hessian (2 K, 2 K); the module's docstring has the formulas."""
    count = len(natural)
    total, first = np.zeros(3), np.zeros((3, 3))
    for k in range(count - 1, -1, -1):
        centre = 0.5 * (joint[k] + joint[k + 1])
        total += force[k]
        first += np.outer(centre, force[k])
        beyond = first - np.outer(joint[k], total)
        torque = np.array(
            [beyond[1, 2] - beyond[2, 1], beyond[2, 0] - beyond[0, 2], beyond[0, 1] - beyond[1, 0]]
        )
        trace = beyond[0, 0] + beyond[1, 1] + beyond[2, 2]
        for b in range(2):
            at = 2 * k + b
            rest = natural[k] if b == 0 else 0.0
            gradient[at] = stiffness[k, b] * (turns[k, b] - rest) - np.dot(axes[at], torque)
            pulled = np.dot(beyond, axes[at])
            for i in range(at + 1):
                value = trace * np.dot(axes[i], axes[at]) - np.dot(axes[i], pulled)
                hessian[i, at] = value
                hessian[at, i] = value
            hessian[at, at] += stiffness[k, b]


@njit(cache=True)
def _factorise(matrix, shift, lower):  # type: ignore[no-untyped-def]
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
def _solve(lower, right):  # type: ignore[no-untyped-def]
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
def settle(turns: Doubles, length: Doubles, natural: Doubles, stiffness: Doubles, force: Doubles) -> None:
    """Moves turns (K, 2) to the stable equilibrium below them under forces (K, 3) at the sections' centres."""
    count = len(length)
    joint, axes, frame = np.empty((count + 1, 3)), np.empty((2 * count, 3)), np.empty((count, 3, 3))
    gradient, hessian = np.empty(2 * count), np.empty((2 * count, 2 * count))
    lower = np.zeros_like(hessian)
    pose_chain(turns, length, joint, axes, frame)
    energy = _energy(turns, natural, stiffness, force, joint)
    for _ in range(MOST_STEPS):
        _slopes(turns, natural, stiffness, force, joint, axes, gradient, hessian)
        shift, unit = 0.0, 1e-3 * np.abs(np.diag(hessian)).max()
        while not _factorise(hessian, shift, lower):
            shift = max(4.0 * shift, unit)
        step = -gradient
        _solve(lower, step)
        longest = np.abs(step).max()
        step *= min(1.0, LONGEST_STEP / (longest + 1e-300))
        before = turns.copy()
        for _halving in range(30):
            turns[:] = before + step.reshape(count, 2)
            pose_chain(turns, length, joint, axes, frame)
            lowered = _energy(turns, natural, stiffness, force, joint)
            if lowered <= energy + 1e-14 * abs(energy):
                break
            step *= 0.5
        energy = min(energy, lowered)
        if np.abs(step).max() < CLOSE_ENOUGH:
            return


@njit(parallel=True, cache=True)
def settle_rays(turns, length, natural, stiffness, share, load, nudge):  # type: ignore[no-untyped-def]
    """Turns (D, R, K, 2) of equilibria along D rays of growing load (D, R, 3), N, each from the one before it.

    The load is spread over the sections by their share (K,). The first pose of a ray starts from ``turns[d, 0]``;
    ``nudge`` (D,) turns the base joint before every search, rad.
    """
    for d in prange(load.shape[0]):
        now = turns[d, 0].copy()
        force = np.empty((len(length), 3))
        for r in range(load.shape[1]):
            for i in range(len(length)):
                force[i] = share[i] * load[d, r]
            now[0, 0] += nudge[d]
            settle(now, length, natural, stiffness, force)
            turns[d, r] = now
