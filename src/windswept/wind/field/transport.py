"""The air of a field at its nodes: ambient, deflected, and the departure that it carries.

Layout: a column of nodes is innermost. Ambient air and deflection are worked out a slab of equal x at a time,
component by component, in SIMD lanes; the departure has its four numbers side by side, which fill a register, so
that each of the eight corners that a node's air came from is one load.
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
        before: (nx, ny, nz, 4) departure; 0 at borders and top.
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
        air, undisturbed = np.empty((3, ny, nz), np.float32), np.empty((3, nz), np.float32)
        _blow(ambient[i], profile, air)
        if flow.size > 0:
            air += flow[:, i]
        for j in range(ny):
            if column[i, j] >= 0:
                undisturbed[:] = air[:, j]
                for c in range(3):
                    _turn(tensor[column[i, j], 3 * c : 3 * c + 3], undisturbed, air[c, j])
        flat = air.reshape(3, -1)
        _interleave(flat, velocity[i].reshape(-1, 3))
        if 0 < i < nx - 1:
            cell, fraction = np.empty((3, ny * nz), np.int32), np.empty((3, ny * nz), np.float32)
            place = np.full((3, ny, nz), _F(i), np.float32)
            _count_nodes(place)
            for c in range(3):
                _origin(flat[c], shift[c], before.shape[c], place[c].reshape(-1), cell[c], fraction[c])
            _carry(rows_before, before.shape, cell, fraction, keep, i * ny * nz, rows_after)
            for j in range(ny):
                if column[i, j] >= 0:
                    _keep_out(tensor[column[i, j]], after[i, j])


@njit(fastmath=FAST_MATH, forceinline=True)
def _blow(ambient, profile, air):  # type: ignore[no-untyped-def]
    """A slab's wind: horizontal, and as its profile has it."""
    for j in range(air.shape[1]):
        u, v = ambient[j, 0], ambient[j, 1]
        for k in range(air.shape[2]):
            air[0, j, k] = u * profile[k]
            air[1, j, k] = v * profile[k]
            air[2, j, k] = _F(0.0)


@njit(fastmath=FAST_MATH, forceinline=True)
def _turn(tensor, ambient, air):  # type: ignore[no-untyped-def]
    """One component of a column's air behind, beside and in front of obstacles: a row of the tensor x ambient."""
    xx, xy, xz = tensor[0], tensor[1], tensor[2]
    u, v, w = ambient[0], ambient[1], ambient[2]
    for k in range(len(air)):
        air[k] = xx[k] * u[k] + xy[k] * v[k] + xz[k] * w[k]


@njit(fastmath=FAST_MATH, forceinline=True)
def _interleave(air, velocity):  # type: ignore[no-untyped-def]
    """From component after component to node after node."""
    for n in range(len(velocity)):
        velocity[n, 0] = air[0, n]
        velocity[n, 1] = air[1, n]
        velocity[n, 2] = air[2, n]


@njit(fastmath=FAST_MATH, forceinline=True)
def _count_nodes(place):  # type: ignore[no-untyped-def]
    """Index along y and z of the nodes of a slab."""
    for j in range(place.shape[1]):
        for k in range(place.shape[2]):
            place[1, j, k] = _F(j)
            place[2, j, k] = _F(k)


@njit(fastmath=FAST_MATH, forceinline=True)
def _origin(air, shift, count, place, cell, fraction):  # type: ignore[no-untyped-def]
    """Where a slab's air was before the step, along one axis: the cell, and how far into it (semi-Lagrangian)."""
    last, last_cell = _F(count - 1), _I(count - 2)
    for n in range(len(air)):
        origin = min(max(place[n] - air[n] * shift, _F(0.0)), last)
        # A place that is no number is taken as the first cell: what comes of it is counted later.
        below = max(min(_I(origin), last_cell), _I(0))
        cell[n] = below
        fraction[n] = origin - _F(below)


@njit(fastmath=FAST_MATH, forceinline=True)
def _carry(rows, shape, cell, fraction, keep, first, out):  # type: ignore[no-untyped-def]
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
            sw = _U((cell[0, n] * shape[1] + cell[1, n]) * shape[2] + cell[2, n])
            nw, se = sw + north, sw + east
            ne = se + north
            corners = (sw, nw, se, ne, sw + up, nw + up, se + up, ne + up)
            lower = (low * w00, low * w01, low * w10, low * w11)
            upper = (high * w00, high * w01, high * w10, high * w11)
            blend_rows(rows, corners, lower + upper, out, _U(first + n))


@njit(fastmath=FAST_MATH, forceinline=True)
def _keep_out(tensor, departure):  # type: ignore[no-untyped-def]
    """Nothing departs inside a solid."""
    for k in range(len(departure)):
        if tensor[AIR_ROW, k] == _F(0.0):
            departure[k, :] = _F(0.0)
