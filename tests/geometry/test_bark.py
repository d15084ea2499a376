from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from shaken import shaken_pose
from windswept.geometry.bark import bark_surface, deformer, stem_radius
from windswept.geometry.pose_curves import pose_curves


@pytest.fixture(scope="module")
def curves(plant, geometry):
    return pose_curves(geometry, plant.link_base, shaken_pose(plant, 5, angle=0.15))


@pytest.fixture(scope="module")
def samples(geometry):
    rng = np.random.default_rng(0)
    count = 500
    return (
        rng.integers(0, geometry.piece_count, count),
        rng.uniform(0.02, 0.98, count),
        rng.uniform(0.0, 2.0 * np.pi, count),
    )


def de_casteljau(points, sides, t, v, w):
    """Skjermo eq. 9: offsets along the handles at the first level, plain interpolation below."""
    legs = np.diff(points, axis=0)
    tops = np.cross(sides, legs / np.linalg.norm(legs, axis=1, keepdims=True))
    rows = [points[i] + t * legs[i] + v * sides[i] + w * tops[i] for i in range(3)]
    rows = [rows[i] + t * (rows[i + 1] - rows[i]) for i in range(2)]
    return rows[0] + t * (rows[1] - rows[0])


def test_the_closed_form_is_the_generalized_de_casteljau_loop(curves):
    points, sides = curves.points[0].astype(float), curves.sides[0].astype(float)
    t = np.linspace(0.0, 1.0, len(points))
    v, w = 0.1 * np.sin(7.0 * t), 0.1 * np.cos(3.0 * t)
    form = deformer(points, sides, t)
    closed = form.curve + v[:, None] * form.handles[0] + w[:, None] * form.handles[1]
    loop = [de_casteljau(*each) for each in zip(points, sides, t, v, w, strict=True)]
    np.testing.assert_allclose(closed, loop, atol=1e-6)


def test_a_stem_without_radius_is_its_curve(geometry, curves, samples):
    bare = replace(geometry, stem_radius=np.zeros_like(geometry.stem_radius))
    piece, t, angle = samples
    surface = bark_surface(bare, curves, 0, piece, t, angle)
    form = deformer(curves.points[0, piece], curves.sides[0, piece], t)
    np.testing.assert_allclose(surface.position, form.curve, atol=1e-12)


def test_the_first_ring_has_the_radius_of_the_profile(geometry, curves):
    """PHYSICS C1.2: at t = 0 the ring's radius is taper times flare at every branch angle."""
    first = geometry.stem_piece_start[:-1]
    start = np.zeros(len(first))
    smooth = replace(geometry, stem_lobe_depth=np.zeros_like(geometry.stem_lobe_depth))
    for angle in (0.0, 1.0, 4.0):
        surface = bark_surface(smooth, curves, 0, first, start, np.full(len(first), angle))
        radius = np.linalg.norm(surface.position - curves.points[0, first, 0], axis=1)
        expected = stem_radius(smooth, geometry.piece_stem[first], start)
        np.testing.assert_allclose(radius, expected, atol=1e-5)


def test_tangents_are_the_derivatives_of_the_surface(geometry, curves, samples):
    piece, t, angle = samples
    step = 1e-5
    surface = bark_surface(geometry, curves, 0, piece, t, angle)
    ahead = bark_surface(geometry, curves, 0, piece, t + step, angle).position
    behind = bark_surface(geometry, curves, 0, piece, t - step, angle).position
    np.testing.assert_allclose(surface.tangent_along, (ahead - behind) / (2 * step), atol=2e-4)
    ahead = bark_surface(geometry, curves, 0, piece, t, angle + step).position
    behind = bark_surface(geometry, curves, 0, piece, t, angle - step).position
    np.testing.assert_allclose(surface.tangent_round, (ahead - behind) / (2 * step), atol=1e-6)


def test_normals_point_out_of_the_stem(geometry, curves, samples):
    piece, t, angle = samples
    surface = bark_surface(geometry, curves, 0, piece, t, angle)
    outwards = surface.position - deformer(curves.points[0, piece], curves.sides[0, piece], t).curve
    wide = np.linalg.norm(outwards, axis=1) > 1e-6
    assert (np.sum(surface.normal * outwards, axis=1)[wide] > 0.0).all()


@pytest.mark.parametrize(
    ("degrees", "least"), [(10, 0.998), (30, 0.983), (60, 0.933), (90, 0.854), (120, 0.750)]
)
def test_a_bend_thins_the_stem_by_the_known_amount(degrees, least):
    """PHYSICS B7: the minimum of |S(t)| in the bend's plane, by the total bend of a piece."""
    half = np.radians(degrees) / 2.0
    turns = [-half, 0.0, half]
    legs = np.array([[np.sin(a), 0.0, np.cos(a)] for a in turns])
    points = np.concatenate([np.zeros((1, 3)), np.cumsum(legs, axis=0)])
    sides = np.array([[np.cos(a), 0.0, -np.sin(a)] for a in turns])
    t = np.linspace(0.0, 1.0, 1001)
    form = deformer(np.repeat(points[None], 1001, 0), np.repeat(sides[None], 1001, 0), t)
    assert np.linalg.norm(form.handles[0], axis=1).min() == pytest.approx(least, abs=6e-4)
