"""What a scene file may say of plants that a person puts in their places: one by one, or as stands."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from windswept.forms.form import Form
from windswept.scene.values import Angle, Box, Point, Seed, Source


class PlantForm(Form):
    """One plant in its own place."""

    source: Source
    """Name of a built-in species, underbrush or grammar, or path of its file (see plants.md) from the scene file on."""
    position: Point
    """x and y of the root, m."""
    seed: Seed = 0
    """Seed of growth; tufts of underbrush share those of the scene."""
    yaw_degrees: Angle = 0.0
    """Turn about the vertical, counter-clockwise."""


class StandSourceForm(Form):
    """One species of a stand."""

    source: Source
    """Name of a built-in species, underbrush or grammar, or path of its file (see plants.md) from the scene file on."""
    weight: Annotated[float, Field(gt=0, le=1e6)] = 1.0
    """Share of the stand's plants, relative to the other sources' weights."""
    spacing_m: Annotated[float, Field(ge=0.05, le=1000)] = 3.0
    """Least distance between two of this species; between two species the mean of both."""
    depth_bias: Annotated[float, Field(ge=-1, le=1)] = 0.0
    """-1 crowds at the edge of the area (shrubs), 0 is even, 1 crowds deep inside (tall trees)."""


class AreaForm(Form):
    """Where a stand grows; exactly one of the keys."""

    rectangle: Box | None = None
    """West, south, east, north, m."""
    ellipse: Box | None = None
    """Centre x and y, radius along x and along y, m."""
    polygon: Annotated[list[Point], Field(min_length=3, max_length=1000)] | None = None
    """Corners in order, each x and y in m."""


class StandForm(Form):
    """Plants scattered over an area, none too close to another or to a plant placed before."""

    count: Annotated[int, Field(ge=1, le=10_000_000)]
    """Number of plants."""
    area: AreaForm
    """`[stand.area]`"""
    source: Annotated[list[StandSourceForm], Field(min_length=1, max_length=64)]
    """`[[stand.source]]`, one or more."""
    individuals: Annotated[int, Field(ge=1, le=100)] = 3
    """How many different plants are grown of each species and shared by its placements."""
    deeper_degrees: Angle | None = None
    """Direction that leads deeper into the stand, for `depth_bias`; left out: inwards from every side."""
