"""Ground: levels, smoothness, and that the height between grid points is that of what is drawn."""

import numpy as np
import pytest

from windswept.scene.terrain import Terrain, flat_terrain, hilly_terrain


def hills(seed: int = 1, size: float = 200.0, relief: float = 6.0) -> Terrain:
    return hilly_terrain(size, relief, 80.0, np.random.default_rng(seed))


def test_flat_ground_is_level() -> None:
    terrain = flat_terrain(50.0)
    assert not terrain.height(np.linspace(-30.0, 30.0, 7), np.zeros(7)).any()
    assert terrain.grid().shape == (2, 2, 3)


def test_hills_have_the_asked_relief_around_zero() -> None:
    terrain = hills()
    assert np.ptp(terrain.heights) == pytest.approx(6.0, rel=1e-5)
    assert terrain.heights.mean() == pytest.approx(0.0, abs=1e-5)


def test_height_passes_through_the_drawn_grid() -> None:
    terrain = hills()
    grid = terrain.grid().reshape(-1, 3)
    np.testing.assert_allclose(terrain.height(grid[:, 0], grid[:, 1]), grid[:, 2], atol=1e-4)
    assert grid[0, :2] == pytest.approx([-100.0, -100.0])
    assert grid[1, 0] - grid[0, 0] == pytest.approx(terrain.spacing)


def test_hills_are_gentle() -> None:
    terrain = hills()
    slope = np.abs(np.diff(terrain.heights, axis=0)) / terrain.spacing
    assert slope.max() < 0.5
    curvature = np.abs(np.diff(terrain.heights, 2, axis=0)) / terrain.spacing**2
    assert curvature.max() < 0.1


def test_beyond_the_edge_the_ground_goes_on_level() -> None:
    terrain = hills()
    assert terrain.height(500.0, 20.0) == pytest.approx(terrain.height(100.0, 20.0))


def test_seed_decides() -> None:
    np.testing.assert_array_equal(hills(3).heights, hills(3).heights)
    assert not np.array_equal(hills(3).heights, hills(4).heights)


def test_no_relief_is_flat() -> None:
    assert not hills(relief=0.0).heights.any()
