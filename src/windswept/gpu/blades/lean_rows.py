"""lean_rows: blades of several kinds as the card's step reads them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.gpu.blades.layouts import AIR_GRID, AIR_LIMIT, LEAN_BLOCK, LEAN_KIND
from windswept.motion.blades import BladeKind, Blades, PackedField
from windswept.motion.blades.blades import CONSTANT_COUNT
from windswept.motion.blades.step_blades import (
    BREAKING,
    HALF_EXPONENT,
    ONSET,
    PUSH,
    SHARE,
    SIDE_REACH,
    SOFTER,
    WEIGHT,
    kind_numbers,
)
from windswept.motion.lanes import WIDTH
from windswept.plants.plant import Floats

BLOCK = 64
"""Blades of one kind in a workgroup: BLOCK of ``lean.wgsl``."""


@dataclass(frozen=True, slots=True)
class LeanRows:
    """Blades of S sets, each of one kind, one set after the other."""

    blocks: NDArray[np.void]
    """``LEAN_BLOCK``: runs of up to BLOCK blades."""
    kinds: NDArray[np.void]
    """``LEAN_KIND``, each kind once."""
    constants: Floats
    """(T * CONSTANT_COUNT * WIDTH,) tiles of all sets."""
    tiles: tuple[int, ...]
    """(S,) of every set."""


def lean_rows(sets: Sequence[Blades], airs: Sequence[int]) -> LeanRows:
    """Lay out sets of blades.

    Args:
        sets: what stands where.
        airs: (S,) which of the fields of air each set feels.
    """
    kinds: dict[int, int] = {}
    rows: list[NDArray[np.void]] = []
    blocks: list[NDArray[np.uint32]] = []
    tiles = tuple(len(blades.constants) for blades in sets)
    for blades, air, first in zip(sets, airs, np.cumsum([0, *tiles]), strict=False):
        if id(blades.kind) not in kinds:
            kinds[id(blades.kind)] = len(kinds)
            rows.append(_kind_row(blades.kind))
        start = np.arange(0, blades.count, BLOCK)
        block = np.empty((len(start), 4), np.uint32)
        block[:, 0], block[:, 1] = first + start // WIDTH, np.minimum(blades.count - start, BLOCK)
        block[:, 2:] = kinds[id(blades.kind)], air
        blocks.append(block)
    return LeanRows(
        np.concatenate([np.zeros((0, 4), np.uint32), *blocks]).view(LEAN_BLOCK).ravel(),
        np.concatenate([np.zeros(0, LEAN_KIND), *rows]),
        np.concatenate([np.zeros(0, np.float32), *(blades.constants.ravel() for blades in sets)]),
        tiles,
    )


def shares_of(rows: LeanRows, limit: int) -> Iterator[tuple[int, NDArray[np.void], Floats]]:
    """Shares whose constants take no more than ``limit`` bytes: first tile, blocks, constants of their tiles."""
    tile = CONSTANT_COUNT * WIDTH
    spare = BLOCK // WIDTH
    step = max(limit // (4 * tile) - spare, 1)
    begin = rows.blocks["rows"][:, 0]
    for first in range(0, sum(rows.tiles), step):
        # A block that begins in a share may end in the next.
        mine = rows.blocks[(begin >= first) & (begin < first + step)]
        yield first, mine, rows.constants[first * tile : (first + step + spare) * tile]


def _kind_row(kind: BladeKind) -> NDArray[np.void]:
    """(1,) ``LEAN_KIND``."""
    numbers: list[float] = kind_numbers(kind).tolist()
    row = np.zeros(1, LEAN_KIND)
    row["share"] = *numbers[SHARE : SHARE + 3], numbers[HALF_EXPONENT]
    row["air"] = numbers[PUSH], numbers[ONSET], numbers[WEIGHT], numbers[SIDE_REACH]
    row["bounds"] = numbers[SOFTER], numbers[BREAKING], 0.0, 0.0
    return row


def air_grids(fields: Sequence[PackedField]) -> NDArray[np.void]:
    """(AIR_LIMIT,) ``AIR_GRID`` of fields whose nodes lie one after the other."""
    rows = np.zeros(AIR_LIMIT, AIR_GRID)
    first = 0
    for row, field in zip(rows, fields, strict=False):
        grid = field.grid
        row["nodes"] = grid.nodes_x, grid.nodes_y, grid.nodes_z, first
        row["origin"][:2] = grid.origin_x, grid.origin_y
        row["per_metre"][:3] = grid.per_x, grid.per_y, grid.per_z
        first += field.nodes.size // WIDTH
    return rows
