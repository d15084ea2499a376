"""Kinds of values that the tables of a scene file share."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

Coordinate = Annotated[float, Field(ge=-10_000, le=10_000)]
Point = Annotated[tuple[Coordinate, Coordinate], Field(strict=False)]
Place = Annotated[tuple[Coordinate, Coordinate, Coordinate], Field(strict=False)]
Box = Annotated[tuple[Coordinate, Coordinate, Coordinate, Coordinate], Field(strict=False)]
Angle = Annotated[float, Field(ge=-360, le=360)]
Time = Annotated[float, Field(ge=-3600, le=86_400)]
Length = Annotated[float, Field(ge=0, le=10_000)]
Level = Annotated[float, Field(ge=-10_000, le=10_000)]
Speed = Annotated[float, Field(ge=0.01, le=100)]
Source = Annotated[str, Field(min_length=1, max_length=1000)]
Seed = Annotated[int, Field(ge=0, le=2**31 - 1)]
