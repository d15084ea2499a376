"""What an agent does to the field during one step: it stands in it as a body, blows a jet, or showers drops."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Body:
    """An upright capsule swept from ``start`` to ``stop``: it presses plants outward and down, and drags air along."""

    start: tuple[float, float]
    """x and y of its axis when the step begins, m."""
    stop: tuple[float, float]
    """The same when it ends, m."""
    low: float
    """Of the straight part of its axis, above ground, m; 0 for what rests on the ground."""
    high: float
    """Upper end of that part, m."""
    radius: float
    """m."""
    pressure: float = 0.0
    """On plants at its axis, falling to 0 at its surface, N/m^2."""
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """That air near it is drawn to, m/s."""
    shelter: float = 1.0
    """Share of the passing air's velocity that it takes away."""
    roundness: float = 1.0
    """Height of its rounded ends over the radius."""


@dataclass(frozen=True, slots=True)
class Jet:
    """Air blown down, which leaves along the ground."""

    place: tuple[float, float]
    """x and y of its axis, m."""
    radius: float
    """At which its speed has fallen to 1/e, m."""
    speed: float
    """Downward on its axis, high above ground, m/s."""
    layer: float
    """Thickness of the layer in which it turns along the ground, m."""


@dataclass(frozen=True, slots=True)
class Shower:
    """Downward pressure of drops, column by column."""

    pressure: NDArray[np.float32]
    """(nx, ny) N/m^2."""


Act = Body | Jet | Shower


class Agent(Protocol):
    """Anything that acts on the field for a while."""

    def acts(self, start: float, stop: float, shape: tuple[int, int], area: float) -> Sequence[Act]:
        """What it does in a step.

        Args:
            start: of the step, s.
            stop: its end, s.
            shape: nodes of the grid along x and y.
            area: of ground that belongs to a node, m^2.
        """
        ...
