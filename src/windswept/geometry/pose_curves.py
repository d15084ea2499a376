"""(Geometry, Pose) -> PosedCurves in plain NumPy: the formula that ``gpu/curves.wgsl`` computes on the card."""

from __future__ import annotations

import numpy as np

from windswept.geometry.geometry import Geometry, PosedCurves
from windswept.plants.plant import Floats
from windswept.plants.pose import Pose


def pose_curves(geometry: Geometry, link_base: Floats, pose: Pose) -> PosedCurves:
    """Carry every control point by its link, then move each stem so that it grows out of its parent's curve.

    With C the unshifted curve of the parent, t where stem s grows out and b its rigid base, a stem is
    displaced from its parent by d(s) = C(t) - b; its shift is the sum of d over itself and its ancestors.

    Args:
        geometry: Q pieces and S stems at rest.
        link_base: (L, 3) joints of the plant at rest, m.
        pose: where the links of P placements are now.
    """
    points = _carry_points(geometry, link_base, pose)
    shift = _stem_shifts(geometry, points, pose)
    points += shift[:, geometry.piece_stem][:, :, None]
    return PosedCurves(points, _sides(geometry, points, pose), shift)


def _carry_points(geometry: Geometry, link_base: Floats, pose: Pose) -> Floats:
    """(P, Q, 4, 3) control points carried by their links, before any shift, m."""
    carrier = np.repeat(geometry.piece_link, 2, axis=1)
    offset = geometry.piece_points - link_base[carrier]
    return pose.position[:, carrier] + rotate(pose.rotation[:, carrier], offset)


def _stem_shifts(geometry: Geometry, points: Floats, pose: Pose) -> Floats:
    """(P, S, 3) shift of every stem, m."""
    shift = np.zeros((len(points), geometry.stem_count, 3), np.float32)
    for depth in range(1, int(geometry.stem_depth.max()) + 1):
        stems = np.flatnonzero(geometry.stem_depth == depth)
        on_parent = curve_points(points[:, geometry.stem_attach_piece[stems]], geometry.stem_attach_t[stems])
        base = pose.position[:, geometry.stem_link[stems]]
        shift[:, stems] = shift[:, geometry.stem_parent[stems]] + on_parent - base
    return shift


def _sides(geometry: Geometry, points: Floats, pose: Pose) -> Floats:
    """(P, Q, 3, 3) handles S0, S1, S2, each perpendicular to its leg of the control polygon."""
    legs = np.diff(points, axis=2)
    legs /= np.linalg.norm(legs, axis=-1, keepdims=True)
    ends = rotate(pose.rotation[:, geometry.piece_link], geometry.piece_side)
    start, end = ends[:, :, 0], ends[:, :, 1]
    return np.stack(
        [
            perpendicular(start, legs[:, :, 0]),
            perpendicular(start + end, legs[:, :, 1]),
            perpendicular(end, legs[:, :, 2]),
        ],
        axis=2,
    )


def curve_points(points: Floats, t: Floats) -> Floats:
    """(..., n, 3) points at parameters t (n,) of n cubics with control points (..., n, 4, 3)."""
    s = 1.0 - t
    weights = np.stack([s**3, 3 * s * s * t, 3 * s * t * t, t**3], axis=-1)
    return np.einsum("ni,...nik->...nk", weights, points)


def rotate(quaternion: Floats, vector: Floats) -> Floats:
    """(..., 3) vectors (..., 3) turned by unit quaternions (..., 4) in the order x, y, z, w."""
    axis, scalar = quaternion[..., :3], quaternion[..., 3:]
    twice = 2.0 * np.cross(axis, vector)
    return vector + scalar * twice + np.cross(axis, twice)


def perpendicular(vector: Floats, direction: Floats) -> Floats:
    """(..., 3) unit part of a vector that is perpendicular to a unit direction."""
    across = vector - np.sum(vector * direction, axis=-1, keepdims=True) * direction
    return across / np.linalg.norm(across, axis=-1, keepdims=True)
