"""Blades: many blades of one kind, where they stand and what a step reads of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.motion.blades.constraint import constraint_step, resolves
from windswept.motion.blades.kind import BladeKind
from windswept.motion.lanes import WIDTH
from windswept.motion.model import TIME_STEP
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats, Ints

CONSTANT_COUNT = 19
"""Rows of ``Blades.constants``; the kernel reads them by the numbers below."""
PLACE, AXIS, NORMAL, DRAG, REACH, FLAT_STEP, SIDE_STEP = 0, 3, 6, 9, 10, 11, 15

STATE_COUNT = 7
"""Rows of ``BladeState.lanes``."""
LEAN, RATE, BROKEN = 0, 3, 6


@dataclass(frozen=True, slots=True)
class Blades:
    """B blades of one kind, in the scene's frame. Neighbours in the arrays stand near each other."""

    kind: BladeKind
    parent_kind: int
    """Where in the list of all kinds their parents are; -1 on the ground."""
    parent: Ints
    """(B,) index among the parents' blades; -1 on the ground."""
    attach: Floats
    """(B,) where along the parent, 0 base to 1 tip."""
    placement: Ints
    """(B,) placement of the tuft to which each belongs."""
    base: Floats
    """(B, 3) root on the ground, m; 0 on a parent."""
    frame: Floats
    """(B, 3, 3) base frame, rows axis, normal, side: of the scene, or of the parent's section."""
    size: Floats
    """(B,) length over that of the kind."""
    time_step: float
    """s"""
    constants: Floats
    """(T, CONSTANT_COUNT, WIDTH) what a step reads, in tiles of WIDTH blades."""

    @property
    def count(self) -> int:
        """Number of blades, B."""
        return len(self.size)


@dataclass(slots=True)
class BladeState:
    """Motion of B blades of one kind. Stepped in place."""

    lanes: Floats
    """(T, STATE_COUNT, WIDTH) lean from rest along axis, normal and side, its rate (1/s), and 1 where broken."""
    count: int
    """B; the last tile's spare lanes move unseen."""
    step_count: int = 0
    """Steps taken since rest."""
    clamped_count: int = 0
    """How often a blade, in one call of a step, felt a force that was no number (taken for none) or too large to be
    meant (shortened)."""

    @property
    def lean(self) -> Floats:
        """(B, 3) lean from rest."""
        return from_tiles(self.lanes[:, LEAN : LEAN + 3])[: self.count]

    @property
    def rate(self) -> Floats:
        """(B, 3) rate of the lean, 1/s."""
        return from_tiles(self.lanes[:, RATE : RATE + 3])[: self.count]

    @property
    def broken(self) -> np.ndarray:
        """(B,) which blades are broken."""
        return from_tiles(self.lanes[:, BROKEN : BROKEN + 1])[: self.count, 0] > 0.5


def rest_blades(blades: Blades) -> BladeState:
    """State of blades that hang in calm air."""
    return BladeState(np.zeros((len(blades.constants), STATE_COUNT, WIDTH), np.float32), blades.count)


def to_tiles(rows: np.ndarray) -> Floats:
    """(T, N, WIDTH) tiles of (B, N) rows; spare lanes are copies of the last blade."""
    tiles = -(-len(rows) // WIDTH)
    last = np.minimum(np.arange(tiles * WIDTH), len(rows) - 1)
    tiled = rows[last].astype(np.float32).reshape(tiles, WIDTH, -1).transpose(0, 2, 1)
    return np.ascontiguousarray(tiled)


def from_tiles(tiles: Floats) -> Floats:
    """(T * WIDTH, N) rows of tiles (T, N, WIDTH)."""
    return np.ascontiguousarray(tiles.transpose(0, 2, 1)).reshape(-1, tiles.shape[1])


def place_blades(
    kind: BladeKind,
    base: Doubles | Floats,
    frame: Doubles | Floats,
    size: Doubles | Floats,
    force_point: Doubles | None = None,
    time_step: float = TIME_STEP,
) -> Blades:
    """Blades that stand on flat ground at height 0, each a tuft of its own.

    Args:
        kind: what they are.
        base: (B, 3) roots, m.
        frame: (B, 3, 3) rows axis, normal, side.
        size: (B,) length over that of the kind.
        force_point: (B, 3) where the field is sampled: x, y and height above the ground, m; None for the middle.
        time_step: s.
    """
    count = len(base)
    ground = np.full(count, -1, np.int32)
    place = middle(kind, base, frame, size) if force_point is None else force_point
    return Blades(
        kind=kind,
        parent_kind=-1,
        parent=ground,
        attach=np.zeros(count, np.float32),
        placement=np.arange(count, dtype=np.int32),
        base=base.astype(np.float32),
        frame=frame.astype(np.float32),
        size=size.astype(np.float32),
        time_step=time_step,
        constants=pack_blades(kind, frame, size, place, time_step),
    )


def middle(
    kind: BladeKind, base: Doubles | Floats, frame: Doubles | Floats, size: Doubles | Floats
) -> Doubles:
    """(B, 3) centre of the drag of blades whose base frames are those of the scene, without any load, m."""
    axis = kind.blade.axis.astype(np.float64)
    centre = np.cumsum(axis, axis=0) - 0.5 * axis
    mean = (kind.blade.area / kind.blade.area.sum()) @ centre
    return base + size[:, None] * np.einsum("i,bij->bj", mean, frame)


def pack_blades(
    kind: BladeKind,
    frame: Doubles | Floats,
    size: Doubles | Floats,
    place: Doubles | Floats,
    time_step: float,
) -> Floats:
    """(T, CONSTANT_COUNT, WIDTH) constants of blades with base frames (B, 3, 3) in the scene, as the kernel reads them.

    A longer blade is as much thicker as keeps its shape under its weight (`Blade`); then its drag per force scale
    goes as size^-1.5 and its frequency as size^-0.5.

    Args:
        kind: what they are.
        frame: (B, 3, 3) rows axis, normal, side.
        size: (B,) length over that of the kind.
        place: (B, 3) x, y and height above the ground at which the field is sampled, m.
        time_step: s.
    """
    rows = np.zeros((len(size), CONSTANT_COUNT))
    size = size.astype(np.float64)
    rows[:, PLACE : PLACE + 3] = place
    rows[:, AXIS : AXIS + 3] = frame[:, 0]
    rows[:, NORMAL : NORMAL + 3] = frame[:, 1]
    rows[:, DRAG] = kind.drag * size**-1.5
    for column, frequency in ((FLAT_STEP, kind.frequency[0]), (SIDE_STEP, kind.frequency[1])):
        rows[:, column : column + 4] = constraint_step(
            frequency / np.sqrt(size), kind.damping_ratio, time_step
        )
    rows[:, REACH] = kind.reach[0] * size * resolves(rows[:, FLAT_STEP : FLAT_STEP + 4])
    return to_tiles(rows)
