"""Small fields that the tests share."""

from __future__ import annotations

import numpy as np

from windswept.wind.field import Field, FieldPlan, Grid, start_field
from windswept.wind.mean import MeanWind
from windswept.wind.wind import Wind

FLAT = Grid((-32.0, -16.0), (1.0, 1.0, 1.0), (65, 33, 8))
"""64 x 32 m, 7 m high, the origin in its middle."""


def small_field(wind: Wind | None = None, **plan: object) -> Field:
    """A field on FLAT."""
    return start_field(FieldPlan(FLAT, **plan), wind or Wind())  # type: ignore[arg-type]


def steady(speed: float, azimuth: float = 0.0) -> Wind:
    """A wind without gusts."""
    return Wind(mean=MeanWind(speed, azimuth))


def line_of_air(field: Field, y: float = 0.0, height: int = 4) -> np.ndarray:
    """(nx, 3) velocity along x."""
    j = round((y - field.plan.grid.origin[1]) / field.plan.grid.cell[1])
    return field.velocity[:, j, height]
