"""Root to leaf once more: every joint's acceleration, and with it the joint's step."""

from __future__ import annotations

import numpy as np
from numba import njit

from windswept.motion.lanes import FAST_MATH, WIDTH, clamped, load, settled, store
from windswept.motion.multibody.constants import REACH
from windswept.motion.multibody.descend import RECORD
from windswept.motion.multibody.joint import within_stop
from windswept.motion.registers import load3, store3
from windswept.motion.rotation import add_scaled, cross, dot

_F = np.float32
_W = np.uintp(WIDTH)
_THREE = np.uintp(3 * WIDTH)

MOTION = np.uintp(9 * WIDTH)
"""Scratch of a depth: angular acceleration, the joint's acceleration, direction of the link (3 each)."""


@njit(fastmath=FAST_MATH, forceinline=True)
def advance(c, depth, joints, carried, a, motions, rules):  # type: ignore[no-untyped-def]
    """Steps all joints."""
    three = _THREE
    for i in range(len(depth)):
        link = np.uintp(i)
        record = link * RECORD
        above = motions + np.uintp(depth[link]) * MOTION
        spin, b_above = load3(a, above), load3(a, above + three + three)
        pull = add_scaled(load3(a, above + three), cross(spin, b_above), c[link, REACH])
        answer = record + three * np.uintp(3)
        rise_1 = load(a, answer + three * np.uintp(4))
        rise_2 = load(a, answer + three * np.uintp(4) + _W)
        rise_1 = rise_1 - dot(load3(a, answer), spin) - dot(load3(a, answer + three), pull)
        answer += three + three
        rise_2 = rise_2 - dot(load3(a, answer), spin) - dot(load3(a, answer + three), pull)
        spin = add_scaled(spin, load3(a, record + three), rise_1)
        spin = add_scaled(spin, load3(a, record + three + three), rise_2)
        here = above + MOTION
        store3(a, here, spin)
        store3(a, here + three, pull)
        b = load3(a, record)
        store3(a, here + three + three, b)
        kept = link * _W * np.uintp(6)
        gain(carried, kept, pull, rules)
        gain(carried, kept + three, cross(spin, b), rules)
        joint = link * _W * np.uintp(4)
        _move(joints, joint, rise_1, rules)
        _move(joints, joint + _W + _W, rise_2, rules)


@njit(fastmath=FAST_MATH, forceinline=True)
def gain(carried, at, acceleration, rules):  # type: ignore[no-untyped-def]
    """A carried velocity gains by an acceleration."""
    v = add_scaled(load3(carried, at), acceleration, rules.step)
    least = rules.rest_threshold
    store3(carried, at, (settled(v[0], least), settled(v[1], least), settled(v[2], least)))


@njit(fastmath=FAST_MATH, forceinline=True)
def _move(joints, at, rise, rules):  # type: ignore[no-untyped-def]
    """One angle and its rate by an acceleration that is held over the step; see RATE_LEAD and STOP_EDGE."""
    angle, rate = load(joints, at), load(joints, at + _W)
    gained = rise * rules.ahead
    after = angle + (rate + gained) * rules.step
    edge = clamped(after, rules.stop_edge)
    deeper = clamped(after, rules.most_angle) - edge
    after = edge + deeper * within_stop(angle - clamped(angle, rules.stop_angle))
    store(joints, at, settled(after, rules.rest_threshold))
    store(joints, at + _W, settled(rate + gained + gained * rules.rate_lead, rules.rest_threshold))
