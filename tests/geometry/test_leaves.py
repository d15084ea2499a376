from __future__ import annotations

import numpy as np
import pytest

from windswept.geometry.leaves import LEAF_SHAPES, leaf_mesh


@pytest.mark.parametrize("stations", [1, 3, 5])
def test_a_blade_faces_up_and_stays_within_its_size(stations):
    mesh = leaf_mesh(stations)
    assert mesh.vertices.shape[0] == len(LEAF_SHAPES)
    assert (mesh.vertices[..., 1] >= 0.0).all()
    assert (mesh.vertices[..., 1] <= 1.0).all()
    assert np.abs(mesh.vertices[..., 0]).max() <= 0.56
    corner = mesh.vertices[:, mesh.triangles]
    face = np.cross(corner[:, :, 1] - corner[:, :, 0], corner[:, :, 2] - corner[:, :, 0])
    assert (face[..., 2] > 0.0).all()
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=2), 1.0, atol=1e-6)


def test_finer_meshes_have_more_triangles():
    counts = [len(leaf_mesh(stations).triangles) for stations in (1, 3, 5)]
    assert counts == [2, 12, 20]
