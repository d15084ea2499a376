"""Root to leaf: where every link is ``ahead`` of the step's beginning, how it moves, and the force and moment on it.

The force is what takes the link's mass from the velocity that it carries to the one that its joints' rates give it
where they will stand, within ``ahead`` (51 % of the warped step at 120 a second), less the drag. Centrifugal and
gyroscopic terms are in that difference. World-aligned axes at each joint: nothing is rotated from link to link.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from windswept.motion.groups import air_of_group, swing_group
from windswept.motion.lanes import FAST_MATH, WIDTH, clamped, load, sqrt, store
from windswept.motion.level import CENTRE
from windswept.motion.multibody.constants import (
    AXIS_1,
    AXIS_2,
    DRAG_LEAF,
    DRAG_WOOD,
    INERTIA,
    LEVER,
    MASS,
    MOMENT,
    REACH,
)
from windswept.motion.multibody.joint import half_turn, joint_axes
from windswept.motion.registers import constant3, load3, load4, store3, tensor_times
from windswept.motion.rotation import add_scaled, cross, dot, multiply, rotate

_F = np.float32
_W = np.uintp(WIDTH)
_TINY = _F(1e-30)

RECORD = np.uintp(24 * WIDTH)
"""Scratch of a link: direction, both joint axes (3 each); then first force, moment (3 each), drag of leaves and of wood
per velocity (1 each), pull (3), strain (1), growth of the drag (3), later both rows of the joint's answer (6 each) and
its own acceleration (2)."""
PULL, STRAIN, GROWTH = np.uintp(17 * WIDTH), np.uintp(20 * WIDTH), np.uintp(21 * WIDTH)
"""Places in a record: force of the air on a link and its groups, N; what it stiffens the link by, N m; see ``drag``."""
SLOT = np.uintp(13 * WIDTH)
"""Scratch of a depth: rotation (4), angular velocity, joint velocity, rate of the direction (3 each)."""


@njit(fastmath=FAST_MATH, forceinline=True)
def length(v):  # type: ignore[no-untyped-def]
    """Of a vector."""
    return sqrt(dot(v, v) + _TINY)


@njit(fastmath=FAST_MATH, forceinline=True)
def drag(c, link, air, v, b):  # type: ignore[no-untyped-def]
    """Force of the air on a link with direction b and velocity v at its drag centre; drag over velocity of its leaves'
    tensor and of its wood; the vector whose square is what drag per velocity gains by growing with speed; and what the
    force stiffens the link by over its lever.

    Of F = |u| T u the first derivative is |u| T and F u^T / |u|, of which the symmetric part's positive part is taken:
    |F| / |u| times the square of half of F / |F| + u / |u|. Wood is blown across alone, so its force turns back a link
    that points downwind, by the square of the wind along it.
    """
    u = add_scaled(air, v, _F(-1.0))
    speed = length(u)
    leaf, wood = speed * air[3], speed * c[link, DRAG_WOOD]
    along = dot(b, u)
    on_leaf, on_wood = tensor_times(c, link, DRAG_LEAF, u), add_scaled(u, b, -along)
    force = (
        on_leaf[0] * leaf + on_wood[0] * wood,
        on_leaf[1] * leaf + on_wood[1] * wood,
        on_leaf[2] * leaf + on_wood[2] * wood,
    )
    size = length(force)
    half = sqrt(size / speed) * _F(0.5)
    per_force, per_speed = half / size, half / speed
    growth = (
        force[0] * per_force + u[0] * per_speed,
        force[1] * per_force + u[1] * per_speed,
        force[2] * per_force + u[2] * per_speed,
    )
    return force, leaf, wood, growth, dot(force, b) + along * wood


@njit(fastmath=FAST_MATH, forceinline=True)
def combined(frame, v):  # type: ignore[no-untyped-def]
    """Vector with components v along the three vectors of a frame."""
    return add_scaled(
        add_scaled((frame[0][0] * v[0], frame[0][1] * v[0], frame[0][2] * v[0]), frame[1], v[1]),
        frame[2],
        v[2],
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def turn_joint(c, link, joints, rules, a, above, here):  # type: ignore[no-untyped-def]
    """Turns a link's joint: writes its rotation; gives its direction, axes and rate of turn in the world."""
    joint = link * _W * np.uintp(4)
    rate_1, rate_2 = load(joints, joint + _W), load(joints, joint + _W * np.uintp(3))
    angle_1 = clamped(load(joints, joint) + rate_1 * rules.ahead, rules.most_angle)
    angle_2 = clamped(load(joints, joint + _W + _W) + rate_2 * rules.ahead, rules.most_angle)
    x = angle_1 * angle_1 + angle_2 * angle_2
    s, cosine = half_turn(x)
    first, second = constant3(c, link, AXIS_1), constant3(c, link, AXIS_2)
    q = load4(a, above)
    world_1, world_2 = rotate(q, first), rotate(q, second)
    frame = (world_1, world_2, cross(world_1, world_2))
    one, two = angle_1 * s, angle_2 * s
    q = multiply(
        q,
        (
            one * first[0] + two * second[0],
            one * first[1] + two * second[1],
            one * first[2] + two * second[2],
            cosine,
        ),
    )
    store3(a, here, q)
    store(a, here + _W * np.uintp(3), q[3])
    sine = (s + s) * cosine
    b = combined(frame, (angle_2 * sine, -(angle_1 * sine), _F(1.0) - (x + x) * s * s))
    axis_1, axis_2 = joint_axes(angle_1, angle_2, x, s)
    axis_1, axis_2 = combined(frame, axis_1), combined(frame, axis_2)
    turning = (
        axis_1[0] * rate_1 + axis_2[0] * rate_2,
        axis_1[1] * rate_1 + axis_2[1] * rate_2,
        axis_1[2] * rate_1 + axis_2[2] * rate_2,
    )
    return b, axis_1, axis_2, turning


@njit(fastmath=FAST_MATH, forceinline=True)
def carry(carried, at, now, per_ahead, beyond):  # type: ignore[no-untyped-def]
    """Acceleration from a link's carried velocity to the one that its joints' rates give it where they now stand.

    Leaves in ``carried`` the velocity as far beyond that as the old one was behind; ``advance`` adds the joints' gain.
    """
    old = load3(carried, at)
    behind = add_scaled(now, old, _F(-1.0))
    store3(carried, at, add_scaled(old, behind, beyond))
    return behind[0] * per_ahead, behind[1] * per_ahead, behind[2] * per_ahead


@njit(fastmath=FAST_MATH, forceinline=True)
def weigh(c, link, b, pull, b_pull, drag_force):  # type: ignore[no-untyped-def]
    """Force and moment that take a link's mass from its carried velocities to those of the joints, less the drag.

    Args:
        c: constants.
        link: which.
        b: its direction.
        pull: what its joint's velocity in the joints' motion is beyond the carried one, over ``ahead``.
        b_pull: that of its direction.
        drag_force: at its drag centre.
    """
    mass, first, second, lever = c[link, MASS], c[link, MOMENT], c[link, INERTIA], c[link, LEVER]
    force = (
        pull[0] * mass + b_pull[0] * first - drag_force[0],
        pull[1] * mass + b_pull[1] * first - drag_force[1],
        pull[2] * mass + b_pull[2] * first - drag_force[2],
    )
    arm = (
        pull[0] * first + b_pull[0] * second - drag_force[0] * lever,
        pull[1] * first + b_pull[1] * second - drag_force[1] * lever,
        pull[2] * first + b_pull[2] * second - drag_force[2] * lever,
    )
    return force, cross(b, arm)


@njit(fastmath=FAST_MATH, forceinline=True)
def groups_on(crowd, first, last, groups, wind, a, here, spin, v):  # type: ignore[no-untyped-def]
    """Swings a range of groups; gives their force and moment about the joint of the link that carries them, and the
    sum of every force along its lever.

    Args:
        crowd: constants of the groups, and their probes.
        first: of the groups.
        last: behind the last of them.
        groups: pressure and rate of all groups, updated.
        wind: air velocity and leaf reconfiguration at the probes.
        a: scratch.
        here: slot with the carrier's rotation.
        spin: angular velocity of the carrier.
        v: velocity of its joint.
    """
    g, group_probe = crowd
    zero = spin[0] * _F(0.0)
    force, moment, strain = (zero, zero, zero), (zero, zero, zero), zero
    q = load4(a, here)
    for k in range(first, last):
        on = swing_group(g, k, air_of_group(wind, group_probe[k]), groups, (q, (zero, zero, zero), spin, v))
        force, moment = add_scaled(force, on[0], _F(1.0)), add_scaled(moment, on[1], _F(1.0))
        strain = strain + dot(on[0], rotate(q, constant3(g, k, CENTRE)))
    return force, moment, strain


@njit(fastmath=FAST_MATH, forceinline=True)
def descend(  # type: ignore[no-untyped-def]
    c, depth, probe, crowd, group_start, joints, groups, carried, wind, a, slots, rules
):
    """Writes the record of every link, as the way from leaf to root reads it.

    Args:
        c: constants.
        depth: of every link.
        probe: of every link.
        crowd: constants of the groups, and their probes.
        group_start: which of them hang on each link.
        joints: angles and rates.
        groups: pressure and rate of all groups, updated.
        carried: velocity of every link's joint and direction as the last step left them; moved on by what follows
            from the joint rates alone.
        wind: air velocity and leaf reconfiguration at the probes.
        a: scratch.
        slots: where the slots of the depths begin.
        rules: of the step.
    """
    three, four, seven = _W * np.uintp(3), _W * np.uintp(4), _W * np.uintp(7)
    per_ahead, beyond = _F(1.0) / rules.ahead, rules.step / rules.ahead
    ground = load3(a, slots + four)
    groups_on(crowd, group_start[0], group_start[1], groups, wind, a, slots, ground, ground)
    for i in range(len(depth)):
        link = np.uintp(i)
        above = slots + np.uintp(depth[link]) * SLOT
        here = above + SLOT
        b, axis_1, axis_2, turning = turn_joint(c, link, joints, rules, a, above, here)
        spin = add_scaled(load3(a, above + four), turning, _F(1.0))
        v = add_scaled(load3(a, above + seven), load3(a, above + seven + three), c[link, REACH])
        b_rate = cross(spin, b)
        store3(a, here + four, spin)
        store3(a, here + seven, v)
        store3(a, here + seven + three, b_rate)
        kept = link * _W * np.uintp(6)
        pull = carry(carried, kept, v, per_ahead, beyond)
        b_pull = carry(carried, kept + three, b_rate, per_ahead, beyond)
        air = load4(wind, np.uintp(probe[link]) * four)
        blown, leaf, wood, growth, strain = drag(c, link, air, add_scaled(v, b_rate, c[link, LEVER]), b)
        on = groups_on(crowd, group_start[i + 1], group_start[i + 2], groups, wind, a, here, spin, v)
        force, moment = weigh(c, link, b, pull, b_pull, blown)
        force, moment = add_scaled(force, on[0], _F(-1.0)), add_scaled(moment, on[1], _F(-1.0))
        record = link * RECORD
        store3(a, record + PULL, add_scaled(blown, on[0], _F(1.0)))
        store(a, record + STRAIN, strain * c[link, LEVER] + on[2])
        store3(a, record + GROWTH, growth)
        for vector in (b, axis_1, axis_2, force, moment):
            store3(a, record, vector)
            record += three
        store(a, record, leaf)
        store(a, record + _W, wood)
