"""choose: which level each placement needs, from what the camera can tell apart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.levels.ladder import Ladder
from windswept.motion.lanes import WIDTH
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats, Ints

Measure = Callable[["Eye", Floats, float], Doubles]
"""(eye, (P, 3) positions, radius) -> (P,) factors, at least 1, by which placements count as farther away."""

NEAREST = 0.1
"""No part of a plant is seen from nearer than this, m."""
OUT_OF_VIEW = 4.0
"""A plant that cannot be seen is treated as up to this many times farther away."""
OUT_OF_VIEW_FROM, OUT_OF_VIEW_TO = np.radians(8.0), np.radians(30.0)
"""Angles outside the picture's corner between which that factor rises: plants are fine again before they come in, and
a trembling camera changes their distance by less than the dead band."""


@dataclass(frozen=True, slots=True)
class Eye:
    """What a picture can tell apart."""

    position: Floats
    """(3,) camera, m."""
    fov_y: float
    """Vertical field of view, rad."""
    height: int = 1080
    """Of the picture, pixels."""
    tolerance: float = 1.0
    """Error that may be seen, pixels."""
    dead_band: float = 0.1
    """A placement goes back to a finer level only when it is this much nearer than where it left it."""
    forward: Floats | None = None
    """(3,) where it looks, a unit vector; None for all round."""
    aspect: float = 16.0 / 9.0
    """Width of the picture over its height."""
    measures: tuple[Measure, ...] = ()
    """What else than distance makes errors harder to see."""

    def metres(self, distance: Doubles) -> Doubles:
        """Error that is as large as the tolerance at a distance, m (PHYSICS: E = 2 e D tan(fov/2) / H)."""
        return self.tolerance * 2.0 * distance * np.tan(0.5 * self.fov_y) / self.height

    def distance(self, error: Doubles) -> Doubles:
        """Distance at which an error in metres is as large as the tolerance, m."""
        return error * self.height / (2.0 * self.tolerance * np.tan(0.5 * self.fov_y))


def outside_view(eye: Eye, position: Floats, radius: float) -> Doubles:
    """1 for placements that can be seen or soon will be, rising to OUT_OF_VIEW for those far outside the picture."""
    if eye.forward is None:
        return np.ones(len(position))
    towards = position - eye.position
    away = np.maximum(np.linalg.norm(towards, axis=1), NEAREST)
    corner = np.arctan(np.tan(0.5 * eye.fov_y) * np.hypot(1.0, eye.aspect))
    off = np.arccos(np.clip(towards @ eye.forward / away, -1.0, 1.0)) - np.arcsin(
        np.minimum(radius / away, 1.0)
    )
    share = np.clip((off - corner - OUT_OF_VIEW_FROM) / (OUT_OF_VIEW_TO - OUT_OF_VIEW_FROM), 0.0, 1.0)
    return np.where(away > radius, 1.0 + (OUT_OF_VIEW - 1.0) * share, 1.0)


def away_from(point: Floats, reach: float) -> Measure:
    """Measure for a picture whose subject is at a point: what is n times farther from it than ``reach`` counts so.

    Args:
        point: (3,) m.
        reach: within it nothing is spared, m.
    """

    def measure(eye: Eye, position: Floats, radius: float) -> Doubles:
        return np.maximum((np.linalg.norm(position - point, axis=1) - radius) / reach, 1.0)

    return measure


def seen_distance(eye: Eye, position: Floats, radius: float) -> Doubles:
    """(P,) distance from which each placement is seen: to its nearest point, times what else makes it harder to see.

    Args:
        eye: who looks.
        position: (P, 3) of the roots, m.
        radius: of a ball round the root that holds the plant, m.
    """
    distance = np.maximum(np.linalg.norm(position - eye.position, axis=1) - radius, NEAREST)
    for measure in eye.measures:
        distance = distance * measure(eye, position, radius)
    return distance


def choose(ladder: Ladder, eye: Eye, distance: Doubles, current: Ints) -> Ints:
    """Level of every placement.

    Args:
        ladder: of their plant.
        eye: who looks.
        distance: (P,) from which each placement is seen, see `seen_distance`, m.
        current: (P,) level each is at now.

    Returns:
        (P,) coarsest level whose error is not seen; a level is left towards the finer side only beyond the dead band.
    """
    allowed = _coarsest(ladder.error, eye.metres(distance))
    kept = _coarsest(ladder.error, eye.metres(distance * (1.0 + eye.dead_band)))
    return np.where(allowed >= current, allowed, np.minimum(current, kept)).astype(np.int32)


def fill_registers(wanted: Ints) -> Ints:
    """Levels with the idle lanes of finer levels' registers filled: who fits there is stepped for nothing.

    Args:
        wanted: (P,) coarsest level that each placement may have.

    Returns:
        (P,) levels, none coarser than wanted.
    """
    order = np.argsort(wanted, kind="stable")
    levels = wanted[order].copy()
    start = 0
    while start < len(levels):
        members = int(np.searchsorted(levels, levels[start], side="right")) - start
        end = min(start + -(-members // WIDTH) * WIDTH, len(levels))
        levels[start:end] = levels[start]
        start = end
    filled = np.empty_like(wanted)
    filled[order] = levels
    return filled


def _coarsest(error: Doubles, metres: Doubles) -> NDArray[np.int64]:
    """(P,) last level whose error, and that of all finer ones, is at most so many metres."""
    rising = np.maximum.accumulate(error)
    return np.maximum(np.searchsorted(rising, metres, side="right") - 1, 0)
