"""Scattering: distances kept, areas respected, densities shaped, full areas noticed."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist, pdist

from windswept.scene.area import Area, ellipse, rectangle
from windswept.scene.scatter import Ground, Sort, scatter, share_out

SQUARE = rectangle(-20.0, -20.0, 20.0, 20.0)
L_SHAPE = Area(np.array([[0.0, 0.0], [30.0, 0.0], [30.0, 10.0], [10.0, 10.0], [10.0, 30.0], [0.0, 30.0]]))


def throw(area: Area, sorts: list[Sort], seed: int = 0, into: float | None = None) -> list[np.ndarray]:
    ground = Ground()
    return scatter(area, sorts, ground, np.random.default_rng(seed), into)


def test_spacing_is_kept_within_and_between_sorts() -> None:
    trees, shrubs = throw(SQUARE, [Sort(30, 5.0), Sort(60, 2.0)])
    assert (len(trees), len(shrubs)) == (30, 60)
    assert pdist(trees).min() >= 5.0
    assert pdist(shrubs).min() >= 2.0
    assert cdist(trees, shrubs).min() >= 3.5


def test_earlier_plants_keep_their_distance() -> None:
    ground = Ground()
    ground.take(0.0, 0.0, 6.0)
    (places,) = scatter(SQUARE, [Sort(80, 2.0)], ground, np.random.default_rng(0))
    assert np.linalg.norm(places, axis=1).min() >= 4.0


@pytest.mark.parametrize("area", [SQUARE, L_SHAPE, ellipse(5.0, 3.0, 20.0, 8.0)])
def test_area_is_respected_and_filled(area: Area) -> None:
    (places,) = throw(area, [Sort(60, 1.0)])
    assert len(places) == 60
    assert area.contains(places).all()
    low, high = area.bounds
    assert ((places.max(axis=0) - places.min(axis=0)) > 0.8 * (high - low)).all()


def test_area_measures() -> None:
    assert L_SHAPE.surface == pytest.approx(500.0)
    assert ellipse(0.0, 0.0, 3.0, 2.0).surface == pytest.approx(np.pi * 6.0, rel=2e-3)
    inside = L_SHAPE.contains(np.array([[5.0, 25.0], [20.0, 20.0], [25.0, 5.0], [-1.0, 5.0]]))
    assert inside.tolist() == [True, False, True, False]
    assert SQUARE.edge_distance(np.array([[0.0, 0.0], [19.0, 3.0]])) == pytest.approx([20.0, 1.0])
    assert SQUARE.depth_along(np.array([[0.0, -20.0], [7.0, 10.0]]), np.pi / 2) == pytest.approx([0.0, 0.75])


def test_depth_bias_puts_shrubs_in_front_and_trees_behind() -> None:
    shrubs, trees = throw(SQUARE, [Sort(60, 1.0, -0.7), Sort(60, 1.0, 0.7)], into=np.pi / 2)
    assert shrubs[:, 1].mean() < -8.0
    assert trees[:, 1].mean() > 8.0


def test_depth_bias_without_a_direction_goes_inwards() -> None:
    edge, core = throw(SQUARE, [Sort(60, 1.0, -1.0), Sort(60, 1.0, 1.0)])
    assert SQUARE.edge_distance(edge).mean() < 0.5 * SQUARE.edge_distance(core).mean()


def test_a_full_area_gives_fewer() -> None:
    (places,) = throw(SQUARE, [Sort(500, 6.0)])
    # Random sequential packing of discs covers 0.547 of an endless plane; the discs' centres stay in the square,
    # so the ground they cover is more than the square and less than the square widened by a radius.
    discs = len(places) * np.pi * 3.0**2
    assert discs / 46.0**2 < 0.547 < discs / 40.0**2


def test_same_seed_same_places() -> None:
    first, second, other = (throw(SQUARE, [Sort(20, 3.0)], seed)[0] for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, second)
    assert not np.array_equal(first, other)


@settings(max_examples=50, deadline=None)
@given(st.integers(1, 500), st.lists(st.floats(0.01, 100.0), min_size=1, max_size=6))
def test_shares_add_up_and_follow_the_weights(count: int, weights: list[float]) -> None:
    shares = share_out(count, weights)
    assert sum(shares) == count
    exact = count * np.array(weights) / sum(weights)
    assert np.abs(np.array(shares) - exact).max() < 1.0 + 1e-9
