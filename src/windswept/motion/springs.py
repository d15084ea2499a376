"""`springs`: every joint on two angular springs, each its own oscillator driven by what hangs on it (Beaudoin).

One step, for one placement::

    pose    root to leaf   rotation and place of every link from the joint angles, half a step ahead: a force that
                           depends on place then neither feeds nor drains the motion
    drag                   force of the wind on the link, from the air's velocity relative to it
    load    leaf to root   force F and moment M of everything beyond the joint
    joint                  towards the angle compliance x torque, by the exact damped-oscillator step
    modes                  what of that motion lies in the lowest modes of the plant is made to go as they do: modal.py

`springs_plain.py` is the same in NumPy for one placement, and the tests hold the two together.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import get_num_threads, get_thread_id, njit, prange

from windswept.motion.groups import air_of_group, swing_group
from windswept.motion.lanes import FAST_MATH, WIDTH, at_least, clamped, load, settled, sqrt, store
from windswept.motion.level import Level
from windswept.motion.modal import MODE_COUNT
from windswept.motion.model import (
    ATTACH,
    AXIS_1,
    AXIS_2,
    COMPLIANCE_1,
    COMPLIANCE_2,
    DRAG_CENTRE,
    DRAG_LEAF,
    DRAG_WOOD,
    HALF_STEP,
    INVERSE_SQUARE,
    MOBILITY,
    OFFSET,
    PROPAGATION,
    STEP_VV,
    STEP_VX,
    STEP_XV,
    STEP_XX,
    TENSION,
    VECTOR,
)
from windswept.motion.registers import constant3, load3, load4, store3, tensor_times
from windswept.motion.rotation import (
    add_scaled,
    cross,
    dot,
    from_rotation_vector,
    multiply,
    rotate,
    rotate_back,
)
from windswept.motion.shapes import MAX_ANGLE
from windswept.motion.state import State
from windswept.plants.air import reconfiguration
from windswept.plants.plant import Floats, Ints

REST_THRESHOLD = 1e-9
"""Angles (rad) and velocities (rad/s) below this are put to rest: dying motion must not end in denormals."""

_F = np.float32
_W = np.uintp(WIDTH)
_RECORD = np.uintp(13 * WIDTH)
"""Scratch of a link: rotation (4), joint (3), force (3), moment about the origin (3)."""
_SLOT = np.uintp(12 * WIDTH)
"""Scratch of a depth: angular velocity, joint velocity, link vector, its rate (3 each)."""
_SUM = np.uintp(6 * WIDTH)
"""Scratch of a depth: summed force and moment of the links hanging there."""
_EACH: Any = np.uintp(MODE_COUNT * WIDTH)
_MODES = 4 * MODE_COUNT * WIDTH
"""Scratch of the modes: sums over the joints of deviation, deviation x w, rate and rate x c, each for every mode."""
_THRESHOLD: Any = _F(REST_THRESHOLD)
_LIMIT: Any = _F(MAX_ANGLE)
_STOP: Any = _F(2.0 * MAX_ANGLE)
_ONE: Any = _F(1.0)
_TINY = _F(1e-30)


@njit(fastmath=FAST_MATH, forceinline=True)
def drag_force(c, link, wind, v, d):  # type: ignore[no-untyped-def]
    """Force on a link: wind (velocity and leaf reconfiguration), velocity v of the drag centre, link vector d."""
    u = add_scaled(wind, v, _F(-1.0))
    speed = sqrt(dot(u, u) + _TINY)
    u = add_scaled(wind, v, _F(-1.0) / (_F(1.0) + speed * c[link, MOBILITY]))
    leaf = tensor_times(c, link, DRAG_LEAF, u)
    across = add_scaled(u, d, dot(d, u) * (-c[link, INVERSE_SQUARE]))
    f, w = speed * wind[3], speed * c[link, DRAG_WOOD]
    return leaf[0] * f + across[0] * w, leaf[1] * f + across[1] * w, leaf[2] * f + across[2] * w


@njit(fastmath=FAST_MATH, forceinline=True)
def oscillate(c, link, torque, angle, velocity, compliance, tension):  # type: ignore[no-untyped-def]
    """The exact step of one spring towards compliance x torque, at most MAX_ANGLE; and how far from there it gets.

    ``tension`` is 1 but in storms, where the pull of the air on a limp branch is a stiffer spring than its wood:
    then it slows the way to the equilibrium, and does not move the equilibrium.
    """
    y = (angle - clamped(torque * compliance, _LIMIT)) / tension
    target = angle - y
    moved = target + y * c[link, STEP_XX] + velocity * c[link, STEP_XV]
    swung = y * c[link, STEP_VX] + velocity * c[link, STEP_VV]
    angle = settled(clamped(moved, _STOP), _THRESHOLD)
    return angle, settled(swung, _THRESHOLD), angle - target


@njit(fastmath=FAST_MATH, forceinline=True)
def _pose_and_drag(  # type: ignore[no-untyped-def]
    c, depth, probe, g, group_start, group_probe, joints, groups, wind, a, slots
):
    """Root to leaf: swings the groups; writes rotation, place, force and moment of every link into ``a``."""
    zero = load(wind, np.uintp(0)) * _F(0.0)
    still = (zero, zero, zero)
    for k in range(group_start[0], group_start[1]):
        ground = ((zero, zero, zero, zero + _F(1.0)), still, still, still)
        swing_group(g, k, air_of_group(wind, group_probe[k]), groups, ground)
    one, three, six, nine = _W, _W * np.uintp(3), _W * np.uintp(6), _W * np.uintp(9)
    four, seven, ten = _W * np.uintp(4), _W * np.uintp(7), _W * np.uintp(10)
    for i in range(len(depth)):
        link = np.uintp(i)
        joint = link * four
        above = slots + np.uintp(depth[link]) * _SLOT
        here = above + _SLOT
        first, second = constant3(c, link, AXIS_1), constant3(c, link, AXIS_2)
        rate_1, rate_2 = load(joints, joint + one), load(joints, joint + three)
        angle_1 = load(joints, joint) + rate_1 * c[link, HALF_STEP]
        angle_2 = load(joints, joint + one + one) + rate_2 * c[link, HALF_STEP]
        turn = (
            angle_1 * first[0] + angle_2 * second[0],
            angle_1 * first[1] + angle_2 * second[1],
            angle_1 * first[2] + angle_2 * second[2],
        )
        rate = (
            rate_1 * first[0] + rate_2 * second[0],
            rate_1 * first[1] + rate_2 * second[1],
            rate_1 * first[2] + rate_2 * second[2],
        )
        parent_record = np.uintp(probe[link, 1]) * _RECORD
        q_parent = load4(a, parent_record)
        q = multiply(q_parent, from_rotation_vector(turn))
        spin = add_scaled(load3(a, above), rotate(q_parent, rate), _F(1.0))
        d = rotate(q, constant3(c, link, VECTOR))
        d_rate = cross(spin, d)
        offset = constant3(c, link, OFFSET)
        x = add_scaled(load3(a, parent_record + four), load3(a, above + six), c[link, ATTACH])
        x = (x[0] + offset[0], x[1] + offset[1], x[2] + offset[2])
        v = add_scaled(load3(a, above + three), load3(a, above + nine), c[link, ATTACH])
        store3(a, here, spin)
        store3(a, here + three, v)
        store3(a, here + six, d)
        store3(a, here + nine, d_rate)
        air = load4(wind, np.uintp(probe[link, 0]) * four)
        force = drag_force(c, link, air, add_scaled(v, d_rate, c[link, DRAG_CENTRE]), d)
        moment = cross(add_scaled(x, d, c[link, DRAG_CENTRE]), force)
        for k in range(group_start[i + 1], group_start[i + 2]):
            on_group = swing_group(g, k, air_of_group(wind, group_probe[k]), groups, (q, x, spin, v))
            force = add_scaled(force, on_group[0], _F(1.0))
            moment = add_scaled(moment, on_group[1], _F(1.0))
        record = (link + np.uintp(1)) * _RECORD
        store3(a, record, q)
        store(a, record + three, q[3])
        store3(a, record + four, x)
        store3(a, record + seven, force)
        store3(a, record + ten, moment)


@njit(fastmath=FAST_MATH, forceinline=True)
def _load_and_swing(  # type: ignore[no-untyped-def]
    c, depth, probe, modal_link, modal_torque, modal_own, joints, a, sums, modal
):
    """Leaf to root: sums force and moment of every subtree, steps its joint, and projects it on the modes."""
    three, four = _W * np.uintp(3), _W * np.uintp(4)
    for k in range(4 * MODE_COUNT):
        store(a, modal + np.uintp(k) * _W, load(joints, np.uintp(0)) * _F(0.0))
    k = len(modal_link) - 1
    for i in range(len(depth)):
        link = np.uintp(len(depth) - 1 - i)
        record = (link + np.uintp(1)) * _RECORD
        here = sums + np.uintp(depth[link]) * _SUM
        beyond = here + _SUM
        force = add_scaled(load3(a, record + _W * np.uintp(7)), load3(a, beyond), _F(1.0))
        moment = add_scaled(load3(a, record + _W * np.uintp(10)), load3(a, beyond + three), _F(1.0))
        zero = force[0] * _F(0.0)
        store3(a, beyond, (zero, zero, zero))
        store3(a, beyond + three, (zero, zero, zero))
        pass_on = c[link, PROPAGATION]
        store3(a, here, add_scaled(load3(a, here), force, pass_on))
        store3(a, here + three, add_scaled(load3(a, here + three), moment, pass_on))
        arm = cross(load3(a, record + four), force)
        torque = rotate_back(load4(a, np.uintp(probe[link, 1]) * _RECORD), add_scaled(moment, arm, _F(-1.0)))
        tension = at_least(sqrt(dot(force, force) + _TINY) * c[link, TENSION], _ONE)
        joint = link * four
        bend_1, bend_2 = dot(torque, constant3(c, link, AXIS_1)), dot(torque, constant3(c, link, AXIS_2))
        x_1, v_1, x_2, v_2 = load4(joints, joint)
        angle_1, rate_1, y_1 = oscillate(c, link, bend_1, x_1, v_1, c[link, COMPLIANCE_1], tension)
        angle_2, rate_2, y_2 = oscillate(c, link, bend_2, x_2, v_2, c[link, COMPLIANCE_2], tension)
        store3(joints, joint, (angle_1, rate_1, angle_2))
        store(joints, joint + three, rate_2)
        if k >= 0 and modal_link[k] == len(depth) - 1 - i:
            w, damping = modal_own[k, 0], modal_own[k, 1]
            for r in range(MODE_COUNT):
                t_1, t_2, at = modal_torque[k, 0, r], modal_torque[k, 1, r], modal + np.uintp(r) * _W
                y, v = y_1 * t_1 + y_2 * t_2, rate_1 * t_1 + rate_2 * t_2
                store(a, at, load(a, at) + y)
                store(a, at + _EACH, load(a, at + _EACH) + y * w)
                store(a, at + _EACH + _EACH, load(a, at + _EACH + _EACH) + v)
                store(a, at + _EACH + _EACH + _EACH, load(a, at + _EACH + _EACH + _EACH) + v * damping)
            k -= 1


@njit(fastmath=FAST_MATH, forceinline=True)
def _row_times(gain, which, r, v):  # type: ignore[no-untyped-def]
    """Row of a matrix of the modes times four registers."""
    row = gain[which, r]
    return v[0] * row[0] + v[1] * row[1] + v[2] * row[2] + v[3] * row[3]


@njit(fastmath=FAST_MATH, forceinline=True)
def _share_out(gain, a, modal):  # type: ignore[no-untyped-def]
    """From the sums over the joints: what every mode adds to all joints, and its deviation and rate."""
    for half in range(2):
        first = modal + np.uintp(2 * half) * _EACH
        together, each = load4(a, first), load4(a, first + _EACH)
        for r in range(MODE_COUNT):
            at = first + np.uintp(r) * _W
            store(a, at, _row_times(gain, 1 + half, r, together) - _row_times(gain, 0, r, each))
            store(a, at + _EACH, _row_times(gain, 0, r, together))


@njit(fastmath=FAST_MATH, forceinline=True)
def _kick(c, modal_link, modal_torque, modal_own, time_step, joints, a, modal):  # type: ignore[no-untyped-def]
    """Changes the rates of all joints that take part by what the modes ask of them."""
    for k in range(len(modal_link)):
        joint = np.uintp(modal_link[k]) * _W * np.uintp(4) + _W
        for axis in range(2):
            push = load(a, modal) * _F(0.0)
            for r in range(MODE_COUNT):
                at = modal + np.uintp(r) * _W
                whole = load(a, at) + load(a, at + _EACH + _EACH)
                own = (
                    load(a, at + _EACH) * modal_own[k, 0]
                    + load(a, at + _EACH + _EACH + _EACH) * modal_own[k, 1]
                )
                push = push + (own - whole) * modal_torque[k, axis, r]
            rate = load(joints, joint) + push * (time_step * c[np.uintp(modal_link[k]), COMPLIANCE_1 + axis])
            store(joints, joint, settled(rate, _THRESHOLD))
            joint += _W + _W


@njit(fastmath=FAST_MATH, parallel=True, cache=True)
def _step_tiles(  # type: ignore[no-untyped-def]
    c,
    depth,
    probe,
    g,
    group_start,
    group_probe,
    modal_link,
    modal_torque,
    modal_own,
    modal_gain,
    time_step,
    joints,
    groups,
    wind,
    scratch,
    sum_start,
    modal_start,
    first,
    last,
    interval,
):
    """Inner steps first..last of an interval over which the wind goes linearly from wind[t, 0] to wind[t, 1]."""
    slots = np.uintp(len(depth) + 1) * _RECORD
    sums, modal = np.uintp(sum_start), np.uintp(modal_start)
    for tile in prange(joints.shape[0]):
        a = scratch[get_thread_id()]
        now = a[a.size - wind.shape[2] :]
        for step in range(first, last):
            late = _F((step + 1.0) / interval)
            now[:] = wind[tile, 0] + late * (wind[tile, 1] - wind[tile, 0])
            _pose_and_drag(
                c, depth, probe, g, group_start, group_probe, joints[tile], groups[tile], now, a, slots
            )
            _load_and_swing(
                c, depth, probe, modal_link, modal_torque, modal_own, joints[tile], a, sums, modal
            )
            if len(modal_link) > 0:
                _share_out(modal_gain, a, modal)
                _kick(c, modal_link, modal_torque, modal_own, time_step, joints[tile], a, modal)


def _scratch(level: Level) -> tuple[Floats, int, int]:
    """Per-thread scratch with the ground's record and slot at rest, and where the sums and the modes begin."""
    depths = int(level.depth.max(initial=0)) + 3
    sum_start = (level.link_count + 1) * int(_RECORD) + depths * int(_SLOT)
    modal_start = sum_start + depths * int(_SUM)
    size = modal_start + _MODES + 4 * len(level.probe_position) * WIDTH
    scratch = np.zeros((get_num_threads(), size), np.float32)
    scratch[:, 3 * WIDTH : 4 * WIDTH] = 1.0
    return scratch, sum_start, modal_start


class Stepper:
    """Steps states of one level; owns the scratch memory that the kernel works in."""

    def __init__(self, level: Level) -> None:
        self.level = level
        self._probe_and_parent: Ints = np.column_stack([level.probe, level.parent + 1]).astype(np.int32)
        self._scratch, self._sum_start, self._modal_start = _scratch(level)

    def step(
        self,
        state: State,
        wind_before: Floats,
        wind_after: Floats,
        substeps: int = 1,
        taken: int = 0,
        interval: int | None = None,
    ) -> State:
        """Advances a state by ``substeps`` inner steps, each ``level.time_step`` long.

        The winds are those at the two ends of an interval of ``interval`` inner steps, of which ``taken`` were
        stepped before; in between the wind changes linearly.

        Args:
            state: stepped in place and returned.
            wind_before: (P, B, 3) air velocity at the probes in the plant's frame, m/s.
            wind_after: the same at the interval's end.
            substeps: number of inner steps to take now.
            taken: number of the interval's steps taken earlier.
            interval: number of inner steps between the two winds; None for ``substeps``.
        """
        level, tiles = self.level, len(state.joints)
        wind = np.stack([pack_wind(level, wind_before), pack_wind(level, wind_after)], axis=1)
        _step_tiles(
            level.constants,
            level.depth,
            self._probe_and_parent,
            level.group_constants,
            level.group_start,
            level.group_probe,
            level.modes.link,
            level.modes.torque,
            level.modes.own,
            level.modes.gain,
            np.float32(level.modes.time_step),
            state.joints.reshape(tiles, -1),
            state.groups.reshape(tiles, -1),
            wind,
            self._scratch,
            self._sum_start,
            self._modal_start,
            taken,
            taken + substeps,
            float(interval or substeps),
        )
        state.step_count += substeps
        return state


def pack_wind(level: Level, wind: Floats) -> Floats:
    """(T, B * 4 * WIDTH) probe winds as the kernel reads them: velocity and leaf reconfiguration, lanes fastest."""
    placements, probes, _ = wind.shape
    tiles = -(-placements // WIDTH)
    packed = np.zeros((tiles * WIDTH, probes, 4), np.float32)
    packed[:placements, :, :3] = wind
    packed[:placements, :, 3] = reconfiguration(level.material, np.linalg.norm(wind, axis=2))
    lanes_last = packed.reshape(tiles, WIDTH, probes, 4).transpose(0, 2, 3, 1)
    return np.ascontiguousarray(lanes_last).reshape(tiles, -1)
