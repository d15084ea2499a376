"""The ground: a square heightfield, flat, gently hilly, or from an image of heights."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import gaussian_filter, map_coordinates

Floats = NDArray[np.float32]
Reals = NDArray[np.float64]

OCTAVES = 4
"""Layers of noise, each with half the wavelength and 0.4 of the height of the one before."""
OCTAVE_GAIN = 0.4
FINEST_STEP, MOST_CELLS = 1.0, 1024
"""Edge of a cell, m, unless the ground is so large that it would have more cells a side than this."""
STEP_BLURS = (1.0, 2.0, 4.0, 8.0, 16.0)
"""Widths of the blurs that take the steps out of a height image, from single pixels to terraces, pixels."""
FAR_SHARE = 0.125
"""A blur is not used where this part of the pixels around would leave their grey level."""


@dataclass(frozen=True, slots=True)
class Terrain:
    """Heights on a square grid of G x G points centred on the origin; the grid is also what is drawn."""

    size: float
    """Edge of the square, m."""
    heights: Floats
    """(G, G) height at the grid points, first axis y from south to north, second axis x from west to east, m."""

    @property
    def spacing(self) -> float:
        """Distance between grid points, m."""
        return self.size / (len(self.heights) - 1)

    def height(self, x: ArrayLike, y: ArrayLike) -> Reals:
        """Height of the ground, bilinear between grid points and level beyond the edge.

        Args:
            x: any shape, m.
            y: same shape, m.

        Returns:
            Same shape, m.
        """
        column, fx = self._cell(x)
        row, fy = self._cell(y)
        south = self.heights[row, column] * (1.0 - fx) + self.heights[row, column + 1] * fx
        north = self.heights[row + 1, column] * (1.0 - fx) + self.heights[row + 1, column + 1] * fx
        return np.asarray(south * (1.0 - fy) + north * fy, dtype=np.float64)

    def gradient(self) -> Floats:
        """(2, G, G) rise towards +x and towards +y at the grid points, central differences, m/m."""
        north, east = np.gradient(self.heights, self.spacing)
        return np.stack([east, north]).astype(np.float32)

    def slope(self, x: ArrayLike, y: ArrayLike) -> Reals:
        """Angle of the ground to the horizontal, smooth over the edges of the drawn grid.

        Args:
            x: any shape, m.
            y: same shape, m.

        Returns:
            Same shape, radians.
        """
        east, north = self._rise(x, y)
        return np.arctan(np.hypot(east, north))

    def normal(self, x: ArrayLike, y: ArrayLike) -> Reals:
        """(..., 3) unit normal of the ground at x, y of any one shape, smooth over the edges of the drawn grid."""
        east, north = self._rise(x, y)
        upright = np.stack([-east, -north, np.ones_like(east)], axis=-1)
        return np.asarray(upright / np.linalg.norm(upright, axis=-1, keepdims=True))

    def _rise(self, x: ArrayLike, y: ArrayLike) -> tuple[Reals, Reals]:
        """Rise towards +x and +y, bilinear between grid points."""
        east, north = (Terrain(self.size, rise).height(x, y) for rise in self.gradient())
        return east, north

    def _cell(self, coordinate: ArrayLike) -> tuple[NDArray[np.intp], Reals]:
        """Index of the cell a coordinate falls in, and where in the cell, 0..1."""
        last = len(self.heights) - 1
        place = np.asarray(coordinate, dtype=np.float64) / self.spacing + 0.5 * last
        place = np.clip(place, 0.0, last)
        index = np.minimum(place.astype(np.intp), last - 1)
        return index, place - index

    def grid(self) -> Floats:
        """(G, G, 3) the heightfield as points for drawing, m."""
        side = np.linspace(-0.5 * self.size, 0.5 * self.size, len(self.heights), dtype=np.float32)
        x, y = np.meshgrid(side, side)
        return np.stack([x, y, self.heights], axis=-1)


def flat_terrain(size: float) -> Terrain:
    """Level ground at height 0."""
    return Terrain(size=size, heights=np.zeros((2, 2), dtype=np.float32))


def hilly_terrain(size: float, relief: float, hill_length: float, rng: np.random.Generator) -> Terrain:
    """Gentle hills: a few octaves of cubic B-spline noise (smooth to the second derivative).

    Args:
        size: edge of the square, m.
        relief: from the lowest to the highest point, m; the mean height is 0 or so.
        hill_length: from hill to hill, m.
        rng: drawn from once an octave.
    """
    cells = int(np.clip(np.ceil(size / FINEST_STEP), 16, MOST_CELLS))
    heights = np.zeros((cells + 1, cells + 1))
    for octave in range(OCTAVES):
        heights += OCTAVE_GAIN**octave * spline_noise(cells + 1, size / hill_length * 2.0**octave, rng)
    span = np.ptp(heights)
    heights = (heights - heights.mean()) * (relief / span if span > 0.0 else 0.0)
    return Terrain(size=size, heights=heights.astype(np.float32))


def image_terrain(size: float, grey: Reals, step: float, low: float, high: float) -> Terrain:
    """Ground from an image of heights; where it has more pixels than the grid has points, it is resampled.

    Args:
        size: edge of the square, m.
        grey: (R, R) 0 to 1, the first row in the north; the middles of the outer pixels lie on the edge.
        step: difference of neighbouring grey levels, whose terraces are smoothed; 0 for none.
        low: height of black, m.
        high: height of white, m.
    """
    points = min(len(grey), MOST_CELLS + 1)
    place = np.linspace(0.0, len(grey) - 1.0, points)
    smooth = without_steps(grey[::-1], step)
    if points < len(grey):
        smooth = gaussian_filter(smooth, 0.5 * len(grey) / points, mode="nearest")
        smooth = map_coordinates(smooth, np.meshgrid(place, place, indexing="ij"), order=1)
    return Terrain(size=size, heights=(low + (high - low) * smooth).astype(np.float32))


def without_steps(grey: Reals, step: float) -> Reals:
    """Smooth ground that the grey levels could have been rounded from.

    Every pixel takes the widest blur that stays within half a step of its level all around, so that a terrace
    becomes a ramp and a steep or bent slope keeps its shape.

    Args:
        grey: (R, C) any range.
        step: difference of neighbouring levels; 0 leaves the ground as it is.
    """
    smooth = grey
    for width in STEP_BLURS if step > 0.0 else ():
        blurred = gaussian_filter(grey, width, mode="nearest")
        far = gaussian_filter((np.abs(blurred - grey) > 0.5 * step).astype(np.float64), width, mode="nearest")
        share = np.clip(1.0 - far / FAR_SHARE, 0.0, 1.0)
        smooth = share * blurred + (1.0 - share) * smooth
    return smooth


def spline_noise(points: int, waves: float, rng: np.random.Generator) -> Reals:
    """(points, points) smooth noise with about ``waves`` hills a side: random values, cubic B-spline between."""
    knots = 2.0 * waves
    values = rng.uniform(-1.0, 1.0, (int(np.ceil(knots)) + 5,) * 2)
    place = np.linspace(2.0, 2.0 + knots, points)
    return np.asarray(
        map_coordinates(values, np.meshgrid(place, place, indexing="ij"), order=3, prefilter=False)
    )
