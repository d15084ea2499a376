"""Gust fronts that travel over the ground."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError


@dataclass(frozen=True)
class Gust:
    """A band of faster air: it rises over a length behind its front, holds, and decays, smooth in value and slope.

    The band is endless to the sides unless ``width`` is given, and upwind of ``position`` before ``start``.
    """

    start: float
    """When the front passes ``position``, s."""
    strength: float
    """Speed added at full height of the gust, at the reference height, m/s."""
    azimuth: float = 0.0
    """Where the front travels and the air is pushed to, radians counter-clockwise from +x."""
    position: tuple[float, float] = (0.0, 0.0)
    """Where the front is at ``start``, m."""
    speed: float = 10.0
    """Speed of travel, m/s."""
    rise_length: float = 15.0
    """From the front to full strength, m; 0 for a sudden front."""
    hold_length: float = 20.0
    """At full strength, m; infinite for a gust that stays."""
    decay_length: float = 30.0
    """From full strength to nothing, m."""
    width: float = math.inf
    """From the middle to either side, where the gust has faded to nothing, m."""

    def __post_init__(self) -> None:
        self.validate()

    def validate(self) -> None:
        """Raise InputError where a length or speed is out of range."""
        for name in ("start", "strength", "azimuth", "speed"):
            if not math.isfinite(getattr(self, name)):
                raise InputError("gust", name, getattr(self, name), "a finite number")
        for name in ("speed", "width"):
            if not getattr(self, name) > 0.0:
                raise InputError("gust", name, getattr(self, name), "a number above 0")
        for name in ("rise_length", "hold_length", "decay_length"):
            if not getattr(self, name) >= 0.0:
                raise InputError("gust", name, getattr(self, name), "a length of 0 m or more")


GUST_COLUMNS = (
    *("start", "position_x", "position_y", "direction_x", "direction_y", "speed", "strength"),
    *("per_rise", "decay_start", "per_decay", "per_width"),
)
"""Columns of the gust table; ``per_`` is one over a length, 0 for an endless one."""

SUDDEN = 1e-6
"""Length that stands for 0 m, so that a sudden front has a finite slope, m."""


def gust_table(gusts: tuple[Gust, ...]) -> NDArray[np.float64]:
    """(G, 11) the gusts as the kernels read them, columns GUST_COLUMNS."""
    return np.array([_row(gust) for gust in gusts], dtype=np.float64).reshape(len(gusts), len(GUST_COLUMNS))


def _row(gust: Gust) -> tuple[float, ...]:
    decay_start = gust.rise_length + gust.hold_length
    stays = math.isinf(decay_start) or math.isinf(gust.decay_length)
    return (
        gust.start,
        *gust.position,
        math.cos(gust.azimuth),
        math.sin(gust.azimuth),
        gust.speed,
        gust.strength,
        1.0 / max(gust.rise_length, SUDDEN),
        0.0 if stays else decay_start,
        0.0 if stays else 1.0 / max(gust.decay_length, SUDDEN),
        1.0 / gust.width,
    )
