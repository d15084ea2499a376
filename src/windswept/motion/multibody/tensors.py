"""Symmetric 3 x 3 tensors as xx, yy, zz, xy, xz, yz; every component is a number or a register of Lanes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from windswept.motion.lanes import FAST_MATH
from windswept.motion.rotation import Vector, add_scaled, cross

Tensor = tuple[Any, Any, Any, Any, Any, Any]
Rows = tuple[Vector, Vector, Vector]

_HALF = np.float32(0.5)
_ONE = np.float32(1.0)


@njit(fastmath=FAST_MATH, forceinline=True)
def times(t: Tensor, v: Vector) -> Vector:
    """Tensor times vector."""
    return (
        t[0] * v[0] + t[3] * v[1] + t[4] * v[2],
        t[3] * v[0] + t[1] * v[1] + t[5] * v[2],
        t[4] * v[0] + t[5] * v[1] + t[2] * v[2],
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def across(b: Vector, s: Any) -> Tensor:
    """S (1 - b b): what acts across the unit vector b alone."""
    x, y, z = b[0] * s, b[1] * s, b[2] * s
    return s - b[0] * x, s - b[1] * y, s - b[2] * z, -(b[0] * y), -(b[0] * z), -(b[1] * z)


@njit(fastmath=FAST_MATH, forceinline=True)
def added(a: Tensor, b: Tensor) -> Tensor:
    """Sum."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]


@njit(fastmath=FAST_MATH, forceinline=True)
def minus_product(t: Tensor, a: Vector, b: Vector) -> Tensor:
    """T - a b, for vectors whose product is symmetric."""
    return (
        t[0] - a[0] * b[0],
        t[1] - a[1] * b[1],
        t[2] - a[2] * b[2],
        t[3] - a[0] * b[1],
        t[4] - a[0] * b[2],
        t[5] - a[1] * b[2],
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def rise(mass: Tensor, r: Vector) -> Rows:
    """Rows of [r] mass, with [r] the matrix of r x: moment about a point that lies -r away, per acceleration there."""
    xx, yy, zz, xy, xz, yz = mass
    return (
        (r[1] * xz - r[2] * xy, r[1] * yz - r[2] * yy, r[1] * zz - r[2] * yz),
        (r[2] * xx - r[0] * xz, r[2] * xy - r[0] * yz, r[2] * xz - r[0] * zz),
        (r[0] * xy - r[1] * xx, r[0] * yy - r[1] * xy, r[0] * yz - r[1] * xz),
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def turning_of(risen: Rows, r: Vector) -> Tensor:
    """[r] ([r] mass)^T: moment about that point per angular acceleration."""
    x, y, z = cross(r, risen[0]), cross(r, risen[1]), cross(r, risen[2])
    return x[0], y[1], z[2], x[1], x[2], y[2]


@njit(fastmath=FAST_MATH, forceinline=True)
def moved(turning: Tensor, coupling: Rows, mass: Tensor, r: Vector) -> tuple[Tensor, Rows]:
    """Turning and coupling parts of an articulated inertia about a point that lies -r from where they were.

    Coupling + [r] mass, and turning + Q + Q^T where Q = [r] (coupling + [r] mass / 2)^T.
    """
    risen = rise(mass, r)
    x = cross(r, add_scaled(coupling[0], risen[0], _HALF))
    y = cross(r, add_scaled(coupling[1], risen[1], _HALF))
    z = cross(r, add_scaled(coupling[2], risen[2], _HALF))
    turned = (
        turning[0] + (x[0] + x[0]),
        turning[1] + (y[1] + y[1]),
        turning[2] + (z[2] + z[2]),
        turning[3] + (x[1] + y[0]),
        turning[4] + (x[2] + z[0]),
        turning[5] + (y[2] + z[1]),
    )
    return turned, summed(coupling, risen)


@njit(fastmath=FAST_MATH, forceinline=True)
def summed(a: Rows, b: Rows) -> Rows:
    """Sum."""
    return add_scaled(a[0], b[0], _ONE), add_scaled(a[1], b[1], _ONE), add_scaled(a[2], b[2], _ONE)
