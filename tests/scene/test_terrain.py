"""Ground: levels, smoothness, and that the height between grid points is that of what is drawn."""

import numpy as np
import pytest

from windswept.scene.terrain import Terrain, flat_terrain, hilly_terrain, image_terrain, without_steps


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


def test_slope_and_normal_are_those_of_the_hills() -> None:
    side = np.linspace(-50.0, 50.0, 101)
    x, y = np.meshgrid(side, side)
    terrain = Terrain(100.0, (10.0 * np.sin(x / 15.0) + 0.1 * y).astype(np.float32))
    place = np.random.default_rng(0).uniform(-48.0, 48.0, (2, 200))
    rise = 10.0 / 15.0 * np.cos(place[0] / 15.0)
    # Central differences over h = 1 m miss h^2 f''' / 6, bilinear interpolation h^2 f''' / 8 at most.
    assert np.tan(terrain.slope(*place)) == pytest.approx(np.hypot(rise, 0.1), abs=1e-3)
    normal = terrain.normal(*place)
    assert np.linalg.norm(normal, axis=1) == pytest.approx(1.0)
    assert -normal[:, 0] / normal[:, 2] == pytest.approx(rise, abs=1e-3)
    assert -normal[:, 1] / normal[:, 2] == pytest.approx(0.1, abs=1e-5)


@pytest.mark.parametrize(("points", "relief", "waves"), [(129, 0.1, 6.0), (513, 0.1, 6.0), (513, 0.3, 20.0)])
def test_height_images_lose_their_terraces_and_keep_their_levels(
    points: int, relief: float, waves: float
) -> None:
    side, step = np.linspace(0.0, 1.0, points), 1.0 / 255.0
    true = 0.4 + relief * np.sin(waves * side[:, None]) * np.cos(0.8 * waves * side)
    rounded = np.round(true / step) * step
    smooth = without_steps(rounded, step)
    assert np.abs(smooth - rounded).max() < 0.75 * step
    # Rounding alone is off by step / sqrt(12).
    assert np.sqrt(np.mean((smooth - true) ** 2)) < 0.5 * step / np.sqrt(12.0)
    slopes = [np.stack(np.gradient(ground)) for ground in (true, rounded, smooth)]
    missed = [np.sqrt(np.mean((slope - slopes[0]) ** 2)) for slope in slopes[1:]]
    assert missed[1] < 0.35 * missed[0]
    np.testing.assert_array_equal(without_steps(true, 0.0), true)


def test_large_images_are_resampled_to_the_finest_grid() -> None:
    ramp = np.tile(np.linspace(0.0, 1.0, 3000), (3000, 1))
    terrain = image_terrain(500.0, ramp, 0.0, 5.0, 25.0)
    assert terrain.heights.shape == (1025, 1025)
    assert terrain.height(np.array([-200.0, 0.0, 125.0]), np.zeros(3)) == pytest.approx(
        [7.0, 15.0, 20.0], abs=0.02
    )
