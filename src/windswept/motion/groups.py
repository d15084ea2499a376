"""A group of branches that share one oscillator: how it swings, and what it passes on to the link that carries it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from windswept.motion.lanes import FAST_MATH, WIDTH, settled, sqrt, store
from windswept.motion.level import (
    CENTRE,
    COUPLE,
    FORCE_LEAF,
    FORCE_WOOD,
    GROUP_MOBILITY,
    GROUP_STEP,
    LEAF_FACTOR,
    SWAY,
    WOOD_FACTOR,
)
from windswept.motion.registers import constant3, load3, load4, tensor_times
from windswept.motion.rotation import add_scaled, cross, dot, rotate, rotate_back

_F = np.float32
_W = np.uintp(WIDTH)
_TINY = _F(1e-30)
REST_THRESHOLD = 1e-7
"""Pressures and their rates below this, in (m/s)^2 and (m/s)^2/s, are put to rest."""
_THRESHOLD: Any = _F(REST_THRESHOLD)


@njit(fastmath=FAST_MATH, forceinline=True)
def air_of_group(wind, probe):  # type: ignore[no-untyped-def]
    """Air velocity and leaf reconfiguration at a group's probe."""
    return load4(wind, np.uintp(probe) * _W * np.uintp(4))


@njit(fastmath=FAST_MATH, forceinline=True)
def matrix_times(g, k, column, v):  # type: ignore[no-untyped-def]
    """The 3 x 3 matrix in nine columns of a group's constants, times a vector."""
    return (
        dot(v, constant3(g, k, column)),
        dot(v, constant3(g, k, column + 3)),
        dot(v, constant3(g, k, column + 6)),
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def swing_group(g, k, air, groups, carrier):  # type: ignore[no-untyped-def]
    """Steps one group and gives the force and the moment about the origin on its carrier.

    Args:
        g: constants of the groups.
        k: which group.
        air: air velocity at its probe, and leaf reconfiguration.
        groups: pressure and rate of all groups, updated.
        carrier: rotation, joint position, angular velocity and joint velocity of the link that carries it.
    """
    q, x, spin, v = carrier
    at = np.uintp(k) * _W * np.uintp(6)
    u, rate = load3(groups, at), load3(groups, at + _W * np.uintp(3))
    arm = rotate(q, constant3(g, k, CENTRE))
    v = add_scaled(
        add_scaled(v, cross(spin, arm), _F(1.0)), rotate(q, matrix_times(g, k, SWAY, rate)), _F(1.0)
    )
    relative = add_scaled(air, v, _F(-1.0))
    speed = sqrt(dot(relative, relative) + _TINY)
    relative = add_scaled(air, v, _F(-1.0) / (_F(1.0) + speed * g[k, GROUP_MOBILITY]))
    leaf = speed * air[3]
    weight = leaf * g[k, LEAF_FACTOR] + speed * g[k, WOOD_FACTOR]
    pressure = (relative[0] * weight, relative[1] * weight, relative[2] * weight)
    target = rotate_back(q, pressure)
    for i in range(3):
        y = u[i] - target[i]
        moved = target[i] + y * g[k, GROUP_STEP] + rate[i] * g[k, GROUP_STEP + 1]
        swung = y * g[k, GROUP_STEP + 2] + rate[i] * g[k, GROUP_STEP + 3]
        store(groups, at + np.uintp(i) * _W, settled(moved, _THRESHOLD))
        store(groups, at + np.uintp(i + 3) * _W, settled(swung, _THRESHOLD))
    on_leaf, on_wood = tensor_times(g, k, FORCE_LEAF, relative), tensor_times(g, k, FORCE_WOOD, relative)
    force = (
        on_leaf[0] * leaf + on_wood[0] * speed,
        on_leaf[1] * leaf + on_wood[1] * speed,
        on_leaf[2] * leaf + on_wood[2] * speed,
    )
    moment = add_scaled(
        cross(add_scaled(x, arm, _F(1.0)), force), matrix_times(g, k, COUPLE, pressure), _F(1.0)
    )
    return force, moment
