from __future__ import annotations

import numpy as np

from shaken import shaken_pose
from windswept.geometry.pose_curves import curve_points, pose_curves
from windswept.plants.pose import Pose, rest_pose


def test_calm_plants_stand_where_they_were_fitted(plant, geometry):
    curves = pose_curves(geometry, plant.link_base, rest_pose(plant, 2))
    at_rest = geometry.piece_points + curves.shift[:, geometry.piece_stem][:, :, None]
    np.testing.assert_allclose(curves.points, at_rest, atol=2e-6)


def test_no_gap_opens_where_a_stem_grows_out_of_another(plant, geometry):
    curves = pose_curves(geometry, plant.link_base, shaken_pose(plant, 1, angle=0.4))
    child = np.flatnonzero(geometry.stem_parent >= 0)
    base = curves.points[:, geometry.stem_piece_start[child], 0]
    on_parent = curve_points(
        curves.points[:, geometry.stem_attach_piece[child]], geometry.stem_attach_t[child]
    )
    assert np.abs(base - on_parent).max() <= 1e-5


def test_handles_are_unit_and_square_to_their_legs(plant, geometry):
    """PHYSICS C1.2: |S_i| = 1 and S_i . L_i = 0; then |T_i| = 1 and det [L, T, S] = +1 with T = S x L."""
    curves = pose_curves(geometry, plant.link_base, shaken_pose(plant, 2, angle=0.3))
    legs = np.diff(curves.points, axis=2)
    legs /= np.linalg.norm(legs, axis=-1, keepdims=True)
    np.testing.assert_allclose(np.linalg.norm(curves.sides, axis=-1), 1.0, atol=1e-5)
    assert np.abs(np.sum(curves.sides * legs, axis=-1)).max() < 1e-5
    tops = np.cross(curves.sides, legs)
    determinant = np.sum(legs * np.cross(tops, curves.sides), axis=-1)
    np.testing.assert_allclose(determinant, 1.0, atol=1e-5)


def test_curves_stay_smooth_where_pieces_meet(plant, geometry):
    curves = pose_curves(geometry, plant.link_base, shaken_pose(plant, 3, angle=0.4))
    meets = np.flatnonzero(np.diff(geometry.piece_stem) == 0)
    before = curves.points[:, meets, 3] - curves.points[:, meets, 2]
    after = curves.points[:, meets + 1, 1] - curves.points[:, meets + 1, 0]
    lengths = np.linalg.norm(before, axis=-1) * np.linalg.norm(after, axis=-1)
    np.testing.assert_allclose(np.sum(before * after, axis=-1) / lengths, 1.0, atol=1e-4)
    np.testing.assert_allclose(curves.points[:, meets, 3], curves.points[:, meets + 1, 0], atol=1e-5)
    np.testing.assert_allclose(curves.sides[:, meets, 2], curves.sides[:, meets + 1, 0], atol=1e-3)


def test_the_turn_of_a_whole_plant_carries_everything(plant, geometry):
    """A rotation of the trunk's first link, handed to all links, is a rigid rotation of the drawn form."""
    quaternion = np.array([0.1, -0.2, 0.3, np.sqrt(1 - 0.14)], np.float32)
    x, y, z, w = quaternion
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    rest = rest_pose(plant)
    link = rest.link.copy()
    link[0, :, :3] = plant.link_base @ rotation.T
    link[0, :, 4:] = quaternion
    calm = pose_curves(geometry, plant.link_base, rest)
    turned = pose_curves(geometry, plant.link_base, Pose(link))
    np.testing.assert_allclose(turned.points, calm.points @ rotation.T, atol=2e-5)
