"""Leaf meshes: a blade folded along its midrib with a drooping tip, in as many triangles as its size deserves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from windswept.plants.plant import Floats, Ints

LEAF_SHAPES = ("oval", "round", "lance", "lobed", "needle")
"""Names of ``Look.leaf_shape``, in the order of the mesh tables."""
FOLD = 0.35
"""Rise of a leaf's edge over its distance from the midrib."""
DROOP = 0.22
"""Fall of the tip below the plane of the leaf's base, over its length."""


@dataclass(frozen=True, slots=True)
class LeafMesh:
    """One mesh topology with the vertices of every leaf shape. Axes: x across, y base to tip, z out of the face."""

    vertices: Floats
    """(shapes, V, 3) vertices of a leaf of length and width 1, base at the origin."""
    normals: Floats
    """(shapes, V, 3) unit normals of the upper face."""
    triangles: Ints
    """(T, 3) vertex numbers, counter-clockwise seen from the upper face."""


def leaf_mesh(stations: int) -> LeafMesh:
    """Blade with this many pairs of edge points between its base and its tip.

    Args:
        stations: 1 gives a kite of two triangles; 3 a blade of ten with its own curl.
    """
    triangles = _kite() if stations == 1 else _strip(stations)
    vertices = np.stack([_vertices(_OUTLINES[shape], stations) for shape in LEAF_SHAPES])
    normals = np.stack([_normals(blade, triangles) for blade in vertices])
    return LeafMesh(vertices.astype(np.float32), normals.astype(np.float32), triangles)


def _vertices(outline: Callable[[Floats], Floats], stations: int) -> Floats:
    """(V, 3): base, tip, then left, right and, if there are several stations, midrib at each."""
    along = (np.arange(stations) + 1.0) / (stations + 1.0)
    if stations == 1:
        along = np.array([0.45])
    half = outline(along)
    left = np.stack([-half, along, FOLD * half - DROOP * along**2], axis=1)
    right = left * (-1.0, 1.0, 1.0)
    middle = np.stack([0.0 * along, along, -DROOP * along**2], axis=1)
    rows = [left, right] if stations == 1 else [left, right, middle]
    ends = np.array([[0.0, 0.0, 0.0], [0.0, 1.0, -DROOP]])
    return np.concatenate([ends, np.stack(rows, axis=1).reshape(-1, 3)])


def _kite() -> Ints:
    base, tip, left, right = range(4)
    return np.array([(base, tip, left), (base, right, tip)], np.int32)


def _strip(stations: int) -> Ints:
    """Triangles between base, the rows (left, right, middle) and tip."""
    base, tip = 0, 1
    rows = [(2 + 3 * k, 3 + 3 * k, 4 + 3 * k) for k in range(stations)]
    left, right, middle = rows[0]
    faces = [(base, middle, left), (base, right, middle)]
    for (l0, r0, m0), (l1, r1, m1) in pairwise(rows):
        faces += [(l0, m0, l1), (m0, m1, l1), (m0, r0, m1), (r0, r1, m1)]
    left, right, middle = rows[-1]
    faces += [(left, middle, tip), (middle, right, tip)]
    return np.array(faces, np.int32)


def _normals(vertices: Floats, triangles: Ints) -> Floats:
    """(V, 3) area-weighted vertex normals."""
    corner = vertices[triangles]
    face = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, triangles[:, k], face)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def _oval(along: Floats) -> Floats:
    return 0.5 * np.sin(np.pi * along**0.85) ** 0.8


def _round(along: Floats) -> Floats:
    return 0.5 * np.sqrt(np.maximum(1.0 - (2.0 * along - 0.95) ** 2, 0.0)) * (1.0 + 0.12 * (0.5 - along))


def _lance(along: Floats) -> Floats:
    return 0.5 * np.sin(np.pi * along**0.7)


def _lobed(along: Floats) -> Floats:
    return 0.5 * np.sin(np.pi * along) ** 0.6 * (0.72 + 0.28 * np.cos(6.0 * np.pi * along))


def _needle(along: Floats) -> Floats:
    return 0.5 * np.minimum(1.0, 6.0 * (1.0 - along))


_OUTLINES: dict[str, Callable[[Floats], Floats]] = {
    "oval": _oval,
    "round": _round,
    "lance": _lance,
    "lobed": _lobed,
    "needle": _needle,
}
"""Half-width of each shape over its width, by the distance from the base over the length."""
