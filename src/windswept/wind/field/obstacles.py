"""What stands in the field: spheres and crowns, boxes, posts; solid, or porous like a crown of leaves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.wind.field.grid import Grid

Reals = NDArray[np.float64]


@dataclass(frozen=True)
class Spheroid:
    """An upright ellipsoid of revolution: a boulder, or a crown."""

    centre: tuple[float, float, float]
    """x, y and height above ground, m."""
    radius: float
    """In the horizontal, m."""
    half_height: float
    """In the vertical, m."""
    openness: float = 0.0
    """0 for a solid; for a crown the share of the air that still passes where it is forced through, 0.3 to 0.7."""

    def distance(self, x: Reals, y: Reals, z: Reals) -> Reals:
        """Of points from the surface, below 0 inside, m (exact for a sphere, else first order)."""
        offset = np.stack(np.broadcast_arrays(x - self.centre[0], y - self.centre[1], z - self.centre[2]))
        edges = np.array([self.radius, self.radius, self.half_height]).reshape(3, *[1] * (offset.ndim - 1))
        level = np.linalg.norm(offset / edges, axis=0)
        slope = np.linalg.norm(offset / edges**2, axis=0)
        first_order = level * (level - 1.0) / np.maximum(slope, 1e-9)
        # At the centre all directions lead out: there the formula is 0 / 0.
        return np.where(level > 1e-9, first_order, -edges.min())

    def extent(self, azimuth: float) -> tuple[float, float]:
        """Half of its size along and across a direction, m."""
        return self.radius, self.radius

    @property
    def span(self) -> tuple[float, float]:
        """Lowest and highest point above ground, m."""
        return max(self.centre[2] - self.half_height, 0.0), self.centre[2] + self.half_height


@dataclass(frozen=True)
class Cylinder:
    """A post or a hedge's round bush, upright on the ground or above it."""

    centre: tuple[float, float]
    """x and y, m."""
    radius: float
    """m."""
    top: float
    """Height above ground, m."""
    bottom: float = 0.0
    """Height above ground, m."""
    openness: float = 0.0
    """As in Spheroid."""

    def distance(self, x: Reals, y: Reals, z: Reals) -> Reals:
        """Of points from the surface, below 0 inside, m."""
        aside = np.hypot(x - self.centre[0], y - self.centre[1]) - self.radius
        below = self.bottom - z if self.bottom > 0.0 else -np.inf
        return np.maximum(aside, np.maximum(z - self.top, below))

    def extent(self, azimuth: float) -> tuple[float, float]:
        """Half of its size along and across a direction, m."""
        return self.radius, self.radius

    @property
    def span(self) -> tuple[float, float]:
        """Lowest and highest point above ground, m."""
        return self.bottom, self.top


@dataclass(frozen=True)
class Box:
    """A house or a wall, standing on the ground."""

    centre: tuple[float, float]
    """x and y, m."""
    size: tuple[float, float]
    """Edges along its own x and y, m."""
    top: float
    """Height above ground, m."""
    yaw: float = 0.0
    """Turn about the vertical, radians counter-clockwise."""
    openness: float = 0.0
    """As in Spheroid; 0.5 for a fence of slats."""

    def distance(self, x: Reals, y: Reals, z: Reals) -> Reals:
        """Of points from the surface, below 0 inside, m (beyond edges the larger of the two distances)."""
        cosine, sine = math.cos(self.yaw), math.sin(self.yaw)
        east, north = x - self.centre[0], y - self.centre[1]
        along = np.abs(cosine * east + sine * north) - 0.5 * self.size[0]
        across = np.abs(cosine * north - sine * east) - 0.5 * self.size[1]
        return np.maximum(np.maximum(along, across), z - self.top)

    def extent(self, azimuth: float) -> tuple[float, float]:
        """Half of its size along and across a direction, m."""
        turn = azimuth - self.yaw
        cosine, sine = abs(math.cos(turn)), abs(math.sin(turn))
        a, b = 0.5 * self.size[0], 0.5 * self.size[1]
        return a * cosine + b * sine, a * sine + b * cosine

    @property
    def span(self) -> tuple[float, float]:
        """Lowest and highest point above ground, m."""
        return 0.0, self.top


Obstacle = Spheroid | Cylinder | Box


def middle(obstacle: Obstacle) -> tuple[float, float, float]:
    """x, y and height above ground of an obstacle's middle, m."""
    low, high = obstacle.span
    return obstacle.centre[0], obstacle.centre[1], 0.5 * (low + high)


def openness(grid: Grid, obstacles: Sequence[Obstacle]) -> Reals:
    """(nx, ny, nz) share of the air that passes at each node: 1 in the free, 0 in a solid.

    A surface is as thick as a cell, so that what is thinner than a cell or two is felt as something porous.
    """
    nodes = grid.nodes()
    total = np.ones(grid.shape)
    for obstacle in obstacles:
        distance = obstacle.distance(nodes[..., 0], nodes[..., 1], nodes[..., 2])
        outside = np.clip(0.5 + distance / min(grid.cell), 0.0, 1.0)
        total = np.minimum(total, obstacle.openness + (1.0 - obstacle.openness) * outside)
    return total
