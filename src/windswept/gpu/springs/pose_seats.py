"""seats_for_all: room for every pose of every placement, for who reads them back."""

from __future__ import annotations

from typing import Any

import numpy as np

from windswept.gpu import layouts
from windswept.gpu.buffers import filled, room
from windswept.gpu.seating import Seating
from windswept.gpu.springs.card_state import INDIRECT
from windswept.gpu.springs.kinds import GrownKind

WORKGROUP = 64


def seats_for_all(device: Any, kinds: list[GrownKind]) -> Seating:
    """Seats for all links in their own order.

    Args:
        device: the card.
        kinds: what it simulates.

    Raises:
        GraphicsError: the card has too little memory.
    """
    links = np.array([kind.model.link_count for kind in kinds], np.int64)
    count = np.repeat(links, np.array([kind.placements.count for kind in kinds], np.int64))
    seats = np.zeros((len(count) + 1, 4), np.uint32)
    seats[0, 0] = len(count)
    seats[1:, 0] = np.arange(len(count))
    seats[1:, 1], seats[1:, 2] = np.cumsum(count) - count, count
    link = np.concatenate([np.zeros(0), *map(np.arange, links)]).astype(np.uint32)
    groups = np.array([-(-len(count) // WORKGROUP), 1, 1], np.uint32)
    return Seating(
        filled(device, seats),
        filled(device, np.column_stack([link, link])),
        room(device, layouts.LINK_POSE, int(count.sum())),
        filled(device, groups, INDIRECT),
    )
