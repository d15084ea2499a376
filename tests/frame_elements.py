"""An independent check of natural frequencies: a frame of 3-D Euler-Bernoulli beams with consistent masses.

Written from the textbook (Przemieniecki 1968), sharing nothing with windswept but the table of cylinders. Joining
rule of PHYSICS, measured tree T14: axes normalised; a child hangs at the projection of its start on its parent's
axis, which is split there, or at an end within 2 % of its length; its element runs from there to its own end.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import eigsh

POISSON = 0.3


@dataclass
class Frame:
    """Nodes (n, 3) in m, and beams as (node, node, radius); node 0 is clamped."""

    nodes: np.ndarray
    beams: list[tuple[int, int, float]]


def frame_of_cylinders(table: np.ndarray) -> Frame:
    """Frame of rows of radius, length, start xyz, axis xyz, parent (from 1, 0 for the root), parents first."""
    start, axis = table[:, 2:5].copy(), table[:, 5:8]
    end = start + table[:, 1:2] * axis / np.linalg.norm(axis, axis=1)[:, None]
    parent = table[:, 8].astype(int) - 1
    share = np.zeros(len(table))
    for child in np.flatnonzero(parent >= 0):
        along = end[parent[child]] - start[parent[child]]
        seat = (start[child] - start[parent[child]]) @ along / (along @ along)
        share[child] = 0.0 if seat < 0.02 else 1.0 if seat > 0.98 else seat
        start[child] = start[parent[child]] + share[child] * along
    nodes, beams = [start[0]], []
    foot = np.zeros(len(table), int)
    for row in range(len(table)):
        children = np.flatnonzero(parent == row)
        cuts = {0.0: foot[row]}
        for seat in sorted({*share[children], 1.0} - {0.0}):
            cuts[seat] = len(nodes)
            nodes.append(start[row] + seat * (end[row] - start[row]))
        seats = sorted(cuts)
        beams += [(cuts[a], cuts[b], table[row, 0]) for a, b in pairwise(seats)]
        foot[children] = [cuts[seat] for seat in share[children]]
    return Frame(np.array(nodes), beams)


def frame_frequencies(
    frame: Frame, modulus: float = 9.5e9, density: float = 800.0, count: int = 5, torsion: float = 1.0
) -> np.ndarray:
    """Lowest natural frequencies in Hz; ``torsion`` multiplies the torsional stiffness."""
    rows, columns, stiffness, mass = [], [], [], []
    for first, second, radius in frame.beams:
        k, m = _beam(frame.nodes[second] - frame.nodes[first], radius, modulus, density, torsion)
        freedom = np.concatenate((6 * first + np.arange(6), 6 * second + np.arange(6)))
        rows.append(np.repeat(freedom, 12))
        columns.append(np.tile(freedom, 12))
        stiffness.append(k.ravel())
        mass.append(m.ravel())
    size = 6 * len(frame.nodes)
    where = (np.concatenate(rows), np.concatenate(columns))
    k = csc_matrix((np.concatenate(stiffness), where), (size, size))[6:, 6:]
    m = csc_matrix((np.concatenate(mass), where), (size, size))[6:, 6:]
    start = np.random.default_rng(0).standard_normal(size - 6)
    values = eigsh(k, count, m, sigma=0.0, v0=start, return_eigenvectors=False)
    return np.sort(np.sqrt(values)) / (2.0 * np.pi)


def _beam(along: np.ndarray, radius: float, modulus: float, density: float, torsion: float):
    """(12, 12) stiffness and mass of a round beam in world axes."""
    length = np.linalg.norm(along)
    area, second = np.pi * radius**2, np.pi * radius**4 / 4
    shear = modulus / (2.0 * (1.0 + POISSON))
    k, m = np.zeros((12, 12)), np.zeros((12, 12))
    for freedom, rigidity, inertia in (
        (0, modulus * area, area),
        (3, torsion * shear * 2 * second, 2 * second),
    ):
        pair = np.ix_([freedom, freedom + 6], [freedom, freedom + 6])
        k[pair] += rigidity / length * np.array([[1, -1], [-1, 1]])
        m[pair] += density * inertia * length / 6 * np.array([[2, 1], [1, 2]])
    a = length
    bend = np.array(
        [
            [12, 6 * a, -12, 6 * a],
            [6 * a, 4 * a * a, -6 * a, 2 * a * a],
            [-12, -6 * a, 12, -6 * a],
            [6 * a, 2 * a * a, -6 * a, 4 * a * a],
        ]
    )
    sway = np.array(
        [
            [156, 22 * a, 54, -13 * a],
            [22 * a, 4 * a * a, 13 * a, -3 * a * a],
            [54, 13 * a, 156, -22 * a],
            [-13 * a, -3 * a * a, -22 * a, 4 * a * a],
        ]
    )
    for freedoms, sign in (([1, 5, 7, 11], 1.0), ([2, 4, 8, 10], -1.0)):
        turn = np.diag([1.0, sign, 1.0, sign])
        k[np.ix_(freedoms, freedoms)] += modulus * second / a**3 * turn @ bend @ turn
        m[np.ix_(freedoms, freedoms)] += density * area * a / 420 * turn @ sway @ turn
    x = along / length
    y = np.cross([0.0, 0.0, 1.0] if abs(x[2]) < 0.9 else [1.0, 0.0, 0.0], x)
    y /= np.linalg.norm(y)
    turn = np.kron(np.eye(4), np.array([x, y, np.cross(x, y)]))
    return turn.T @ k @ turn, turn.T @ m @ turn
