"""What a running field does not let pass, and how often it had to."""

from __future__ import annotations

from dataclasses import dataclass

MAX_SPEED = 100.0
"""No air is faster, m/s: beyond the strongest tornadoes' wind near the ground."""
MAX_PUSH = 1e5
"""No body presses harder, N/m^2: 4.6 times the sole on which a walker of 70 kg stands."""


@dataclass(slots=True)
class Clamps:
    """Counts of what was put right since the field began."""

    speeds: int = 0
    """Nodes and bodies that were faster than MAX_SPEED, or no number."""
    pushes: int = 0
    """Bodies that pressed harder than MAX_PUSH."""
    lost: int = 0
    """Bodies and jets left out, as their place or force was no number."""

    @property
    def total(self) -> int:
        """All of them."""
        return self.speeds + self.pushes + self.lost
