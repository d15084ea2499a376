"""What an error of a simulation level is: how far apart two motions of the same plant are.

Every metric is one entry of METRICS; another one is added here and nowhere else.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from windswept.plants.plant import Floats

OUTLINE_DIRECTIONS = 12
"""Directions, all round and upwards, in which the outline of a crown is compared."""


@dataclass(frozen=True, slots=True)
class Metric:
    """A way to hold a level's motion against that of level 0."""

    unit: str
    suffix: str
    """The unit as it stands at the end of a figure's name."""
    between: Callable[[Floats, Floats, float], Floats]
    """Error (K, P, m) of K levels from where P placements' n tips are now and were before, both (K, P, n, 3) m with
    level 0 first, and the seconds in between."""


def _displacement(now: Floats, before: Floats, seconds: float) -> Floats:
    """Distance of every tip from where level 0 has it, m."""
    return np.linalg.norm(now - now[:1], axis=-1)


def _velocity(now: Floats, before: Floats, seconds: float) -> Floats:
    """Difference of every tip's velocity, the mean since the last look, from that at level 0, m/s."""
    velocity = (now - before) / max(seconds, 1e-9)
    return np.linalg.norm(velocity - velocity[:1], axis=-1)


def _silhouette(now: Floats, before: Floats, seconds: float) -> Floats:
    """How far the crown's outline is from that of level 0, in directions all round and upwards, m."""
    azimuth = 2.0 * np.pi * np.arange(OUTLINE_DIRECTIONS - 1) / (OUTLINE_DIRECTIONS - 1)
    around = np.column_stack([np.cos(azimuth), np.sin(azimuth), np.zeros_like(azimuth)])
    directions = np.vstack([around, [0.0, 0.0, 1.0]]).astype(np.float32)
    outline = (now @ directions.T).max(axis=2)
    return np.abs(outline - outline[:1])


METRICS = {
    "displacement": Metric("m", "m", _displacement),
    "velocity": Metric("m/s", "m_s", _velocity),
    "silhouette": Metric("m", "m", _silhouette),
}
"""Metrics by name."""
