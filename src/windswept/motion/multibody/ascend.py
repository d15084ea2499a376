"""Leaf to root: the articulated inertia of everything beyond each joint, and how the joint answers to it.

Featherstone's articulated-body recursion with two rotational freedoms a joint: with S the joint's axes, U = I S,
D = S^T I S + kappa and kappa the springs' implicit part, what is passed on is I - U D^-1 U^T. The sums over a
link's children stand in one slot a depth: links are in depth-first order, so they stay in the nearest cache.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from windswept.motion.lanes import FAST_MATH, WIDTH, at_least, clamped, load, sqrt, store
from windswept.motion.multibody.constants import (
    DRAG_LEAF,
    INERTIA,
    LAG,
    LEVER,
    MASS,
    MOMENT,
    REACH,
    STIFFNESS_1,
    STIFFNESS_2,
)
from windswept.motion.multibody.descend import GROWTH, PULL, RECORD, STRAIN
from windswept.motion.multibody.joint import within_stop
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
_ZERO: Any = _F(0.0)

SUM = np.uintp(31 * WIDTH)
"""Scratch of a depth: articulated inertia (turning 6, coupling 9, mass 6), force, moment (3 each), the pull of the air
(3) and what it stiffens the carrier by (1)."""
_PULL, _STRAIN = np.uintp(27 * WIDTH), np.uintp(30 * WIDTH)


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
def with_link(c, link, turning, coupling, mass, b, leaf, wood, growth, stiff):  # type: ignore[no-untyped-def]
    """Articulated inertia beyond a joint, with the joint's own link: a thin rod, ``leaf`` and ``wood`` drag over
    velocity times the step's implicit part, which resists like a mass at the drag centre, ``growth``, whose square adds
    to it, and the inertia ``stiff``.
    """
    lever, moment = c[link, LEVER], c[link, MOMENT]
    hold = across(b, wood)
    xx, yy, zz = constant3(c, link, DRAG_LEAF)
    xy, xz, yz = constant3(c, link, DRAG_LEAF + 3)
    air = added(hold, (leaf * xx, leaf * yy, leaf * zz, leaf * xy, leaf * xz, leaf * yz))
    air = minus_product(air, (-growth[0], -growth[1], -growth[2]), growth)
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
def spring(c, link, stiffness, joints, at, rules):  # type: ignore[no-untyped-def]
    """Torque of one spring, its damper and its stop for a rate that stays, and what an acceleration adds to it."""
    angle, rate, lag = load(joints, at), load(joints, at + _W), rules.ahead + c[link, LAG]
    over = angle - clamped(angle, rules.stop_angle)
    k, lag = c[link, stiffness], (within_stop(over) * rules.stop_stiffness + _ONE) * lag
    return -(k * (angle + over * rules.stop_stiffness + rate * lag)), k * rules.ahead * lag


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
def yielding(c, link, joints, axis_1, axis_2, turn_1, turn_2, moment, rules):  # type: ignore[no-untyped-def]
    """D^-1 (11, 22, 12), and both accelerations of a joint whose parent does not accelerate."""
    joint = link * _W * np.uintp(4)
    torque_1, kappa_1 = spring(c, link, STIFFNESS_1, joints, joint, rules)
    torque_2, kappa_2 = spring(c, link, STIFFNESS_2, joints, joint + _W + _W, rules)
    torque_1, torque_2 = torque_1 - dot(axis_1, moment), torque_2 - dot(axis_2, moment)
    d_1, d_2, d_12 = dot(axis_1, turn_1) + kappa_1, dot(axis_2, turn_2) + kappa_2, dot(axis_1, turn_2)
    per = _F(1.0) / (d_1 * d_2 - d_12 * d_12)
    e_1, e_2, e_12 = d_2 * per, d_1 * per, -(d_12 * per)
    return e_1, e_2, e_12, torque_1 * e_1 + torque_2 * e_12, torque_1 * e_12 + torque_2 * e_2


@njit(fastmath=FAST_MATH, forceinline=True)
def give_way(c, link, joints, a, record, inertia, force, moment, rules):  # type: ignore[no-untyped-def]
    """Writes a joint's answer (both rows of D^-1 U^T, both accelerations) to its link's record; gives inertia, force
    and moment as they are felt through the joint.
    """
    turning, coupling, mass = inertia
    axis_1, axis_2 = load3(a, record + _THREE), load3(a, record + _THREE + _THREE)
    turn_1, turn_2 = times(turning, axis_1), times(turning, axis_2)
    push_1, push_2 = through(coupling, axis_1), through(coupling, axis_2)
    e_1, e_2, e_12, rise_1, rise_2 = yielding(c, link, joints, axis_1, axis_2, turn_1, turn_2, moment, rules)
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
def stiffen(c, link, a, record, children, to, since, b):  # type: ignore[no-untyped-def]
    """Adds the pull of the air on a link and all beyond it to a slot of the link's carrier, which points along ``b``;
    gives what it stiffens the link by, N m.

    A pull resists the turning of a link by its component along the link times its lever; what pushes it over is left to
    the forces.
    """
    pull = add_scaled(load3(a, record + PULL), load3(a, children + _PULL), _ONE)
    strain = load(a, record + STRAIN) + load(a, children + _STRAIN)
    store3(a, to + _PULL, add_scaled(load3(a, since + _PULL), pull, _ONE))
    store(a, to + _STRAIN, load(a, since + _STRAIN) + dot(pull, b) * c[link, REACH])
    return at_least(strain, _ZERO)


@njit(fastmath=FAST_MATH, forceinline=True)
def ascend(c, depth, source, joints, a, sums, rules):  # type: ignore[no-untyped-def]
    """Replaces force and moment in every link's record by the joint's answer.

    Args:
        c: constants.
        depth: of every link.
        source: of every link, the slot with the sum of its children, the slot to add its own share to, its parent.
        joints: angles and rates.
        a: scratch.
        sums: where the sums begin.
        rules: of the step.
    """
    ahead = rules.ahead
    root = sqrt(ahead)
    for i in range(len(depth)):
        link = np.uintp(len(depth) - 1 - i)
        record = link * RECORD
        rest = record + _THREE * np.uintp(3)
        children = sums + np.uintp(source[link, 0]) * SUM
        to, since = sums + np.uintp(depth[link]) * SUM, sums + np.uintp(source[link, 1]) * SUM
        b, reach = load3(a, np.uintp(source[link, 2]) * RECORD), c[link, REACH]
        turning, coupling, mass, force, moment = load_sum(a, children)
        stiff = stiffen(c, link, a, record, children, to, since, b) * (ahead * ahead)
        stiff = stiff * (_ONE + stiff / (stiff + c[link, INERTIA] * rules.pull_knee))
        force = add_scaled(force, load3(a, rest), _ONE)
        moment = add_scaled(moment, load3(a, rest + _THREE), _ONE)
        leaf = load(a, rest + _THREE + _THREE) * ahead
        wood = load(a, rest + _THREE + _THREE + _W) * ahead
        g = load3(a, record + GROWTH)
        growth = (g[0] * root, g[1] * root, g[2] * root)
        inertia = with_link(c, link, turning, coupling, mass, load3(a, record), leaf, wood, growth, stiff)
        turning, coupling, mass, force, moment = give_way(
            c, link, joints, a, record, inertia, force, moment, rules
        )
        r = (b[0] * reach, b[1] * reach, b[2] * reach)
        turning, coupling = moved(turning, coupling, mass, r)
        moment = add_scaled(moment, cross(r, force), _ONE)
        store_sum(a, to, since, turning, coupling, mass, force, moment)
