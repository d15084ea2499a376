"""Vectors and quaternions for kernels; every component is a number or a register of Lanes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from windswept.motion.lanes import FAST_MATH

Vector = tuple[Any, Any, Any]
Quaternion = tuple[Any, Any, Any, Any]

_F = np.float32


@njit(fastmath=FAST_MATH, forceinline=True)
def cross(a: Vector, b: Vector) -> Vector:
    """Cross product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@njit(fastmath=FAST_MATH, forceinline=True)
def dot(a: Vector, b: Vector) -> Any:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit(fastmath=FAST_MATH, forceinline=True)
def add_scaled(a: Vector, b: Vector, s: Any) -> Vector:
    """``a + s b``."""
    return a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s


@njit(fastmath=FAST_MATH, forceinline=True)
def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Quaternion product: first b, then a."""
    return (
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def rotate(q: Quaternion, v: Vector) -> Vector:
    """``v`` turned by unit quaternion ``q``: v + 2 w (q x v) + 2 q x (q x v)."""
    t = cross((q[0], q[1], q[2]), v)
    t = (t[0] + t[0], t[1] + t[1], t[2] + t[2])
    s = cross((q[0], q[1], q[2]), t)
    return v[0] + q[3] * t[0] + s[0], v[1] + q[3] * t[1] + s[1], v[2] + q[3] * t[2] + s[2]


@njit(fastmath=FAST_MATH, forceinline=True)
def rotate_back(q: Quaternion, v: Vector) -> Vector:
    """``v`` turned by the inverse of unit quaternion ``q``."""
    t = cross(v, (q[0], q[1], q[2]))
    t = (t[0] + t[0], t[1] + t[1], t[2] + t[2])
    s = cross(t, (q[0], q[1], q[2]))
    return v[0] + q[3] * t[0] + s[0], v[1] + q[3] * t[1] + s[1], v[2] + q[3] * t[2] + s[2]


@njit(fastmath=FAST_MATH, forceinline=True)
def from_rotation_vector(v: Vector) -> Quaternion:
    """Unit quaternion of a rotation vector of up to pi, by Taylor series in the half angle (error below 3e-7
    to 2 rad, 3e-5 at pi).
    """
    x = _F(0.25) * dot(v, v)
    s = _F(1 / 5040) - x * _F(1 / 362880)
    s = _F(0.5) * (_F(1.0) - x * (_F(1 / 6) - x * (_F(1 / 120) - x * s)))
    c = _F(1 / 720) - x * (_F(1 / 40320) - x * _F(1 / 3628800))
    c = _F(1.0) - x * (_F(0.5) - x * (_F(1 / 24) - x * c))
    return v[0] * s, v[1] * s, v[2] * s, c
