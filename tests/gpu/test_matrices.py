from __future__ import annotations

import numpy as np
import pytest

from windswept.gpu.daylight import daylight
from windswept.gpu.frame import Camera, Ground
from windswept.gpu.grass_field import grass_field
from windswept.gpu.ground_mesh import HORIZON, ground_height, ground_mesh
from windswept.gpu.matrices import NEAR, camera_matrix, frustum_planes, shadow_ball, sun_matrix
from windswept.gpu.noise import noise_levels

CAMERA = Camera((1.0, -8.0, 3.0), (0.0, 0.0, 2.0), 0.8)


def clip(matrix, point):
    x, y, z, w = matrix @ np.append(point, 1.0)
    return np.array([x, y, z]) / w


def test_the_target_is_at_the_centre_and_up_is_up():
    matrix = camera_matrix(CAMERA, 1.5)
    np.testing.assert_allclose(clip(matrix, CAMERA.target)[:2], 0.0, atol=1e-12)
    above = np.add(CAMERA.target, (0.0, 0.0, 0.5))
    assert clip(matrix, above)[1] > 0.0


def test_depth_is_near_over_distance():
    matrix = camera_matrix(CAMERA, 1.5)
    forward = np.array(CAMERA.target) - CAMERA.eye
    forward /= np.linalg.norm(forward)
    for distance in (NEAR, 1.0, 500.0):
        assert clip(matrix, np.array(CAMERA.eye) + distance * forward)[2] == pytest.approx(NEAR / distance)


def test_planes_hold_what_the_camera_sees():
    planes = frustum_planes(camera_matrix(CAMERA, 1.5))
    inside = planes[:, :3] @ CAMERA.target + planes[:, 3]
    assert (inside > 0.0).all()
    behind = 2.0 * np.array(CAMERA.eye) - CAMERA.target
    assert (planes[:, :3] @ behind + planes[:, 3]).min() < 0.0


def test_the_shadow_map_moves_by_whole_texels():
    sun = np.array([0.3, -0.4, 0.866])
    point = np.array([2.0, 1.0, 0.5])
    places = []
    for step in np.linspace(0.0, 1.0, 7):
        matrix = sun_matrix(sun, np.array([step, 0.3 * step, 0.0]), 40.0, 100.0, 1024)
        places.append(clip(matrix, point)[:2] * 512.0)
    shifts = np.array(places) - places[0]
    np.testing.assert_allclose(shifts, np.round(shifts), atol=1e-6)


def test_points_nearer_to_the_sun_are_nearer_in_the_shadow_map():
    sun = np.array([0.3, -0.4, 0.866])
    matrix = sun_matrix(sun, np.zeros(3), 40.0, 100.0, 1024)
    assert clip(matrix, 5.0 * sun)[2] < clip(matrix, np.zeros(3))[2] < clip(matrix, -5.0 * sun)[2]


def test_the_shadow_ball_holds_the_near_view():
    centre, radius = shadow_ball(CAMERA, 1.5, 60.0)
    inverse = np.linalg.inv(camera_matrix(CAMERA, 1.5))
    for x in (-1.0, 1.0):
        for y in (-1.0, 1.0):
            corner = inverse @ (x, y, NEAR / 60.0, 1.0)
            assert np.linalg.norm(corner[:3] / corner[3] - centre) <= radius + 1e-6


def test_a_low_sun_is_redder_and_weaker():
    noon, evening = (daylight(np.array([np.cos(h), 0.0, np.sin(h)])) for h in (1.2, 0.08))
    assert evening.sun.sum() < noon.sun.sum()
    assert evening.sun[0] / evening.sun[2] > 2.0 * noon.sun[0] / noon.sun[2]


def hilly() -> Ground:
    x = np.linspace(-30.0, 30.0, 31)
    return Ground((np.sin(x / 7.0) + np.cos(x / 9.0)[:, None]).astype(np.float32), (-30.0, -30.0), 2.0)


def test_the_ground_passes_through_its_heights_and_reaches_the_horizon():
    ground = hilly()
    mesh = ground_mesh(ground)
    inside = np.abs(mesh.vertices[:, :2]).max(axis=1) <= 30.0
    expected = ground_height(ground, mesh.vertices[inside, 0], mesh.vertices[inside, 1])
    np.testing.assert_allclose(mesh.vertices[inside, 2], expected, atol=1e-4)
    assert np.abs(mesh.vertices[:, 0]).max() > HORIZON
    corner = mesh.vertices[mesh.triangles, :3]
    face = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    assert (face[:, 2] > 0.0).all()


def test_grass_stands_still_while_the_camera_passes():
    """A blade belongs to a place: those near two cameras are the same blades."""
    fields = []
    for x in (0.0, 0.4):
        camera = Camera((x, -5.0, 1.5), (x, 5.0, 0.0), 0.9)
        planes = frustum_planes(camera_matrix(camera, 1.5))
        fields.append(grass_field(hilly(), np.array(camera.eye), planes))
    first, second = ({tuple(root) for root in field["root"][:, :3].tolist()} for field in fields)
    assert len(first & second) > 0.6 * len(first)


def test_noise_spreads_over_its_range_and_has_all_its_levels():
    levels = noise_levels()
    assert [len(level) for level in levels] == [512 >> k for k in range(10)]
    assert np.abs(levels[0].mean((0, 1)) - 127.0).max() < 40.0
    assert levels[0].std((0, 1)).min() > 40.0
