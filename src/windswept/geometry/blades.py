"""blade_surface: the reference mesh of blades from their pose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.plants.plant import Floats, Ints
from windswept.plants.underbrush import Blade, BladePose

TUBE_SIDES = 5
"""Corners of a stalk: it is millimetres thick."""


@dataclass(frozen=True, slots=True)
class BladeSurface:
    """One mesh topology with the vertices of B blades; V = (K + 1) x columns."""

    vertices: Floats
    """(B, V, 3) m; row after row from root to tip, across from the left border to the right, or round a stalk."""
    normals: Floats
    """(B, V, 3) unit normals of the upper face, or outwards."""
    uv: Floats
    """(V, 2) across 0 to 1, along 0 root to 1 tip."""
    triangles: Ints
    """(T, 3) counter-clockwise seen from where the normals point."""


def blade_surface(blade: Blade, pose: BladePose, size: Floats) -> BladeSurface:
    """Surface of blades of one kind: the border vectors added to the main axis (Endo, section 3.1).

    Args:
        blade: shape of size 1, with as many sections as the pose, or with more: then the borders between are left out.
        pose: where the sections are.
        size: (B,) length over that of the blade.
    """
    normal, side = _at_joints(pose.frame[:, :, 1]), _at_joints(pose.frame[:, :, 2])
    along = np.linspace(0.0, 1.0, pose.joint.shape[1])
    places = np.linspace(0.0, 1.0, len(blade.left))
    if blade.round:
        radius = np.interp(along, places, blade.left[:, 2]) * size[:, None] ** 1.5
        turn = np.linspace(0.0, 2.0 * np.pi, TUBE_SIDES, endpoint=False)
        normals = np.cos(turn)[:, None] * normal[:, :, None] + np.sin(turn)[:, None] * side[:, :, None]
        vertices = pose.joint[:, :, None] + radius[:, :, None, None] * normals
        across = turn / (2.0 * np.pi)
    else:
        border = np.stack(
            [np.interp(along, places, edge[:, 2]) for edge in (blade.left, blade.right)], axis=1
        )
        reach = border[None, :, :, None] * size[:, None, None, None]
        vertices = pose.joint[:, :, None] + reach * side[:, :, None]
        normals = np.broadcast_to(-normal[:, :, None], vertices.shape)
        across = np.array([0.0, 1.0])
    rows, columns = len(along), len(across)
    uv = np.stack(np.meshgrid(along, across, indexing="ij")[::-1], axis=2).reshape(-1, 2)
    return BladeSurface(
        vertices=vertices.reshape(len(size), -1, 3).astype(np.float32),
        normals=normals.reshape(len(size), -1, 3).astype(np.float32),
        uv=uv.astype(np.float32),
        triangles=_tube(rows, columns) if blade.round else _strip(rows),
    )


def _at_joints(vectors: Floats) -> Floats:
    """(B, K + 1, 3) unit vectors at the joints from those of the sections (B, K, 3) on either side."""
    ends = np.concatenate([vectors[:, :1], vectors, vectors[:, -1:]], axis=1)
    mean = ends[:, :-1] + ends[:, 1:]
    return mean / np.maximum(np.linalg.norm(mean, axis=2, keepdims=True), 1e-12)


def _strip(rows: int) -> Ints:
    """Triangles of a strip of pairs (left, right), seen from the upper face, which is opposite to the normal."""
    left = 2 * np.arange(rows - 1)[:, None]
    return np.concatenate([left + np.array([0, 1, 2]), left + np.array([1, 3, 2])]).astype(np.int32)


def _tube(rows: int, sides: int) -> Ints:
    """Triangles of a tube open at both ends, seen from outside."""
    row, corner = (a.ravel() for a in np.meshgrid(np.arange(rows - 1), np.arange(sides), indexing="ij"))
    here, there = row * sides + corner, row * sides + (corner + 1) % sides
    first = np.stack([here, there, here + sides], axis=1)
    return np.concatenate([first, np.stack([there, there + sides, here + sides], axis=1)]).astype(np.int32)
