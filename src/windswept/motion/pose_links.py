"""From joint angles to where every link is: the arrow from State to Pose."""

from __future__ import annotations

import numpy as np
from numba import njit, prange

from windswept.motion.lanes import WIDTH, load, store
from windswept.motion.model import ATTACH, AXIS_1, AXIS_2, OFFSET, VECTOR, Model
from windswept.motion.rotation import add_scaled, from_rotation_vector, multiply, rotate
from windswept.motion.springs import constant3, load3, load4, store3
from windswept.motion.state import State
from windswept.plants.pose import Pose

_F = np.float32
_W = np.uintp(WIDTH)
_RECORD = np.uintp(10 * WIDTH)
"""Scratch of a link: joint (3), rotation (4), link vector (3)."""


def pose_links(model: Model, state: State, ahead: float = 0.0) -> Pose:
    """Pose of every placement.

    Args:
        model: the plant's constants.
        state: its motion.
        ahead: seconds since the last inner step; angles go on at their velocity, so that motion is smooth at any
            frame rate.

    """
    pose = np.zeros((state.placement_count, model.link_count, 8), np.float32)
    _pose_tiles(model.constants, model.skeleton.parent, state.joints, np.float32(ahead), pose)
    return Pose(pose)


@njit(fastmath=True, forceinline=True)
def _angle(joints, i, ahead):  # type: ignore[no-untyped-def]
    return load(joints, i) + load(joints, i + _W) * ahead


@njit(fastmath=True, parallel=True, cache=True)
def _pose_tiles(c, parent, joints, ahead, pose):  # type: ignore[no-untyped-def]
    tiles, count = joints.shape[0], len(parent)
    for tile in prange(tiles):
        a = np.zeros((count + 1) * 10 * WIDTH, np.float32)
        a[6 * WIDTH : 7 * WIDTH] = _F(1.0)
        angles = joints[tile].reshape(-1)
        placements = min(WIDTH, len(pose) - tile * WIDTH)
        for i in range(count):
            link = np.uintp(i)
            above = np.uintp(parent[i] + 1) * _RECORD
            here = (link + np.uintp(1)) * _RECORD
            joint = link * np.uintp(4 * WIDTH)
            first, second = constant3(c, link, AXIS_1), constant3(c, link, AXIS_2)
            angle_1 = _angle(angles, joint, ahead)
            angle_2 = _angle(angles, joint + _W + _W, ahead)
            turn = (
                angle_1 * first[0] + angle_2 * second[0],
                angle_1 * first[1] + angle_2 * second[1],
                angle_1 * first[2] + angle_2 * second[2],
            )
            q = multiply(load4(a, above + _W * np.uintp(3)), from_rotation_vector(turn))
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
