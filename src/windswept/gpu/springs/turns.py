"""steps_in_turns: how many inner steps a dispatch may take on drivers that leave long loops."""

from __future__ import annotations

from typing import Any

import numpy as np

from windswept.errors import GraphicsError
from windswept.gpu.device import is_software
from windswept.gpu.springs.rows import Rows
from windswept.scene.simulation import WIND_INTERVAL

SOFTWARE_TURNS = 65_535
"""Mesa's software driver leaves the loops of a shader after so many turns in all, and says nothing."""
SPARE_TURNS = 16
"""Of a dispatch, beside those of its links and groups."""


def steps_in_turns(device: Any, rungs: Rows, turns_per_link: int) -> int:
    """Inner steps that one dispatch takes at most.

    Args:
        device: the card.
        rungs: ``RUNG`` of all levels.
        turns_per_link: turns of a shader's loops for every link and step.

    Raises:
        GraphicsError: a plant is too large for a software driver.
    """
    if not is_software(device):
        return WIND_INTERVAL
    turns = turns_per_link * rungs["links"][:, 1].astype(np.int64) + rungs["groups"][:, 1] + SPARE_TURNS
    if turns.max(initial=1) > SOFTWARE_TURNS:
        raise GraphicsError(
            f"a plant has {rungs['links'][:, 1].max()} links and a software graphics driver moves "
            f"{(SOFTWARE_TURNS - SPARE_TURNS) // turns_per_link} at most: simulate on the CPU"
        )
    return int(min(SOFTWARE_TURNS // turns.max(initial=1), WIND_INTERVAL))
