"""The force field as the blades' kernel reads it: a register for every node of the grid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numba import njit, prange

from windswept.motion.blades.registers import at_most, extract, transpose, whole
from windswept.motion.lanes import FAST_MATH, WIDTH, at_least, load
from windswept.plants.plant import Floats

MOST_NODES = 1 << 24
"""A node's number must be exact in float32."""

_F = np.float32
_W = np.uintp(WIDTH)
_ZERO: Any = _F(0.0)


class Grid(NamedTuple):
    """A regular grid over the terrain: node (i, j, k) is at origin + (i dx, j dy), k dz above the ground."""

    nodes_x: int
    nodes_y: int
    nodes_z: int
    origin_x: np.float32
    origin_y: np.float32
    """m"""
    per_x: np.float32
    per_y: np.float32
    per_z: np.float32
    """Nodes in a metre, 1/m."""


@dataclass(frozen=True, slots=True)
class PackedField:
    """Air velocity and contact pressure on a grid."""

    nodes: Floats
    """(nx * ny * nz * 8,) of every node velocity (3, m/s), 0, pressure (3, N/m^2), 0; z fastest, then y."""
    grid: Grid


def pack_field(
    velocity: Floats,
    push: Floats | None,
    origin: tuple[float, float],
    edges: tuple[float, float, float],
    into: PackedField | None = None,
) -> PackedField:
    """The field as the kernel reads it.

    Args:
        velocity: (nx, ny, nz, 3) of the air, m/s; two nodes or more along every axis.
        push: (nx, ny, nz, 3) contact pressure on a blade's area, N/m^2; None for none.
        origin: x, y of the first node, m.
        edges: of a cell, dx, dy, dz, m.
        into: a field of the same size whose memory is used again; None for new memory.
    """
    shape = (velocity.shape[0], velocity.shape[1], velocity.shape[2])
    if min(shape) < 2 or np.prod(shape) > MOST_NODES:
        raise ValueError(
            f"a field of {shape} nodes: expected 2 or more along each axis, and {MOST_NODES:,} at most"
        )
    size = int(np.prod(shape)) * WIDTH
    nodes = np.zeros(size, np.float32) if into is None or into.nodes.size != size else into.nodes
    per = [_F(1.0 / edge) for edge in edges]
    grid = Grid(*shape, _F(origin[0]), _F(origin[1]), per[0], per[1], per[2])
    still = np.zeros((1, 3), np.float32)
    _interleave(
        velocity.reshape(-1, 3), still if push is None else push.reshape(-1, 3), nodes.reshape(-1, WIDTH)
    )
    return PackedField(nodes, grid)


@njit(parallel=True, cache=True)
def _interleave(velocity, push, nodes):  # type: ignore[no-untyped-def]
    pushed = len(push) == len(nodes)
    for i in prange(len(nodes)):
        for axis in range(3):
            nodes[i, axis] = velocity[i, axis]
            nodes[i, 4 + axis] = push[i, axis] if pushed else _F(0.0)


@njit(fastmath=FAST_MATH, forceinline=True)
def _cell(x, nodes):  # type: ignore[no-untyped-def]
    """First node of the cell of a place in cells, and how far into the cell; outside, the border's."""
    x = at_most(at_least(x, _ZERO), _F(nodes - 1))
    first = at_most(whole(x), _F(nodes - 2))
    return first, x - first


@njit(fastmath=FAST_MATH, forceinline=True)
def _between(a, b, part):  # type: ignore[no-untyped-def]
    return a + (b - a) * part


@njit(fastmath=FAST_MATH, forceinline=True)
def _corners(field, node, u, v, w, lane, along_x, along_y):  # type: ignore[no-untyped-def]
    """The field at one lane's place, as one register: the mean of the cell's eight nodes, weighted trilinearly."""
    a = np.uintp(extract(node, lane)) * _W
    x, y, z = extract(u, lane), extract(v, lane), extract(w, lane)
    b, c, d = a + along_y, a + along_x, a + along_x + along_y
    near = _between(
        _between(load(field, a), load(field, a + _W), z), _between(load(field, b), load(field, b + _W), z), y
    )
    far = _between(
        _between(load(field, c), load(field, c + _W), z), _between(load(field, d), load(field, d + _W), z), y
    )
    return _between(near, far, x)


@njit(fastmath=FAST_MATH, forceinline=True)
def sample(field, grid, place):  # type: ignore[no-untyped-def]
    """Velocity and pressure at the places (x, y, height) of eight blades."""
    i, u = _cell((place[0] - grid.origin_x) * grid.per_x, grid.nodes_x)
    j, v = _cell((place[1] - grid.origin_y) * grid.per_y, grid.nodes_y)
    k, w = _cell(place[2] * grid.per_z, grid.nodes_z)
    node = (i * _F(grid.nodes_y) + j) * _F(grid.nodes_z) + k
    along_y = np.uintp(grid.nodes_z) * _W
    along_x = np.uintp(grid.nodes_y) * along_y
    columns = transpose(
        _corners(field, node, u, v, w, np.uintp(0), along_x, along_y),
        _corners(field, node, u, v, w, np.uintp(1), along_x, along_y),
        _corners(field, node, u, v, w, np.uintp(2), along_x, along_y),
        _corners(field, node, u, v, w, np.uintp(3), along_x, along_y),
        _corners(field, node, u, v, w, np.uintp(4), along_x, along_y),
        _corners(field, node, u, v, w, np.uintp(5), along_x, along_y),
        _corners(field, node, u, v, w, np.uintp(6), along_x, along_y),
        _corners(field, node, u, v, w, np.uintp(7), along_x, along_y),
    )
    return (columns[0], columns[1], columns[2]), (columns[4], columns[5], columns[6])
