"""Where the sections of blades are now: the one thing that their motion hands to geometry."""

from __future__ import annotations

from dataclasses import dataclass

from windswept.plants.plant import Floats


@dataclass(frozen=True, slots=True)
class BladePose:
    """Pose of B blades of one kind with K sections, in the scene's frame."""

    joint: Floats
    """(B, K + 1, 3) joints from the root to the tip, m."""
    frame: Floats
    """(B, K, 3, 3) rows axis, normal, side of every section, unit vectors."""

    @property
    def tip(self) -> Floats:
        """(B, 3) ends of the blades, m."""
        return self.joint[:, -1]
