"""choose: which level each placement needs, from what the camera can tell apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.levels.ladder import Ladder
from windswept.motion.lanes import WIDTH
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats, Ints


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

    def metres(self, distance: Doubles) -> Doubles:
        """Error that is as large as the tolerance at a distance, m (PHYSICS: E = 2 e D tan(fov/2) / H)."""
        return self.tolerance * 2.0 * distance * np.tan(0.5 * self.fov_y) / self.height

    def distance(self, error: Doubles) -> Doubles:
        """Distance at which an error in metres is as large as the tolerance, m."""
        return error * self.height / (2.0 * self.tolerance * np.tan(0.5 * self.fov_y))


def choose(ladder: Ladder, eye: Eye, distance: Doubles, current: Ints) -> Ints:
    """Level of every placement.

    Args:
        ladder: of their plant.
        eye: who looks.
        distance: (P,) from the eye to the nearest point of each placement, m.
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
