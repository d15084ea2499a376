"""Colony: where the tufts of one species of underbrush stand."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Colony:
    """P plants of one source."""

    source: str
    """Name or path of a species of underbrush."""
    position: Floats
    """(P, 3) of the root, on the ground, m."""
    yaw: Floats
    """(P,) turn about +Z, radians counter-clockwise."""
    size: Floats
    """(P,) factor on all lengths of the species."""

    @property
    def count(self) -> int:
        """Number of plants, P."""
        return len(self.yaw)
