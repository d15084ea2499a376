"""From joint angles to where every link is: the arrow from State to Pose."""

from __future__ import annotations

import numpy as np
from numba import njit, prange

from windswept.motion.lanes import FAST_MATH, WIDTH, load, store
from windswept.motion.level import Level
from windswept.motion.model import ATTACH, AXIS_1, AXIS_2, OFFSET, VECTOR, Model
from windswept.motion.registers import constant3, load3, load4, store3
from windswept.motion.rotation import add_scaled, from_rotation_vector, multiply, rotate, rotate_back
from windswept.motion.shapes import shaped
from windswept.motion.state import State
from windswept.plants.pose import Pose

_F = np.float32
_W = np.uintp(WIDTH)
_RECORD = np.uintp(10 * WIDTH)
"""Scratch of a link: joint (3), rotation (4), link vector (3)."""


def pose_links(model: Model, level: Level, state: State, ahead: float = 0.0) -> Pose:
    """Pose of all links of every placement, whatever the level that moves them.

    Args:
        model: the plant's constants.
        level: what of the plant is stepped.
        state: its motion.
        ahead: seconds since the last inner step; angles go on at their velocity, so that motion is smooth at any
            frame rate.

    """
    pose = np.zeros((state.placement_count, model.link_count, 8), np.float32)
    _pose_tiles(
        model.constants,
        model.skeleton.parent,
        level.listens,
        level.group_carrier,
        level.shapes,
        np.float32(level.shape_limit),
        state.joints.reshape(len(state.joints), -1),
        state.groups.reshape(len(state.groups), -1),
        np.float32(ahead),
        pose,
    )
    return Pose(pose)


@njit(fastmath=FAST_MATH, forceinline=True)
def _ahead(flat, i, rate, ahead):  # type: ignore[no-untyped-def]
    return load(flat, i) + load(flat, i + rate) * ahead


@njit(fastmath=FAST_MATH, forceinline=True)
def _own_angles(joints, link, ahead):  # type: ignore[no-untyped-def]
    """Both angles of a joint that is stepped itself."""
    at = np.uintp(link) * _W * np.uintp(4)
    return _ahead(joints, at, _W, ahead), _ahead(joints, at + _W + _W, _W, ahead)


@njit(fastmath=FAST_MATH, forceinline=True)
def _shared_angles(groups, group, ahead, q_carrier, q_parent, shape, limit):  # type: ignore[no-untyped-def]
    """Both angles of a joint that listens to a group: its shape under the group's pressure as its parent feels it."""
    at, rate = np.uintp(group) * _W * np.uintp(6), _W * np.uintp(3)
    u = (
        _ahead(groups, at, rate, ahead),
        _ahead(groups, at + _W, rate, ahead),
        _ahead(groups, at + _W + _W, rate, ahead),
    )
    return shaped(shape, rotate_back(q_parent, rotate(q_carrier, u)), limit)


@njit(fastmath=FAST_MATH, parallel=True, cache=True)
def _pose_tiles(  # type: ignore[no-untyped-def]
    c, parent, listens, carrier, shapes, limit, joints, groups, ahead, pose
):
    tiles, count = joints.shape[0], len(parent)
    for tile in prange(tiles):
        a = np.zeros((count + 1) * 10 * WIDTH, np.float32)
        a[6 * WIDTH : 7 * WIDTH] = _F(1.0)
        placements = min(WIDTH, len(pose) - tile * WIDTH)
        for i in range(count):
            link = np.uintp(i)
            above = np.uintp(parent[i] + 1) * _RECORD
            here = (link + np.uintp(1)) * _RECORD
            first, second = constant3(c, link, AXIS_1), constant3(c, link, AXIS_2)
            q_parent = load4(a, above + _W * np.uintp(3))
            if listens[i] >= 0:
                angle_1, angle_2 = _own_angles(joints[tile], listens[i], ahead)
            else:
                group = -1 - listens[i]
                q_carrier = load4(a, np.uintp(carrier[group] + 1) * _RECORD + _W * np.uintp(3))
                angle_1, angle_2 = _shared_angles(
                    groups[tile], group, ahead, q_carrier, q_parent, shapes[i], limit
                )
            turn = (
                angle_1 * first[0] + angle_2 * second[0],
                angle_1 * first[1] + angle_2 * second[1],
                angle_1 * first[2] + angle_2 * second[2],
            )
            q = multiply(q_parent, from_rotation_vector(turn))
            x = add_scaled(load3(a, above), load3(a, above + _W * np.uintp(7)), c[link, ATTACH])
            x = add_scaled(x, constant3(c, link, OFFSET), _F(1.0))
            store3(a, here, x)
            store3(a, here + _W * np.uintp(3), q)
            store(a, here + _W * np.uintp(6), q[3])
            store3(a, here + _W * np.uintp(7), rotate(q, constant3(c, link, VECTOR)))
            for lane in range(placements):
                out = pose[tile * WIDTH + lane, i]
                for k in range(3):
                    out[k] = a[here + np.uintp(k * WIDTH + lane)]
                for k in range(4):
                    out[4 + k] = a[here + np.uintp((3 + k) * WIDTH + lane)]
