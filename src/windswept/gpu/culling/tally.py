"""Tally: what was drawn and what lacked room, told some frames later; a card that keeps up is not waited for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.gpu.draw_list import DrawList
from windswept.gpu.draw_plan import TALLY, DrawPlan
from windswept.gpu.failures import card_errors
from windswept.gpu.posing import Counts

LATE = 4
"""Frames after which one is looked at. A card that has not finished it by then is waited for: this keeps the CPU less
than twice so many frames ahead of a slow card."""
_WORDS = 9


@dataclass(frozen=True, slots=True)
class Told:
    """What the card says of a frame."""

    wanted: Counts
    """Link poses, shifted stems, posed pieces and posed leaves of all that should be drawn."""
    refused: int
    """Placements that were not drawn for want of room."""
    placements: int
    """Placements, pieces and leaves that were drawn, shadows' own included."""
    pieces: int
    leaves: int


class Tally:
    """Copies a plan's tally aside while frames go on.

    Args:
        device: the card.
        plan: whose tally it is.

    Raises:
        GraphicsError: the card was lost, in every method.
    """

    def __init__(self, device: Any, plan: DrawPlan) -> None:
        self._device, self._plan = device, plan
        usage = wgpu.BufferUsage.MAP_READ | wgpu.BufferUsage.COPY_DST
        self._aside = device.create_buffer(size=4 * _WORDS, usage=usage)
        self._coming: Any = None
        self._age = 0

    def copy(self, encoder: Any) -> None:
        """Records a copy, unless one is on its way."""
        if self._coming is None:
            encoder.copy_buffer_to_buffer(self._plan.words, 4 * TALLY, self._aside, 0, 4 * _WORDS)

    @card_errors("telling what was drawn")
    def submitted(self) -> None:
        """Asks for the copy that was submitted."""
        if self._coming is None:
            self._coming, self._age = self._aside.map_async(wgpu.MapMode.READ), 0

    @card_errors("telling what was drawn")
    def late(self, shortened: int) -> Told | None:
        """What was asked for LATE calls ago; None in between. Waits where the card is farther behind than that.

        Args:
            shortened: bits by which needs were shortened.
        """
        self._age += 1
        if self._coming is None or self._age < LATE:
            return None
        self._coming.sync_wait()
        words = np.frombuffer(self._aside.read_mapped(), np.uint32).copy()
        self._aside.unmap()
        self._coming = None
        return _told(words, shortened)

    @card_errors("telling what was drawn")
    def now(self, shortened: int) -> Told:
        """What became of the last frame; waits for it."""
        data = self._device.queue.read_buffer(self._plan.words, 4 * TALLY, 4 * _WORDS)
        return _told(np.frombuffer(data, np.uint32), shortened)


def told_of(wanted: DrawList) -> Told:
    """The same of a draw list that was made on the CPU, for which there is always room."""
    return Told(wanted.counts, 0, len(wanted.placements), wanted.piece_count, wanted.leaf_count)


def _told(words: NDArray[np.uint32], shortened: int) -> Told:
    links, stems, *items = (int(word) << shortened for word in words[:4])
    refused, placements, pieces, leaves = (int(word) for word in words[5:9])
    return Told((links, stems, items[0], items[1]), refused, placements, pieces, leaves)
