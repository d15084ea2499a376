"""Meshes of blades from their poses."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.geometry.blades import TUBE_SIDES, BladeSurface, blade_surface
from windswept.plants.underbrush import Blade, BladePose, build_blade, load_underbrush


def unbent(blade: Blade, count: int = 2) -> BladePose:
    """Blades along x in their base frame, the normal along y."""
    sections = blade.section_count
    joint = np.zeros((count, sections + 1, 3), np.float32)
    joint[:, 1:, 0] = np.cumsum(blade.length)
    frame = np.broadcast_to(np.eye(3, dtype=np.float32), (count, sections, 3, 3))
    return BladePose(joint, frame)


def face_normals(surface: BladeSurface) -> np.ndarray:
    corner = surface.vertices[0][surface.triangles]
    return np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


def component(index: int) -> Blade:
    return build_blade(load_underbrush("meadow_fescue").component[index])


@pytest.mark.parametrize("index", [0, 1])
def test_triangles_face_where_the_normals_point(index: int) -> None:
    blade = component(index)
    surface = blade_surface(blade, unbent(blade), np.ones(2, np.float32))
    normal = surface.normals[0][surface.triangles].mean(axis=1)
    assert (np.sum(face_normals(surface) * normal, axis=1) > 0.0).all()
    np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=2), 1.0, rtol=1e-5)


def test_a_strip_has_the_blades_area_and_borders() -> None:
    blade = component(0)
    surface = blade_surface(blade, unbent(blade), np.array([1.0, 2.0], np.float32))
    assert surface.vertices.shape == (2, 2 * (blade.section_count + 1), 3)
    area = 0.5 * np.linalg.norm(face_normals(surface), axis=1).sum()
    assert area == pytest.approx(blade.area.sum(), rel=0.05)
    np.testing.assert_allclose(surface.vertices[0, ::2, 2], blade.left[:, 2], rtol=1e-5)
    np.testing.assert_allclose(surface.vertices[1, 1::2, 2], 2.0 * blade.right[:, 2], rtol=1e-5)
    # The upper face is the one away from which it curls.
    np.testing.assert_allclose(surface.normals[0], np.tile([0.0, -1.0, 0.0], (len(surface.uv), 1)), atol=1e-6)
    assert surface.uv[0].tolist() == [0.0, 0.0]
    assert surface.uv[-1].tolist() == [1.0, 1.0]


def test_a_stalk_is_a_tube() -> None:
    blade = component(1)
    surface = blade_surface(blade, unbent(blade), np.ones(2, np.float32))
    assert surface.vertices.shape[1] == TUBE_SIDES * (blade.section_count + 1)
    radius = np.linalg.norm(surface.vertices[0, :, 1:], axis=1).reshape(-1, TUBE_SIDES)
    np.testing.assert_allclose(radius, np.tile(blade.left[:, 2:], TUBE_SIDES), rtol=1e-4)
    assert len(surface.triangles) == 2 * TUBE_SIDES * blade.section_count


def test_fewer_sections_take_fewer_borders() -> None:
    blade = component(0)
    fine = unbent(blade)
    coarse = BladePose(fine.joint[:, [0, 3, 6]], fine.frame[:, :2])
    surface = blade_surface(blade, coarse, np.ones(2, np.float32))
    assert surface.vertices.shape[1] == 6
    np.testing.assert_allclose(surface.vertices[0, ::2, 2], blade.left[[0, 3, 6], 2], rtol=1e-5)
