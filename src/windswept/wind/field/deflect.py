"""deflect: how air flows round what stands in the field, solved once for air from every direction.

The flow round obstacles is a potential flow through a medium of given openness b: div(b (e + grad phi)) = 0 for an
ambient flow e along x, y or z, by finite volumes round the nodes, so that the fluxes between nodes have no divergence
but the solver's. Its velocity is linear in the ambient one, which makes it a tensor at every node; a step then costs
a product where a pressure solver would cost many sweeps. What that leaves out: it takes the ambient velocity to be
even over the obstacle's size, and the slope of the ground to be small. Wakes come on top (``bodies``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from windswept.wind.field.grid import Floats, Grid
from windswept.wind.field.obstacles import Obstacle, openness

Reals = NDArray[np.float64]

FELT = 0.02
"""Columns of nodes where no entry of the tensor differs from free air's by more are left as free air; where one
differs by less than twice that, the deflection fades out."""
TOLERANCE = 1e-6
"""Of the solver: residual over source."""
MOST_SWEEPS = 2000
TINY = 1e-30
"""Stands for the diagonal deep in a solid, where nothing flows and the residual is 0."""
AIR_ROW = 9
"""Row of ``Deflection.tensor`` that says where there is air at all."""


@dataclass(frozen=True, slots=True)
class Deflection:
    """Tensors of the C columns of nodes where obstacles are felt."""

    column: NDArray[np.int32]
    """(nx, ny) index of a column of nodes among the C, -1 for free air."""
    tensor: Floats
    """(C, 10, nz) velocity = tensor x ambient velocity, row by row; then 1 in air, 0 in a solid."""


@dataclass(frozen=True, slots=True)
class Fluxes:
    """Velocities between nodes for one ambient flow of 1 m/s."""

    x: Reals
    """(nx - 1, ny, nz) m/s."""
    y: Reals
    """(nx, ny - 1, nz) m/s."""
    z: Reals
    """(nx, ny, nz - 1) m/s."""


def deflect(grid: Grid, obstacles: Sequence[Obstacle]) -> Deflection:
    """The deflection by all obstacles together."""
    nx, ny, nz = grid.shape
    if not obstacles:
        return Deflection(np.full((nx, ny), -1, np.int32), np.zeros((0, AIR_ROW + 1, nz), np.float32))
    passes = openness(grid, obstacles)
    ambient = np.eye(3)
    fluxes = solve_fluxes(grid, passes)
    tensor = np.stack([node_velocity(flux, e) for flux, e in zip(fluxes, ambient, strict=True)], axis=1)
    # Nor does the ambient air of ground, top and borders pass a solid.
    tensor[..., passes == 0.0] = 0.0
    free = ambient[:, :, None, None, None]
    departs = np.abs(tensor - free).max(axis=(0, 1, 4))
    felt = departs > FELT
    fade = np.clip(departs / FELT - 1.0, 0.0, 1.0)[:, :, None]
    tensor = free + fade * (tensor - free)
    column = np.where(felt, np.cumsum(felt).reshape(nx, ny) - 1, -1).astype(np.int32)
    rows = np.concatenate([tensor.reshape(9, nx, ny, nz), (passes > 0.0)[None]])
    return Deflection(column, np.ascontiguousarray(rows[:, felt].transpose(1, 0, 2), dtype=np.float32))


def solve_fluxes(grid: Grid, passes: Reals) -> list[Fluxes]:
    """Divergence-free velocities between nodes for ambient flows of 1 m/s along x, y and z.

    The borders keep the ambient flow. The disturbance passes neither the ground nor the top, as if what stands higher
    than the field went on for ever; the ambient flow is taken to end on the ground by itself.

    Args:
        grid: the nodes.
        passes: (nx, ny, nz) openness at them.
    """
    faces = [_harmonic(np.moveaxis(passes, axis, 0), axis) for axis in range(3)]
    weights = [face / cell**2 for face, cell in zip(faces, grid.cell, strict=True)]
    sources = np.stack(
        [_divergence(face / cell, n) for n, (face, cell) in enumerate(zip(faces, grid.cell, strict=True))]
    )
    sources[2, :, :, 0] -= passes[:, :, 0] / grid.cell[2]
    sources[2, :, :, -1] += passes[:, :, -1] / grid.cell[2]
    potentials = np.zeros_like(sources)
    _solve(*weights, _diagonal(weights), sources, potentials)
    return [
        Fluxes(
            *(
                face * (e + np.diff(potential, axis=axis) / cell)
                for axis, (face, e, cell) in enumerate(zip(faces, ambient, grid.cell, strict=True))
            )
        )
        for potential, ambient in zip(potentials, np.eye(3), strict=True)
    ]


def node_velocity(fluxes: Fluxes, ambient: Reals) -> Reals:
    """(3, nx, ny, nz) velocity at nodes: the mean of the fluxes on either side, m/s; ambient at the borders."""
    parts = []
    for axis, flux in enumerate((fluxes.x, fluxes.y, fluxes.z)):
        padded = np.pad(flux, [(1, 1) if axis == a else (0, 0) for a in range(3)], mode="edge")
        both = np.moveaxis(padded, axis, 0)
        parts.append(np.moveaxis(0.5 * (both[1:] + both[:-1]), 0, axis))
    velocity = np.stack(parts)
    velocity[2, :, :, [0, -1]] = ambient[2]
    for border in (np.s_[:, 0], np.s_[:, -1], np.s_[:, :, 0], np.s_[:, :, -1]):
        velocity[border] = ambient.reshape(3, 1, 1)
    return velocity


def flux_divergence(grid: Grid, fluxes: Fluxes) -> Reals:
    """(nx - 2, ny - 2, nz - 2) net outflow of the inner nodes' cells, 1/s."""
    outflow = np.zeros(grid.shape)
    for axis, flux in enumerate((fluxes.x, fluxes.y, fluxes.z)):
        outflow += _divergence(flux, axis) / grid.cell[axis]
    return outflow[1:-1, 1:-1, 1:-1]


def _harmonic(first: Reals, axis: int) -> Reals:
    """Harmonic mean of neighbours along an axis, which is first here and goes back to its place."""
    a, b = first[:-1], first[1:]
    return np.moveaxis(2.0 * a * b / np.maximum(a + b, 1e-30), 0, axis)


def _divergence(flux: Reals, axis: int) -> Reals:
    """Difference of what leaves and enters each node along an axis; nothing comes from beyond the grid."""
    padded = np.pad(flux, [(1, 1) if axis == a else (0, 0) for a in range(3)])
    return np.asarray(np.diff(padded, axis=axis))


def _diagonal(weights: list[Reals]) -> Reals:
    """(nx, ny, nz) sum of the weights of a node's faces."""
    before, after = (
        [
            np.pad(weight, [side if axis == a else (0, 0) for a in range(3)])
            for axis, weight in enumerate(weights)
        ]
        for side in ((1, 0), (0, 1))
    )
    return np.asarray(sum(before) + sum(after))


@njit(parallel=True, cache=True)
def _solve(wx, wy, wz, diagonal, sources, potentials):  # type: ignore[no-untyped-def]
    """div(weight grad p) = -source with p = 0 at the borders: conjugate gradients, the three flows at once.

    Each flow is one thread's, so that sums do not depend on the number of threads.
    """
    for flow in prange(3):
        p, residual = potentials[flow], sources[flow]
        way, image = np.zeros_like(p), np.zeros_like(p)
        squared = _descend(p, residual, way, image, diagonal, 0.0)
        enough = squared * TOLERANCE**2
        share = 0.0
        for _ in range(MOST_SWEEPS):
            if squared <= enough:
                break
            curvature = _turn_to(residual, way, image, diagonal, share, wx, wy, wz)
            before = squared
            squared = _descend(p, residual, way, image, diagonal, before / curvature)
            share = squared / before


@njit(fastmath={"reassoc", "contract"}, forceinline=True)
def _descend(p, residual, way, image, diagonal, length):  # type: ignore[no-untyped-def]
    """Goes a length along the way; the residual's square, weighted by the inverse diagonal."""
    nx, ny, nz = p.shape
    squared = 0.0
    for i in range(1, nx - 1):
        for j in range(1, ny - 1):
            for k in range(nz):
                p[i, j, k] += length * way[i, j, k]
                residual[i, j, k] -= length * image[i, j, k]
                squared += residual[i, j, k] * residual[i, j, k] / max(diagonal[i, j, k], TINY)
    return squared


@njit(fastmath={"reassoc", "contract"}, forceinline=True)
def _turn_to(residual, way, image, diagonal, share, wx, wy, wz):  # type: ignore[no-untyped-def]
    """The next way, its image -div(weight grad way), and the product of both."""
    nx, ny, nz = way.shape
    for i in range(1, nx - 1):
        for j in range(1, ny - 1):
            for k in range(nz):
                way[i, j, k] = residual[i, j, k] / max(diagonal[i, j, k], TINY) + share * way[i, j, k]
    curvature = 0.0
    for i in range(1, nx - 1):
        for j in range(1, ny - 1):
            for k in range(nz):
                out = diagonal[i, j, k] * way[i, j, k]
                out -= wx[i - 1, j, k] * way[i - 1, j, k] + wx[i, j, k] * way[i + 1, j, k]
                out -= wy[i, j - 1, k] * way[i, j - 1, k] + wy[i, j, k] * way[i, j + 1, k]
                image[i, j, k] = out
            for k in range(nz - 1):
                image[i, j, k] -= wz[i, j, k] * way[i, j, k + 1]
                image[i, j, k + 1] -= wz[i, j, k] * way[i, j, k]
            for k in range(nz):
                curvature += way[i, j, k] * image[i, j, k]
    return curvature
