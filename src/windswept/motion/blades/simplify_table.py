"""simplify_table: the same blade with fewer sections, its tip where it was.

Endo drops vectors with distance, which moves the tip and the centre of mass (PHYSICS C2.15). No one stiffness mends
that over all forces, as a bent curve reaches less far than the few straight sections that stand for it. But in a table
every load may have its own: the joints of each pose are turned until the tip is where the finer blade has it, and the
other joints as near as that allows. What moves the blade (its lean, frequency and drag) does not change at all.
"""

from __future__ import annotations

import numpy as np
from numba import njit, prange

from windswept.errors import InputError
from windswept.motion.blades.newton import factorise, pose_chain, solve
from windswept.motion.blades.pose_table import PoseTable
from windswept.motion.rods import Doubles

INNER_WEIGHT = 0.03
"""How much a joint between counts beside the tip."""
FIT_STEPS = 12
DAMPING = 1e-7
"""Of the fit, over the sum of its squares: a straight blade leaves the way of its inner joints open."""


def simplify_table(table: PoseTable, sections: int) -> PoseTable:
    """Table of the same kind with fewer sections.

    Args:
        table: of the finer blade.
        sections: 2 or more, and no more than the finer blade has.

    Raises:
        InputError: another number of sections.
    """
    if not 2 <= sections <= table.section_count:
        raise InputError("simplify", "sections", sections, f"2 to {table.section_count}")
    fine = table.length.astype(np.float64)
    along = np.concatenate([[0.0], np.cumsum(fine)])
    ends = np.linspace(0.0, along[-1], sections + 1)
    length = np.diff(ends)
    poses = table.turns.reshape(-1, table.section_count, 2).astype(np.float64)
    turns = np.empty((len(poses), sections, 2))
    _fit(poses, fine, along, length, ends, turns)
    shape = (*table.turns.shape[:3], sections, 2)
    return PoseTable(turns.reshape(shape).astype(np.float32), length.astype(np.float32))


@njit(cache=True, parallel=True)
def _fit(poses, fine, along, length, ends, turns):  # type: ignore[no-untyped-def]
    for pose in prange(len(poses)):
        _fit_one(poses[pose], fine, along, length, ends, turns[pose])


@njit(cache=True)
def _fit_one(pose, fine, along, length, ends, turns):  # type: ignore[no-untyped-def]
    """Turns (M, 2) of sections that end at places ``ends`` along the finer blade's pose."""
    count = len(fine)
    joint, axes, frame = np.empty((count + 1, 3)), np.empty((2 * count, 3)), np.empty((count, 3, 3))
    pose_chain(pose, fine, joint, axes, frame)
    target = np.empty((len(ends), 3))
    section = 0
    for i in range(len(ends)):
        while section < count - 1 and along[section + 1] < ends[i]:
            section += 1
        part = (ends[i] - along[section]) / fine[section]
        for a in range(3):
            target[i, a] = joint[section, a] + part * (joint[section + 1, a] - joint[section, a])
    _aim(target, turns)
    _pull(target, length, turns)


@njit(cache=True)
def _aim(target: Doubles, turns: Doubles) -> None:
    """Turns (M, 2) that point every section at its end (M + 1, 3)."""
    t, n, s = np.zeros(3), np.zeros(3), np.zeros(3)
    t[0] = n[1] = s[2] = 1.0
    for i in range(len(turns)):
        ahead, bent, aside = 0.0, 0.0, 0.0
        for a in range(3):
            chord = target[i + 1, a] - target[i, a]
            ahead, bent, aside = ahead + chord * t[a], bent + chord * n[a], aside + chord * s[a]
        turns[i, 0], turns[i, 1] = np.arctan2(bent, ahead), np.arctan2(aside, np.hypot(ahead, bent))
        flat_cosine, flat_sine = np.cos(turns[i, 0]), np.sin(turns[i, 0])
        side_cosine, side_sine = np.cos(turns[i, 1]), np.sin(turns[i, 1])
        for a in range(3):
            ahead = t[a] * flat_cosine + n[a] * flat_sine
            n[a] = n[a] * flat_cosine - t[a] * flat_sine
            t[a] = ahead * side_cosine + s[a] * side_sine
            s[a] = s[a] * side_cosine - ahead * side_sine


@njit(cache=True)
def _pull(target: Doubles, length: Doubles, turns: Doubles) -> None:
    """Gauss and Newton's steps that bring the tip, and the joints as far as they can, to their targets (M + 1, 3)."""
    count = len(length)
    joint, axes, frame = np.empty((count + 1, 3)), np.empty((2 * count, 3)), np.empty((count, 3, 3))
    slope, normal = np.empty((3, 2 * count)), np.empty((2 * count, 2 * count))
    lower, step = np.zeros((2 * count, 2 * count)), np.empty(2 * count)
    for _ in range(FIT_STEPS):
        pose_chain(turns, length, joint, axes, frame)
        normal[:], step[:] = 0.0, 0.0
        for j in range(1, count + 1):
            weight = 1.0 if j == count else INNER_WEIGHT**2
            for i in range(2 * j):
                for a in range(3):
                    b, c = (a + 1) % 3, (a + 2) % 3
                    slope[a, i] = axes[i, b] * (joint[j, c] - joint[i // 2, c])
                    slope[a, i] -= axes[i, c] * (joint[j, b] - joint[i // 2, b])
                    step[i] += weight * slope[a, i] * (target[j, a] - joint[j, a])
                for k in range(i + 1):
                    value = slope[0, i] * slope[0, k] + slope[1, i] * slope[1, k] + slope[2, i] * slope[2, k]
                    normal[i, k] += weight * value
        # Cholesky's factor reads the lower half only.
        factorise(normal, DAMPING * np.trace(normal), lower)
        solve(lower, step)
        for i in range(2 * count):
            turns[i // 2, i % 2] += step[i]
