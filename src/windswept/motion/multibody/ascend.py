"""Leaf to root: the articulated inertia of everything beyond each joint, and how the joint answers to it.

Featherstone's articulated-body recursion with two rotational freedoms a joint: with S the joint's axes, U = I S,
D = S^T I S + kappa and kappa the springs' implicit part, what is passed on is I - U D^-1 U^T. The sums over a
link's children stand in one slot a depth: links are in depth-first order, so they stay in the nearest cache.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from windswept.motion.lanes import FAST_MATH, WIDTH, clamped, load, store
from windswept.motion.multibody.constants import (
    DRAG_LEAF,
    INERTIA,
    LAG,
    LEVER,
    MASS,
    MOMENT,
    PULL_WEIGHT,
    REACH,
    STIFFNESS_1,
    STIFFNESS_2,
    STOP_ANGLE,
    STOP_STIFFNESS,
)
from windswept.motion.multibody.descend import RECORD, STRAIN
from windswept.motion.multibody.tensors import (
    across,
    added,
    minus_product,
    moved,
    rise,
    summed,
    times,
    turning_of,
)
from windswept.motion.registers import constant3, load3, store3
from windswept.motion.rotation import add_scaled, cross, dot

_F = np.float32
_W = np.uintp(WIDTH)
_THREE = np.uintp(3 * WIDTH)
_ONE: Any = _F(1.0)
_TINY = _F(1e-30)
_STOP: Any = _F(STOP_ANGLE)
_HARD: Any = _F(STOP_STIFFNESS)
_AT_ONCE = _F(1e12)
_WEIGHT: Any = _F(PULL_WEIGHT)

SUM = np.uintp(29 * WIDTH)
"""Scratch of a depth: articulated inertia (turning 6, coupling 9, mass 6), force, moment (3 each), the pull of the air
and that times its lever (1 each)."""
_PULL = np.uintp(27 * WIDTH)


@njit(fastmath=FAST_MATH, forceinline=True)
def load_sum(a, i):  # type: ignore[no-untyped-def]
    """Turning, coupling and mass tensors, force and moment."""
    t, u = load3(a, i), load3(a, i + _THREE)
    rows = (
        load3(a, i + _THREE * np.uintp(2)),
        load3(a, i + _THREE * np.uintp(3)),
        load3(a, i + _THREE * np.uintp(4)),
    )
    m, n = load3(a, i + _THREE * np.uintp(5)), load3(a, i + _THREE * np.uintp(6))
    return (
        (t[0], t[1], t[2], u[0], u[1], u[2]),
        rows,
        (m[0], m[1], m[2], n[0], n[1], n[2]),
        load3(a, i + _THREE * np.uintp(7)),
        load3(a, i + _THREE * np.uintp(8)),
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def store_sum(a, to, since, turning, coupling, mass, force, moment):  # type: ignore[no-untyped-def]
    """Writes to one slot what another held plus a link's share."""
    t, h, m, f, n = load_sum(a, since)
    t, h, m = added(t, turning), summed(h, coupling), added(m, mass)
    for vector in (
        (t[0], t[1], t[2]),
        (t[3], t[4], t[5]),
        h[0],
        h[1],
        h[2],
        (m[0], m[1], m[2]),
        (m[3], m[4], m[5]),
        add_scaled(f, force, _ONE),
        add_scaled(n, moment, _ONE),
    ):
        store3(a, to, vector)
        to += _THREE


@njit(fastmath=FAST_MATH, forceinline=True)
def with_link(c, link, turning, coupling, mass, b, leaf, wood, stiff):  # type: ignore[no-untyped-def]
    """Articulated inertia beyond a joint, with the joint's own link: a thin rod, ``leaf`` and ``wood`` drag over
    velocity times the step's implicit part, which resists like a mass at the drag centre, and the inertia ``stiff``.
    """
    lever, moment = c[link, LEVER], c[link, MOMENT]
    hold = across(b, wood)
    xx, yy, zz = constant3(c, link, DRAG_LEAF)
    xy, xz, yz = constant3(c, link, DRAG_LEAF + 3)
    air = added(hold, (leaf * xx, leaf * yy, leaf * zz, leaf * xy, leaf * xz, leaf * yz))
    risen = rise(air, (b[0] * lever, b[1] * lever, b[2] * lever))
    zero = b[0] * _F(0.0)
    x, y, z = b[0] * moment, b[1] * moment, b[2] * moment
    rod = ((zero, -z, y), (z, zero, -x), (-y, x, zero))
    turning = added(turning, turning_of(risen, (b[0] * lever, b[1] * lever, b[2] * lever)))
    m = c[link, MASS]
    return (
        added(turning, across(b, stiff + c[link, INERTIA])),
        summed(summed(coupling, risen), rod),
        added(mass, (air[0] + m, air[1] + m, air[2] + m, air[3], air[4], air[5])),
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def spring(c, link, stiffness, joints, at, ahead):  # type: ignore[no-untyped-def]
    """Torque of one spring, its damper and its stop for a rate that stays, and what an acceleration adds to it."""
    lag, angle = ahead + c[link, LAG], load(joints, at)
    over = angle - clamped(angle, _STOP)
    harder = clamped(over * over * _AT_ONCE, _ONE) * _HARD
    k, lag = c[link, stiffness], (harder + _ONE) * lag
    return -(k * (angle + over * _HARD + load(joints, at + _W) * lag)), k * ahead * lag


@njit(fastmath=FAST_MATH, forceinline=True)
def through(coupling, v):  # type: ignore[no-untyped-def]
    """Transposed coupling times a vector: force per angular acceleration."""
    return (
        coupling[0][0] * v[0] + coupling[1][0] * v[1] + coupling[2][0] * v[2],
        coupling[0][1] * v[0] + coupling[1][1] * v[1] + coupling[2][1] * v[2],
        coupling[0][2] * v[0] + coupling[1][2] * v[1] + coupling[2][2] * v[2],
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def mixed(a, b, s, t):  # type: ignore[no-untyped-def]
    """``s a + t b``."""
    return a[0] * s + b[0] * t, a[1] * s + b[1] * t, a[2] * s + b[2] * t


@njit(fastmath=FAST_MATH, forceinline=True)
def yielding(c, link, joints, axis_1, axis_2, turn_1, turn_2, moment, ahead):  # type: ignore[no-untyped-def]
    """D^-1 (11, 22, 12), and both accelerations of a joint whose parent does not accelerate."""
    joint = link * _W * np.uintp(4)
    torque_1, kappa_1 = spring(c, link, STIFFNESS_1, joints, joint, ahead)
    torque_2, kappa_2 = spring(c, link, STIFFNESS_2, joints, joint + _W + _W, ahead)
    torque_1, torque_2 = torque_1 - dot(axis_1, moment), torque_2 - dot(axis_2, moment)
    d_1, d_2, d_12 = dot(axis_1, turn_1) + kappa_1, dot(axis_2, turn_2) + kappa_2, dot(axis_1, turn_2)
    per = _F(1.0) / (d_1 * d_2 - d_12 * d_12)
    e_1, e_2, e_12 = d_2 * per, d_1 * per, -(d_12 * per)
    return e_1, e_2, e_12, torque_1 * e_1 + torque_2 * e_12, torque_1 * e_12 + torque_2 * e_2


@njit(fastmath=FAST_MATH, forceinline=True)
def give_way(c, link, joints, a, record, inertia, force, moment, ahead):  # type: ignore[no-untyped-def]
    """Writes a joint's answer (both rows of D^-1 U^T, both accelerations) to its link's record; gives inertia, force
    and moment as they are felt through the joint.
    """
    turning, coupling, mass = inertia
    axis_1, axis_2 = load3(a, record + _THREE), load3(a, record + _THREE + _THREE)
    turn_1, turn_2 = times(turning, axis_1), times(turning, axis_2)
    push_1, push_2 = through(coupling, axis_1), through(coupling, axis_2)
    e_1, e_2, e_12, rise_1, rise_2 = yielding(c, link, joints, axis_1, axis_2, turn_1, turn_2, moment, ahead)
    answer_1, answer_2 = mixed(turn_1, turn_2, e_1, e_12), mixed(turn_1, turn_2, e_12, e_2)
    yield_1, yield_2 = mixed(push_1, push_2, e_1, e_12), mixed(push_1, push_2, e_12, e_2)
    rest = record + _THREE * np.uintp(3)
    for vector in (answer_1, yield_1, answer_2, yield_2):
        store3(a, rest, vector)
        rest += _THREE
    store(a, rest, rise_1)
    store(a, rest + _W, rise_2)
    turning = minus_product(minus_product(turning, answer_1, turn_1), answer_2, turn_2)
    mass = minus_product(minus_product(mass, yield_1, push_1), yield_2, push_2)
    coupling = (
        add_scaled(add_scaled(coupling[0], push_1, -answer_1[0]), push_2, -answer_2[0]),
        add_scaled(add_scaled(coupling[1], push_1, -answer_1[1]), push_2, -answer_2[1]),
        add_scaled(add_scaled(coupling[2], push_1, -answer_1[2]), push_2, -answer_2[2]),
    )
    force = add_scaled(add_scaled(force, push_1, rise_1), push_2, rise_2)
    moment = add_scaled(add_scaled(moment, turn_1, rise_1), turn_2, rise_2)
    return turning, coupling, mass, force, moment


@njit(fastmath=FAST_MATH, forceinline=True)
def stiffen(c, link, a, record, children, to, since):  # type: ignore[no-untyped-def]
    """Adds the pull of the air on a link and all beyond it to a slot; gives what it stiffens the link by, N m.

    Every force counts in full, wherever it points to: where it does not pull, what it adds is far less than the wood.
    """
    strain = load(a, record + STRAIN)
    pull = load(a, children + _PULL) + strain / (c[link, LEVER] + _TINY)
    strain = strain + load(a, children + _PULL + _W)
    to, since = to + _PULL, since + _PULL
    store(a, to, load(a, since) + pull)
    store(a, to + _W, load(a, since + _W) + pull * c[link, REACH])
    return strain


@njit(fastmath=FAST_MATH, forceinline=True)
def ascend(c, depth, source, joints, a, sums, ahead):  # type: ignore[no-untyped-def]
    """Replaces force and moment in every link's record by the joint's answer.

    Args:
        c: constants.
        depth: of every link.
        source: of every link, the slot with the sum of its children, the slot to add its own share to, its parent.
        joints: angles and rates.
        a: scratch.
        sums: where the sums begin.
        ahead: how far into the step forces are taken, s.
    """
    for i in range(len(depth)):
        link = np.uintp(len(depth) - 1 - i)
        record = link * RECORD
        rest = record + _THREE * np.uintp(3)
        children = sums + np.uintp(source[link, 0]) * SUM
        to, since = sums + np.uintp(depth[link]) * SUM, sums + np.uintp(source[link, 1]) * SUM
        turning, coupling, mass, force, moment = load_sum(a, children)
        stiff = stiffen(c, link, a, record, children, to, since) * ahead * ahead * _WEIGHT
        force = add_scaled(force, load3(a, rest), _ONE)
        moment = add_scaled(moment, load3(a, rest + _THREE), _ONE)
        leaf = load(a, rest + _THREE + _THREE) * ahead
        wood = load(a, rest + _THREE + _THREE + _W) * ahead
        inertia = with_link(c, link, turning, coupling, mass, load3(a, record), leaf, wood, stiff)
        turning, coupling, mass, force, moment = give_way(
            c, link, joints, a, record, inertia, force, moment, ahead
        )
        b, reach = load3(a, np.uintp(source[link, 2]) * RECORD), c[link, REACH]
        r = (b[0] * reach, b[1] * reach, b[2] * reach)
        turning, coupling = moved(turning, coupling, mass, r)
        moment = add_scaled(moment, cross(r, force), _ONE)
        store_sum(a, to, since, turning, coupling, mass, force, moment)
