"""Vectors of Lanes in flat arrays, component after component."""

from __future__ import annotations

import numpy as np
from numba import njit

from windswept.motion.lanes import FAST_MATH, WIDTH, load, store

_W = np.uintp(WIDTH)


@njit(fastmath=FAST_MATH, forceinline=True)
def load3(a, i):  # type: ignore[no-untyped-def]
    """Three consecutive registers."""
    return load(a, i), load(a, i + _W), load(a, i + _W + _W)


@njit(fastmath=FAST_MATH, forceinline=True)
def store3(a, i, v):  # type: ignore[no-untyped-def]
    """Writes three consecutive registers."""
    store(a, i, v[0])
    store(a, i + _W, v[1])
    store(a, i + _W + _W, v[2])


@njit(fastmath=FAST_MATH, forceinline=True)
def load4(a, i):  # type: ignore[no-untyped-def]
    """Four consecutive registers."""
    v = load3(a, i)
    return v[0], v[1], v[2], load(a, i + _W * np.uintp(3))


@njit(fastmath=FAST_MATH, forceinline=True)
def constant3(constants, link, column):  # type: ignore[no-untyped-def]
    """Three columns of a link's constants."""
    return constants[link, column], constants[link, column + 1], constants[link, column + 2]


@njit(fastmath=FAST_MATH, forceinline=True)
def tensor_times(constants, row, column, v):  # type: ignore[no-untyped-def]
    """The symmetric tensor xx, yy, zz, xy, xz, yz in six columns of constants, times a vector."""
    xx, yy, zz = constant3(constants, row, column)
    xy, xz, yz = constant3(constants, row, column + 3)
    return (
        v[0] * xx + v[1] * xy + v[2] * xz,
        v[0] * xy + v[1] * yy + v[2] * yz,
        v[0] * xz + v[1] * yz + v[2] * zz,
    )
