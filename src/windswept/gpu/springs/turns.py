"""How much of a walk one dispatch takes on drivers that leave long loops: steps_in_turns, links_in_turns."""

from __future__ import annotations

from typing import Any

import numpy as np

from windswept.errors import GraphicsError
from windswept.gpu.device import is_software
from windswept.gpu.springs.rows import Rows
from windswept.scene.simulation import WIND_INTERVAL

SOFTWARE_TURNS = 65_535
"""Mesa's software driver leaves the loops of a shader after so many turns in all, nested ones too, and says nothing."""
SPARE_TURNS = 16
"""Of a dispatch, beside those of its links and groups."""


def links_in_turns(device: Any, rungs: Rows, turns_per_link: int) -> int:
    """Links that one dispatch walks at most; larger plants are walked share by share.

    Args:
        device: the card.
        rungs: ``RUNG`` of all levels.
        turns_per_link: turns of a shader's loops for every link and step.
    """
    longest = int(rungs["links"][:, 1].max(initial=1))
    if not is_software(device):
        return longest
    groups = int(rungs["groups"][:, 1].max(initial=0))
    return min((SOFTWARE_TURNS - SPARE_TURNS - groups) // turns_per_link, longest)


def steps_in_turns(device: Any, rungs: Rows, turns_per_link: int) -> int:
    """Inner steps that one dispatch takes at most: one where it walks only a share of a plant.

    Args:
        device: the card.
        rungs: ``RUNG`` of all levels.
        turns_per_link: turns of a shader's loops for every link and step.
    """
    if not is_software(device):
        return WIND_INTERVAL
    turns = turns_per_link * rungs["links"][:, 1].astype(np.int64) + rungs["groups"][:, 1] + SPARE_TURNS
    return int(np.clip(SOFTWARE_TURNS // turns.max(initial=1), 1, WIND_INTERVAL))


def check_walked_whole(device: Any, rungs: Rows, turns_per_link: int) -> None:
    """Refuses plants that one dispatch cannot walk to the end.

    Args:
        device: the card.
        rungs: ``RUNG`` of all levels.
        turns_per_link: turns of a shader's loops for every link and step.

    Raises:
        GraphicsError: a plant is too large for a software driver.
    """
    most = links_in_turns(device, rungs, turns_per_link)
    longest = rungs["links"][:, 1].max(initial=0)
    if longest > most:
        raise GraphicsError(
            f"a plant has {longest} links and a software graphics driver moves {most} at most: simulate on the CPU"
        )
