"""flow_into: primitives and jets at every node of a grid."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from windswept.wind.field.acts import Jet
from windswept.wind.field.grid import Floats, Grid
from windswept.wind.field.primitives import Primitive, line_rows, uniform_velocity

Reals = NDArray[np.float64]

FAST_MATH = {"nsz", "contract", "arcp", "afn", "reassoc"}
"""What the field's kernels may do to arithmetic; not "nnan": a broken number must stay one, to be counted.

What kernels are made of is put into them with ``forceinline``: a part that is compiled by itself too may be worked out
in another order there, and the first run, in which both are at hand, would differ from those that load the kernel.
"""
_F = np.float32


def flow_into(
    flow: Floats, grid: Grid, primitives: Sequence[Primitive], jets: Sequence[Jet], time: float
) -> None:
    """Writes the sum of primitives and jets.

    Args:
        flow: (3, nx, ny, nz) m/s.
        grid: its nodes.
        primitives: those that blow.
        jets: any number.
        time: s.
    """
    jet_rows = np.array([(*jet.place, jet.radius, jet.speed, jet.layer) for jet in jets], np.float32)
    _add_flows(
        flow,
        np.array([*grid.origin, *grid.cell], np.float32),
        uniform_velocity(primitives).astype(np.float32),
        line_rows(primitives, time),
        jet_rows.reshape(-1, 5),
        np.exp(-grid.heights / np.array([[jet.layer] for jet in jets]).reshape(-1, 1)).astype(np.float32),
    )


def jet_velocity(jet: Jet, points: Reals) -> Reals:
    """A jet's flow, the plain formula that the kernel implements: it has no divergence anywhere.

    w = -W g(r) f(z), u_r = W f'(z) R^2 (1 - g(r)) / (2 r), with g = exp(-r^2/R^2) and f = 1 - exp(-z/layer).

    Args:
        jet: place, radius, speed and layer.
        points: (N, 3) x, y and height above ground, m.

    Returns:
        (N, 3) m/s.
    """
    offset = points[:, :2] - jet.place
    squared = np.maximum(np.sum(offset**2, axis=1), 1e-6 * jet.radius**2)
    inside = np.exp(-squared / jet.radius**2)
    near_ground = np.exp(-points[:, 2] / jet.layer)
    outward = 0.5 * jet.speed * jet.radius**2 / jet.layer * near_ground * (1.0 - inside) / squared
    down = -jet.speed * inside * (1.0 - near_ground)
    return np.column_stack([outward[:, None] * offset, down])


@njit(parallel=True, cache=True, fastmath=FAST_MATH)
def _add_flows(flow, frame, uniform, lines, jets, near_ground):  # type: ignore[no-untyped-def]
    """Slabs of equal x over the threads, heights innermost."""
    nx, ny = flow.shape[1:3]
    for i in prange(nx):
        x = frame[0] + _F(i) * frame[2]
        for j in range(ny):
            y = frame[1] + _F(j) * frame[3]
            u, v, w = flow[0, i, j], flow[1, i, j], flow[2, i, j]
            u[:], v[:], w[:] = uniform[0], uniform[1], uniform[2]
            for n in range(len(lines)):
                _add_line(lines[n], x, y, frame[4], u, v, w)
            for n in range(len(jets)):
                _add_jet(jets[n], near_ground[n], x, y, u, v, w)


@njit(fastmath=FAST_MATH, forceinline=True)
def _add_line(line, x, y, dz, u, v, w):  # type: ignore[no-untyped-def]
    """One line's flow in a column of nodes (LINE_COLUMNS)."""
    ax, ay, az = line[3], line[4], line[5]
    source, vortex, core = line[6], line[7], line[8]
    for k in range(len(u)):
        qx, qy, qz = x - line[0], y - line[1], _F(k) * dz - line[2]
        along = qx * ax + qy * ay + qz * az
        qx, qy, qz = qx - along * ax, qy - along * ay, qz - along * az
        share = _F(1.0) / (qx * qx + qy * qy + qz * qz + core)
        u[k] += share * (source * qx + vortex * (ay * qz - az * qy))
        v[k] += share * (source * qy + vortex * (az * qx - ax * qz))
        w[k] += share * (source * qz + vortex * (ax * qy - ay * qx))


@njit(fastmath=FAST_MATH, forceinline=True)
def _add_jet(jet, near_ground, x, y, u, v, w):  # type: ignore[no-untyped-def]
    """One jet's flow in a column of nodes, as ``jet_velocity``."""
    radius, speed, layer = jet[2], jet[3], jet[4]
    qx, qy = x - jet[0], y - jet[1]
    squared = max(qx * qx + qy * qy, _F(1e-6) * radius * radius)
    inside = np.exp(-squared / (radius * radius))
    outward = _F(0.5) * speed * radius * radius / layer * (_F(1.0) - inside) / squared
    out_x, out_y, down = outward * qx, outward * qy, speed * inside
    for k in range(len(u)):
        u[k] += out_x * near_ground[k]
        v[k] += out_y * near_ground[k]
        w[k] -= down * (_F(1.0) - near_ground[k])
