"""How much of the sky every part of a crown sees: leaf area on a coarse grid, and rays through it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, map_coordinates

from windswept.plants.plant import Floats, Plant

Points = NDArray[np.float32] | NDArray[np.float64]

CELLS = 28
"""Cells along the crown's longest side."""
EXTINCTION = 0.5
"""Share of leaf area that a leaf in random pose shows to a ray (spherical leaf angles)."""
TILTED_RAYS = 8
"""Rays at 50 degrees from upright, round the compass; one more goes straight up."""


@dataclass(frozen=True, slots=True)
class CrownLight:
    """Sky seen and outward direction on a grid round a crown."""

    origin: NDArray[np.float64]
    """(3,) centre of the first cell, m."""
    cell: float
    """Side of a cell, m."""
    open: NDArray[np.float64]
    """(nx, ny, nz) share of the sky that is seen, 0..1."""
    thinning: NDArray[np.float64]
    """(3, nx, ny, nz) direction in which leaf area falls off."""

    def openness(self, points: Points) -> Floats:
        """(...) share of the sky seen at points (..., 3), m."""
        flat = self._cells(points)
        seen = map_coordinates(self.open, flat, order=1, mode="nearest")
        return seen.reshape(points.shape[:-1]).astype(np.float32)

    def outward(self, points: Points) -> Floats:
        """(n, 3) unit direction out of the crown at points (n, 3), m; up where there is no telling."""
        flat = self._cells(points)
        parts = [map_coordinates(part, flat, order=1, mode="nearest") for part in self.thinning]
        direction = np.stack(parts, axis=1)
        direction[:, 2] += 1e-9
        return (direction / np.linalg.norm(direction, axis=1, keepdims=True)).astype(np.float32)

    def _cells(self, points: Points) -> NDArray[np.float64]:
        return ((points.reshape(-1, 3) - self.origin) / self.cell).T


def crown_light(plant: Plant) -> CrownLight:
    """Beer-Lambert light through a plant's leaf area, and the direction in which that area thins out.

    Args:
        plant: what was grown; without leaves everything sees the whole sky.
    """
    points = plant.leaf_position if plant.leaf_count else plant.link_tip
    low, high = points.min(axis=0).astype(np.float64), points.max(axis=0).astype(np.float64)
    cell = max(float((high - low).max()) / CELLS, 1e-3)
    origin = low - cell
    shape = np.ceil((high - low) / cell).astype(int) + 3
    area = np.zeros(shape)
    if plant.leaf_count:
        index = np.rint((points - origin) / cell).astype(int)
        np.add.at(area, tuple(index.T), plant.leaf_area)
    density = gaussian_filter(area / cell**3, 0.7)
    smooth = gaussian_filter(density, 3.0)
    return CrownLight(origin, cell, _sky_seen(density, cell), -np.stack(np.gradient(smooth)))


def _sky_seen(density: NDArray[np.float64], cell: float) -> NDArray[np.float64]:
    """(nx, ny, nz) mean of exp(-extinction x leaf area along the ray) over the rays of the upper sky."""
    seen = _through(density, (0.0, 0.0, 1.0), cell)
    tilt = np.radians(50.0)
    for azimuth in np.arange(TILTED_RAYS) * (2.0 * np.pi / TILTED_RAYS):
        ray = (np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), np.cos(tilt))
        seen += _through(density, ray, cell)
    return seen / (TILTED_RAYS + 1)


def _through(
    density: NDArray[np.float64], ray: tuple[float, float, float], cell: float
) -> NDArray[np.float64]:
    """(nx, ny, nz) light that reaches each cell along a ray that rises by at most one cell in a step."""
    step = np.asarray(ray) / ray[2]
    thickness = EXTINCTION * cell * float(np.linalg.norm(step))
    depth = np.zeros_like(density)
    above = np.zeros(density.shape[:2])
    rows, columns = np.meshgrid(*(np.arange(n, dtype=float) for n in density.shape[:2]), indexing="ij")
    source = [rows + step[0], columns + step[1]]
    for layer in range(density.shape[2] - 1, -1, -1):
        depth[:, :, layer] = above
        full = above + thickness * density[:, :, layer]
        # What the layer below sees through this one, displaced by the ray's slant.
        above = map_coordinates(full, source, order=1, mode="constant")
    return np.exp(-depth)
