"""export_obj: a plant at rest as a Wavefront OBJ mesh, +Z up, metres, one group for bark and one for leaves."""

from __future__ import annotations

from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from windswept.forms.files import written_whole
from windswept.geometry.bark import bark_surface
from windswept.geometry.curves import build_geometry
from windswept.geometry.geometry import Geometry, PosedCurves
from windswept.geometry.leaves import LEAF_SHAPES, leaf_mesh
from windswept.geometry.pose_curves import pose_curves
from windswept.plants.plant import Plant
from windswept.plants.pose import rest_pose

Doubles = NDArray[np.float64]
Indices = NDArray[np.int64]

MESHES = ((0.05, 16, 16), (0.015, 8, 6), (0.004, 5, 4), (0.0, 3, 3))
"""Sides of a stem, and steps along each of its Bezier pieces, by its least radius in m."""
CHUNK = 20_000
"""Pieces that are meshed at a time."""


def export_obj(plant: Plant, path: Path) -> None:
    """Write a plant at rest; the file appears whole or not at all.

    Raises:
        InputError: the file cannot be written.
    """
    with written_whole(path) as unfinished, unfinished.open("w", encoding="ascii") as stream:
        _write(plant, stream)


def _write(plant: Plant, stream: IO[str]) -> None:
    """Header, bark, leaves."""
    geometry = build_geometry(plant)
    curves = pose_curves(geometry, plant.link_base, rest_pose(plant))
    stream.write(f"# {plant.species}, seed {plant.seed}: metres, +Z up\n")
    stream.write("g bark\n")
    written = 0
    for sides, steps, pieces in _by_thickness(geometry):
        for start in range(0, len(pieces), CHUNK):
            vertices, faces = _tubes(geometry, curves, pieces[start : start + CHUNK], sides, steps)
            _write_mesh(stream, vertices, faces + written)
            written += len(vertices)
    if plant.leaf_count:
        stream.write("g leaves\n")
        vertices, faces = _leaves(plant, geometry, curves)
        _write_mesh(stream, vertices, faces + written)


def _by_thickness(geometry: Geometry) -> list[tuple[int, int, Indices]]:
    """Numbers of sides and steps, and the pieces of the stems that are drawn with them."""
    radius = geometry.stem_radius[geometry.piece_stem]
    groups, upper = [], np.inf
    for least, sides, steps in MESHES:
        groups.append((sides, steps, np.flatnonzero((radius >= least) & (radius < upper))))
        upper = least
    return groups


def _tubes(
    geometry: Geometry, curves: PosedCurves, pieces: Indices, sides: int, steps: int
) -> tuple[Doubles, Indices]:
    """(n, 3) vertices and (m, 3) triangles of open tubes round some pieces."""
    rings = steps + 1
    piece = np.repeat(pieces, rings * sides).astype(np.int32)
    t = np.tile(np.repeat(np.linspace(0.0, 1.0, rings), sides), len(pieces))
    angle = np.tile(2.0 * np.pi * np.arange(sides) / sides, len(pieces) * rings)
    position = bark_surface(geometry, curves, 0, piece, t, angle).position
    side = np.arange(sides)
    low, right = side, (side + 1) % sides
    first, second = np.stack((low, right, right + sides), 1), np.stack((low, right + sides, low + sides), 1)
    ring = np.concatenate((first, second))
    tube = (ring[None] + sides * np.arange(steps)[:, None, None]).reshape(-1, 3)
    faces = tube[None] + rings * sides * np.arange(len(pieces))[:, None, None]
    return position, faces.reshape(-1, 3)


def _leaves(plant: Plant, geometry: Geometry, curves: PosedCurves) -> tuple[Doubles, Indices]:
    """(n, 3) vertices and (m, 3) triangles of all leaves, moved with the stems that carry them."""
    mesh = leaf_mesh(1)
    blade = mesh.vertices[LEAF_SHAPES.index(plant.look.leaf_shape)].astype(np.float64)
    axis, normal = plant.leaf_axis.astype(np.float64), plant.leaf_normal.astype(np.float64)
    across = np.cross(axis, normal) * plant.leaf_width[:, None]
    frame = np.stack((across, axis * plant.leaf_length[:, None], normal * plant.leaf_width[:, None]), axis=1)
    base = plant.leaf_position + curves.shift[0, geometry.leaf_stem]
    vertices = base[:, None] + np.einsum("vk,nkj->nvj", blade, frame)
    faces = mesh.triangles[None] + len(blade) * np.arange(plant.leaf_count)[:, None, None]
    return vertices.reshape(-1, 3), faces.reshape(-1, 3).astype(np.int64)


def _write_mesh(stream: IO[str], vertices: Doubles, faces: Indices) -> None:
    """Vertices and triangles; OBJ counts from 1."""
    np.savetxt(stream, vertices, fmt="v %.6f %.6f %.6f")
    np.savetxt(stream, faces + 1, fmt="f %d %d %d")
