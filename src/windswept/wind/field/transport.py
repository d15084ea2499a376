"""The air of a field at its nodes: ambient, deflected, and the departure that it carries.

Layout: a column of nodes is innermost. Ambient air and deflection are worked out a slab of equal x at a time,
component by component, in SIMD lanes; the departure has its three components side by side, and one number to fill a
register, so that each of the eight corners that a node's air came from is one load.
"""

from __future__ import annotations

import numpy as np
from numba import njit, prange

from windswept.wind.field.deflect import AIR_ROW
from windswept.wind.field.flows import FAST_MATH
from windswept.wind.field.quads import blend_rows

_F = np.float32
_I = np.int32
_U = np.uintp


@njit(parallel=True, cache=True, fastmath=FAST_MATH)
def transport(before, ambient, profile, flow, column, tensor, shift, keep, after, velocity):  # type: ignore[no-untyped-def]
    """Writes the deflected ambient air, and the departure where that air has carried it.

    Args:
        before: (nx, ny, nz, 4) departure, m/s; 0 at borders and top.
        ambient: (nx, ny, 3) wind at the reference height, m/s.
        profile: (nz,) its share at the height of each layer.
        flow: (3, nx, ny, nz) primitives and jets, m/s; (3, 0, 0, 0) if there are none.
        column: (nx, ny) of ``Deflection``.
        tensor: (C, 10, nz) of ``Deflection``.
        shift: (3,) cells that air of 1 m/s crosses in the step.
        keep: share of the departure that outlives the step.
        after: (nx, ny, nz, 4) departure, out; borders and top are not written.
        velocity: (nx, ny, nz, 3) deflected ambient air, m/s, out.
    """
    nx, ny, nz = before.shape[:3]
    rows_before, rows_after = before.reshape(-1), after.reshape(-1)
    for i in prange(nx):
        air = np.empty((3, ny, nz), np.float32)
        _blow(ambient[i], profile, air)
        if flow.size > 0:
            air += flow[:, i]
        for j in range(ny):
            if column[i, j] >= 0:
                _turn(tensor[column[i, j]], air[:, j])
        flat = air.reshape(3, -1)
        _interleave(flat, velocity[i].reshape(-1, 3))
        if 0 < i < nx - 1:
            corner, fraction = np.empty(ny * nz, np.int32), np.empty((3, ny * nz), np.float32)
            _origin(i, before.shape, flat, shift, corner, fraction)
            _carry(rows_before, before.shape, corner, fraction, keep, i * ny * nz, rows_after)
            for j in range(ny):
                if column[i, j] >= 0:
                    _keep_out(tensor[column[i, j]], after[i, j])


@njit(cache=True, fastmath=FAST_MATH)
def _blow(ambient, profile, air):  # type: ignore[no-untyped-def]
    """A slab's wind: horizontal, and as its profile has it."""
    for j in range(air.shape[1]):
        u, v = ambient[j, 0], ambient[j, 1]
        for k in range(air.shape[2]):
            air[0, j, k] = u * profile[k]
            air[1, j, k] = v * profile[k]
            air[2, j, k] = _F(0.0)


@njit(cache=True, fastmath=FAST_MATH)
def _turn(tensor, air):  # type: ignore[no-untyped-def]
    """A column's air behind, beside and in front of obstacles: tensor x ambient."""
    for k in range(air.shape[1]):
        u, v, w = air[0, k], air[1, k], air[2, k]
        air[0, k] = tensor[0, k] * u + tensor[1, k] * v + tensor[2, k] * w
        air[1, k] = tensor[3, k] * u + tensor[4, k] * v + tensor[5, k] * w
        air[2, k] = tensor[6, k] * u + tensor[7, k] * v + tensor[8, k] * w


@njit(cache=True, fastmath=FAST_MATH)
def _interleave(air, velocity):  # type: ignore[no-untyped-def]
    """From component after component to node after node."""
    for n in range(len(velocity)):
        velocity[n, 0] = air[0, n]
        velocity[n, 1] = air[1, n]
        velocity[n, 2] = air[2, n]


@njit(cache=True, fastmath=FAST_MATH)
def _origin(i, shape, air, shift, corner, fraction):  # type: ignore[no-untyped-def]
    """Where a slab's air was before the step: lowest corner of the cell, and how far into it (semi-Lagrangian)."""
    nx, ny, nz = _I(shape[0]), _I(shape[1]), _I(shape[2])
    x_here, last = _F(i), (_F(nx - _I(1)), _F(ny - _I(1)), _F(nz - _I(1)))
    for j in range(shape[1]):
        for k in range(shape[2]):
            n = j * shape[2] + k
            x = min(max(x_here - air[0, n] * shift[0], _F(0.0)), last[0])
            y = min(max(_F(j) - air[1, n] * shift[1], _F(0.0)), last[1])
            z = min(max(_F(k) - air[2, n] * shift[2], _F(0.0)), last[2])
            # A place that is no number is taken as the first cell: what comes of it is counted later.
            a = max(min(_I(x), nx - _I(2)), _I(0))
            b = max(min(_I(y), ny - _I(2)), _I(0))
            c = max(min(_I(z), nz - _I(2)), _I(0))
            fraction[0, n], fraction[1, n], fraction[2, n] = x - _F(a), y - _F(b), z - _F(c)
            corner[n] = (a * ny + b) * nz + c


@njit(cache=True, fastmath=FAST_MATH)
def _carry(rows, shape, corner, fraction, keep, first, out):  # type: ignore[no-untyped-def]
    """Trilinear departure where a slab's air was, but at borders and top."""
    east, north, up = _U(shape[1] * shape[2]), _U(shape[2]), _U(1)
    for j in range(1, shape[1] - 1):
        for k in range(shape[2] - 1):
            n = j * shape[2] + k
            u, v, high = fraction[0, n], fraction[1, n], fraction[2, n] * keep
            low = keep - high
            w11 = u * v
            w10, w01 = u - w11, v - w11
            w00 = _F(1.0) - u - w01
            sw = _U(corner[n])
            nw, se = sw + north, sw + east
            ne = se + north
            corners = (sw, nw, se, ne, sw + up, nw + up, se + up, ne + up)
            lower = (low * w00, low * w01, low * w10, low * w11)
            upper = (high * w00, high * w01, high * w10, high * w11)
            blend_rows(rows, corners, lower + upper, out, _U(first + n))


@njit(cache=True, fastmath=FAST_MATH)
def _keep_out(tensor, departure):  # type: ignore[no-untyped-def]
    """Nothing departs inside a solid."""
    for k in range(len(departure) - 1):
        for c in range(3):
            departure[k, c] *= tensor[AIR_ROW, k]
