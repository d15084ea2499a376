"""room_for: how many placements each level has room for on a card."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.errors import GraphicsError
from windswept.gpu import layouts
from windswept.motion import Level

Counts = NDArray[np.int64]
RECORD = 5
"""Rows of a link in the stack: RECORD of ``springs.wgsl``."""
MODE_RECORD = 5
"""Rows of the modes beyond them: MODE_RECORD of ``springs.wgsl``."""
ROOM_BYTES = 1 << 30
"""Of a buffer at most, whatever the card could bind, if the coarsest levels need no more."""
NARROWEST = 8
"""Blocks of few placements are as wide as these, rounded up to so many: whole lines of a card's cache."""
NOTES = 32
"""Bytes that are noted of every link of a placement while it changes its level."""
NOTE_BYTES = 1 << 28
"""Of all notes at most, whatever a buffer may have."""


@dataclass(frozen=True, slots=True)
class BlockSize:
    """Rows of ``vec4f`` that one lane of a block takes at each of R rungs."""

    state: Counts
    """(R,) one a link, two a group."""
    stack: Counts
    """(R,) of `springs`: the links between the root and the walk's place, and the modes."""
    wind: Counts
    """(R,) two a probe: both ends of an interval."""
    carried: Counts
    """(R,) of `multibody`: what lasts of the links beyond their joints."""
    records: Counts
    """(R,) of `multibody`: of the links within a step."""
    slots: Counts
    """(R,) of `multibody`: of the depths within a walk."""

    @property
    def columns(self) -> Counts:
        """(R, 6) in the order above."""
        return np.stack([self.state, self.stack, self.wind, self.carried, self.records, self.slots], axis=1)


def block_size(levels: list[Level]) -> BlockSize:
    """Sizes of the blocks of some levels."""
    links = np.array([level.link_count for level in levels])
    groups = np.array([level.group_count for level in levels])
    probes = np.array([len(level.probe_position) for level in levels])
    depths = np.array([int(level.depth.max(initial=0)) for level in levels]) + 1
    is_coupled = np.array([level.coupled for level in levels])
    return BlockSize(
        state=links + 2 * groups,
        stack=np.where(is_coupled, 0, RECORD * depths + MODE_RECORD),
        wind=2 * probes,
        carried=is_coupled * layouts.CARRIED_ROWS * links,
        records=is_coupled * layouts.RECORD_ROWS * links,
        slots=is_coupled * layouts.SLOT_ROWS * depths,
    )


def room_for(size: BlockSize, placements: Counts, coarsest: NDArray[np.bool_], limit: int) -> Counts:
    """(R,) room of every rung, in whole blocks; a kind of fewer placements than LANES has one narrow block a rung.

    Where all fit everywhere, every rung has room for all placements of its kind. Where they do not, the rungs that take
    most get less, all of them the same number of bytes; placements that find no room stay at the level they are at.

    Args:
        size: of a block at each rung.
        placements: (R,) of the kind of each rung.
        coarsest: (R,) whether the rung is the last of its ladder, which always has room for all.
        limit: bytes that a buffer may have.

    Raises:
        GraphicsError: not even the coarsest levels fit.
    """
    width = np.minimum(-(-np.maximum(placements, 1) // NARROWEST) * NARROWEST, layouts.LANES)
    everyone = -(-np.maximum(placements, 1) // width)
    row_bytes = layouts.ROW.itemsize * width[:, None] * size.columns

    def blocks(share: float) -> Counts:
        """Blocks of every rung if each buffer of it may have so many bytes."""
        most = np.floor(share / row_bytes.max(axis=1)).astype(np.int64)
        return np.where(coarsest, everyone, np.minimum(everyone, most))

    low, high = 0.0, float((everyone[:, None] * row_bytes).max(initial=0))
    needed = int((blocks(low)[:, None] * row_bytes).sum(axis=0).max())
    if needed > limit:
        raise GraphicsError(
            f"the simulation needs {needed / 1e6:.2f} MB in one buffer and this adapter takes {limit / 1e6:.2f} MB: "
            "place fewer plants, or simulate on the CPU"
        )
    budget = min(limit, max(ROOM_BYTES, needed))

    def fits(share: float) -> bool:
        return bool(((blocks(share)[:, None] * row_bytes).sum(axis=0) <= budget).all())

    if fits(high):
        return blocks(high) * width
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if fits(middle) else (low, middle)
    return blocks(low) * width


def joins_for(placements: int, longest: int, rungs: int, limit: int) -> tuple[int, int]:
    """How many placements may join each rung at once, and all rungs together; the others wait for the next time.

    Args:
        placements: of all kinds.
        longest: links of the largest plant.
        rungs: of all kinds.
        limit: bytes that a buffer may have.
    """
    together = min(limit, NOTE_BYTES) // (NOTES * longest)
    if placements <= together:
        return placements, placements
    each = max(together // rungs, 1)
    return each, min(each * rungs, placements)
