from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from handmade import build_plant, straight
from windswept.geometry.curves import FIT_TOLERANCE, build_geometry
from windswept.geometry.fit import grown_tangents, sample_grown
from windswept.geometry.pose_curves import curve_points


def grown_samples(plant, stem):
    first, end = plant.stem_link_start[stem : stem + 2]
    nodes = np.vstack([plant.link_base[first], plant.link_tip[first:end]]).astype(float)
    points, knots = np.empty((4 * (end - first) + 1, 3)), np.empty(4 * (end - first) + 1)
    sample_grown(nodes, grown_tangents(nodes), 0, end - first, points, knots)
    return points


def drawn_samples(geometry, stem, count=400):
    t = np.linspace(0.0, 1.0, count, dtype=np.float32)
    pieces = np.arange(geometry.stem_piece_start[stem], geometry.stem_piece_start[stem + 1])
    return np.concatenate([curve_points(np.repeat(geometry.piece_points[[k]], count, 0), t) for k in pieces])


def test_every_stem_is_drawn_within_the_tolerance(plant, geometry):
    for stem in range(0, plant.stem_count, 7):
        gap, _ = cKDTree(drawn_samples(geometry, stem)).query(grown_samples(plant, stem))
        assert gap.max() <= (FIT_TOLERANCE + 0.002) * geometry.stem_reach[stem]


def test_a_finer_tolerance_takes_more_pieces(plant):
    counts = [build_geometry(plant, tolerance).piece_count for tolerance in (1.0, 0.01, 0.0)]
    assert counts[0] == plant.stem_count
    assert counts[0] < counts[1] < counts[2] <= plant.link_count


def test_ends_of_stems_are_ends_of_links(plant, geometry):
    first, last = geometry.stem_piece_start[:-1], geometry.stem_piece_start[1:] - 1
    start, end = plant.stem_link_start[:-1], plant.stem_link_start[1:] - 1
    np.testing.assert_allclose(geometry.piece_points[first, 0], plant.link_base[start], atol=1e-6)
    np.testing.assert_allclose(geometry.piece_points[last, 3], plant.link_tip[end], atol=1e-6)
    np.testing.assert_array_equal(geometry.piece_span[first, 0], 0.0)
    np.testing.assert_allclose(geometry.piece_span[last, 1], 1.0, atol=1e-6)


def test_pieces_meet_in_stations(geometry):
    """At a station both sides share point, tangent, side vector and carrying link."""
    meets = np.flatnonzero(np.diff(geometry.piece_stem) == 0)
    points, sides = geometry.piece_points, geometry.piece_side
    np.testing.assert_allclose(points[meets, 3], points[meets + 1, 0], atol=1e-6)
    before, after = points[meets, 3] - points[meets, 2], points[meets + 1, 1] - points[meets + 1, 0]
    cosine = np.sum(before * after, 1) / np.linalg.norm(before, axis=1) / np.linalg.norm(after, axis=1)
    np.testing.assert_allclose(cosine, 1.0, atol=1e-5)
    np.testing.assert_allclose(sides[meets, 1], sides[meets + 1, 0], atol=1e-6)
    np.testing.assert_array_equal(geometry.piece_link[meets, 1], geometry.piece_link[meets + 1, 0])


def test_side_vectors_are_unit_and_square_to_the_curve(geometry):
    np.testing.assert_allclose(np.linalg.norm(geometry.piece_side, axis=2), 1.0, atol=1e-5)
    start = geometry.piece_points[:, 1] - geometry.piece_points[:, 0]
    end = geometry.piece_points[:, 3] - geometry.piece_points[:, 2]
    assert np.abs(np.sum(geometry.piece_side[:, 0] * start, 1)).max() < 1e-5
    assert np.abs(np.sum(geometry.piece_side[:, 1] * end, 1)).max() < 1e-5


@pytest.mark.parametrize("degrees", [90, 60, 30, 10, 2, 0])
def test_side_of_a_child_is_unit_at_every_branch_angle(degrees):
    """PHYSICS C1.2: L0 x O alone has the length sin(angle)."""
    angle = np.radians(degrees)
    trunk = straight(2.0, 4, 0.05)
    child = straight(
        1.0, 3, 0.02, direction=(np.sin(angle), 0.0, np.cos(angle)), origin=np.array([0, 0, 0.75])
    )
    trunk.children.append((1, 0.5, child))
    geometry = build_geometry(build_plant(trunk))
    np.testing.assert_allclose(np.linalg.norm(geometry.piece_side, axis=2), 1.0, atol=1e-6)


def test_a_child_grows_out_of_the_nearest_point_of_its_parent(plant, geometry):
    child = np.flatnonzero(geometry.stem_parent >= 0)
    piece, base = geometry.stem_attach_piece[child], plant.link_base[geometry.stem_link[child]]
    assert (geometry.piece_stem[piece] == geometry.stem_parent[child]).all()

    def distance(t):
        return np.linalg.norm(curve_points(geometry.piece_points[piece], t) - base, axis=1)

    nearest = np.min([distance(np.full(len(child), t)) for t in np.linspace(0.0, 1.0, 200)], axis=0)
    size = geometry.stem_reach[geometry.stem_parent[child]]
    assert (distance(geometry.stem_attach_t[child]) <= nearest + 1e-4 * size).all()


def test_ranks_are_a_shuffle_and_openness_a_share(geometry):
    np.testing.assert_array_equal(np.sort(geometry.leaf_rank), np.arange(geometry.leaf_count))
    for openness in (geometry.leaf_openness, geometry.piece_openness):
        assert (openness >= 0.0).all()
        assert (openness <= 1.0 + 1e-6).all()
    np.testing.assert_allclose(np.linalg.norm(geometry.leaf_outward, axis=1), 1.0, atol=1e-5)


def test_the_top_of_a_crown_sees_more_sky_than_its_heart(aspen):
    height = aspen.leaf_position[:, 2]
    aside = np.hypot(*aspen.leaf_position[:, :2].T)
    top = aspen.leaf_openness[height > np.quantile(height, 0.95)].mean()
    heart = aspen.leaf_openness[(aside < np.quantile(aside, 0.2)) & (height < np.median(height))].mean()
    assert top > 2.0 * heart
