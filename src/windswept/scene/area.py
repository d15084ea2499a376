"""A piece of ground bounded by a polygon, on which a stand is planted."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]

ELLIPSE_CORNERS = 96
PROBES = 48
"""Points a side of the grid on which the greatest distance from the edge is looked for."""


@dataclass(frozen=True)
class Area:
    """The inside of a polygon with C corners."""

    corners: Reals
    """(C, 2) in order round the polygon, either way, m."""

    @property
    def bounds(self) -> tuple[Reals, Reals]:
        """(2,) lowest and (2,) highest x and y, m."""
        return self.corners.min(axis=0), self.corners.max(axis=0)

    @property
    def surface(self) -> float:
        """Content, m^2."""
        x, y = self.corners.T
        return float(0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))))

    def contains(self, points: Reals) -> NDArray[np.bool_]:
        """(N,) whether each of (N, 2) points lies inside: an odd number of sides lies to its east."""
        x, y = points[:, 0:1], points[:, 1:2]
        ax, ay = self.corners.T
        bx, by = np.roll(self.corners, -1, axis=0).T
        straddles = (ay > y) != (by > y)
        rise = np.where(by == ay, 1.0, by - ay)
        east = ax + (y - ay) / rise * (bx - ax) > x
        inside: NDArray[np.bool_] = np.sum(straddles & east, axis=1) % 2 == 1
        return inside

    def edge_distance(self, points: Reals) -> Reals:
        """(N,) distance of (N, 2) points from the nearest side, m."""
        start = self.corners
        side = np.roll(start, -1, axis=0) - start
        offset = points[:, None, :] - start
        share = np.sum(offset * side, axis=2) / np.maximum(np.sum(side * side, axis=1), 1e-30)
        nearest = np.clip(share, 0.0, 1.0)[..., None] * side
        return np.asarray(np.sqrt(np.min(np.sum((offset - nearest) ** 2, axis=2), axis=1)))

    def depth_from_edge(self, points: Reals) -> Reals:
        """(N,) 0 at the edge to 1 at the innermost place."""
        return np.clip(self.edge_distance(points) / self.greatest_depth, 0.0, 1.0)

    @cached_property
    def greatest_depth(self) -> float:
        """Distance of the innermost place from the edge, m; 0 for a polygon with no inside to speak of."""
        low, high = self.bounds
        steps = (np.arange(PROBES) + 0.5) / PROBES
        x, y = np.meshgrid(*(low[:, None] + (high - low)[:, None] * steps))
        grid = np.stack([x.ravel(), y.ravel()], axis=1)
        inside = grid[self.contains(grid)]
        return float(self.edge_distance(inside).max()) if len(inside) else 0.0

    def depth_along(self, points: Reals, azimuth: float) -> Reals:
        """(N,) 0 at the front to 1 at the back of the area, seen along a direction (radians from +x)."""
        direction = np.array([np.cos(azimuth), np.sin(azimuth)])
        front, back = (self.corners @ direction).min(), (self.corners @ direction).max()
        return np.clip((points @ direction - front) / max(back - front, 1e-30), 0.0, 1.0)


def rectangle(west: float, south: float, east: float, north: float) -> Area:
    """An upright rectangle."""
    return Area(np.array([[west, south], [east, south], [east, north], [west, north]], dtype=np.float64))


def ellipse(x: float, y: float, radius_x: float, radius_y: float) -> Area:
    """An upright ellipse, as a polygon just inside it."""
    turn = np.linspace(0.0, 2.0 * np.pi, ELLIPSE_CORNERS, endpoint=False)
    return Area(np.stack([x + radius_x * np.cos(turn), y + radius_y * np.sin(turn)], axis=1))
