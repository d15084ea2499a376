"""What moves: joint angles and velocities of P placements of one plant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.motion.lanes import WIDTH
from windswept.motion.model import Model
from windswept.plants.plant import Floats


@dataclass(slots=True)
class State:
    """Motion of P placements of one plant with L links. Stepped in place."""

    joints: Floats
    """(T, L, 4, WIDTH) tiles of WIDTH placements: angle and velocity about axis 1, then axis 2; rad, rad/s."""
    placement_count: int
    """P; the last tile's spare lanes move unseen."""
    step_count: int = 0
    """Inner steps taken since rest."""

    def angles(self, placement: int) -> Floats:
        """(L, 2) joint angles of one placement, rad."""
        return self.joints[placement // WIDTH, :, ::2, placement % WIDTH]

    def velocities(self, placement: int) -> Floats:
        """(L, 2) joint velocities of one placement, rad/s."""
        return self.joints[placement // WIDTH, :, 1::2, placement % WIDTH]


def rest_state(model: Model, placement_count: int) -> State:
    """State of plants at rest.

    Args:
        model: their model.
        placement_count: P.

    """
    tiles = -(-placement_count // WIDTH)
    return State(np.zeros((tiles, model.link_count, 4, WIDTH), np.float32), placement_count)
