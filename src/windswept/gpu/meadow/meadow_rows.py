"""Beds -> everything about their blades that stays the same, as the card reads it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from windswept.gpu.layouts import NONE
from windswept.gpu.meadow.layouts import BLADE_ROW, BLADE_RUN
from windswept.motion.blades import BladeKind, Blades, PoseTable, simplify_table
from windswept.motion.blades.blades import STATE_COUNT
from windswept.motion.blades.pose_blades import rest_frame
from windswept.motion.lanes import WIDTH
from windswept.plants.plant import Floats, Ints
from windswept.scene.meadow_bed import Bed

Doubles = NDArray[np.float64]

LEVEL_SECTIONS = (16, 3, 2)
"""Most sections that a blade is drawn with at each level."""
LEVELS = len(LEVEL_SECTIONS)
STALK = 3.0
"""Width for detail of a stalk over its own."""
CHUNK = 128
"""Neighbouring blades of a kind that are seen or hidden together."""


@dataclass(frozen=True, slots=True)
class MeadowRows:
    """N blades in S sets, one for each kind of each bed; C chunks."""

    blades: NDArray[np.void]
    """(N,) ``BLADE_ROW``."""
    runs: NDArray[np.void]
    """(S * LEVELS,) ``BLADE_RUN``: a set drawn with the sections of a level."""
    tables: Floats
    """(F, 2) turns of all tables."""
    borders: Floats
    """Half widths at the joints of all runs, m."""
    state_sizes: tuple[int, ...]
    """Numbers of the state of every set that moves, in order."""
    parent: Ints
    """(N,) blade that carries each, -1 on the ground."""
    depth: NDArray[np.uint8]
    """(N,) how many blades carry it, one on another."""
    chance: Floats
    """(N,) random number in 0..1 that says how early it is left out."""
    chunk: Ints
    """(N,) chunk of every blade."""
    chunk_first: Ints
    """(C + 1,) first blade of every chunk."""
    chunk_set: Ints
    """(C,)"""
    chunk_ball: Floats
    """(C, 4) middle and radius of a ball round its blades, m."""
    set_size: Floats
    """(S, 2) mean width as drawn and mean length of a section, m."""
    sections: Ints
    """(S, LEVELS)"""


@dataclass(frozen=True, slots=True)
class _Set:
    """One kind of one bed."""

    blades: Blades
    stands_for: float
    first: int
    """Blade."""
    state_first: int
    """NONE where it does not move."""
    parents_first: int
    """First blade of the parents' set; -1 on the ground."""
    depth: int
    root: Floats
    """(B, 3) where on the ground every blade stands, or what carries it, m."""
    reach: Floats
    """(B,) how far from there its tip can get, however it and what carries it may lean, m."""


def meadow_rows(beds: Sequence[Bed]) -> MeadowRows:
    """Lay out the blades of all beds.

    Args:
        beds: as the scene planted them.
    """
    sets, state_sizes = _sets(beds)
    tables, borders = _Tables(), _Borders()
    runs = np.concatenate([_run(one, level, tables, borders) for one in sets for level in range(LEVELS)])
    rows = [_blade_rows(one, number) for number, one in enumerate(sets)]
    chunks = [_chunks(one) for one in sets]
    chunk_counts = [len(first) for first, _ in chunks]
    chunk_first = [one.first + first for one, (first, _) in zip(sets, chunks, strict=True)]
    count = sum(one.blades.count for one in sets)
    edges = np.concatenate([*chunk_first, [count]]).astype(np.int32)
    counts = [one.blades.count for one in sets]
    parents = [
        one.blades.parent + np.int32(one.parents_first) if one.parents_first >= 0 else one.blades.parent
        for one in sets
    ]
    return MeadowRows(
        blades=np.concatenate(rows),
        runs=runs,
        tables=np.concatenate(tables.rows),
        borders=np.concatenate(borders.rows).astype(np.float32),
        state_sizes=tuple(state_sizes),
        parent=np.concatenate(parents).astype(np.int32),
        depth=np.repeat([one.depth for one in sets], counts).astype(np.uint8),
        chance=np.concatenate([((row["bits"][:, 3] & 0xFFFF) / 65536.0).astype(np.float32) for row in rows]),
        chunk=np.repeat(np.arange(len(edges) - 1), np.diff(edges)).astype(np.int32),
        chunk_first=edges,
        chunk_set=np.repeat(np.arange(len(sets)), chunk_counts).astype(np.int32),
        chunk_ball=np.concatenate([ball for _, ball in chunks]).astype(np.float32),
        set_size=np.array([_mean_size(one) for one in sets], np.float32),
        sections=np.array([_level_sections(one.blades.kind) for one in sets], np.int32),
    )


def _sets(beds: Sequence[Bed]) -> tuple[list[_Set], list[int]]:
    """All kinds of all beds, and how many numbers the states of those that move have."""
    sets: list[_Set] = []
    state_sizes: list[int] = []
    first = 0
    for bed in beds:
        own = len(sets)
        for blades, state, stands_for in zip(bed.blades, bed.states, bed.stands_for, strict=True):
            above = None if blades.parent_kind < 0 else sets[own + blades.parent_kind]
            length = blades.size * np.float32(blades.kind.table.length.sum())
            sets.append(
                _Set(
                    blades,
                    stands_for,
                    first,
                    NONE if state is None else sum(state_sizes),
                    -1 if above is None else above.first,
                    0 if above is None else above.depth + 1,
                    blades.base if above is None else above.root[blades.parent],
                    length if above is None else length + above.reach[blades.parent],
                )
            )
            first += blades.count
            if state is not None:
                state_sizes.append(len(state.lanes) * STATE_COUNT * WIDTH)
    return sets, state_sizes


def _level_sections(kind: BladeKind) -> list[int]:
    """Sections of a kind at every level."""
    return [min(kind.table.section_count, most) for most in LEVEL_SECTIONS]


def _mean_size(one: _Set) -> tuple[float, float]:
    """Mean width as drawn and length of a section, m."""
    kind, size = one.blades.kind, float(one.blades.size.mean())
    return _width_for_detail(kind) * one.stands_for * size, float(kind.table.length.mean()) * size


def _width_for_detail(kind: BladeKind) -> float:
    """Mean width of a blade of size 1, m; stalks count as wider, since few thick ones would look like posts."""
    width = 2.0 * float(np.abs(kind.blade.left[:, 2]).mean())
    return STALK * width if kind.blade.round else width


def _run(one: _Set, level: int, tables: _Tables, borders: _Borders) -> NDArray[np.void]:
    """(1,) ``BLADE_RUN`` of a set at a level."""
    kind, component = one.blades.kind, one.blades.kind.blade.component
    sections = _level_sections(kind)[level]
    row = np.zeros(1, BLADE_RUN)
    row["whole"] = tables.place_of(kind.table, sections)
    row["broken"] = tables.place_of(kind.broken_table, sections)
    row["rows"] = one.first, one.state_first, sections, borders.place_of(kind, sections)
    length = float(kind.table.length.sum()) / sections
    round_power = 1.5 if kind.blade.round else 1.0
    row["shape"] = length, kind.weight, 1.0 / kind.broken_scale, round_power
    on_ground = one.blades.parent_kind < 0
    row["width"] = _width_for_detail(kind) * one.stands_for, one.stands_for, kind.blade.round, on_ground
    row["colour"] = *component.colour, 0.0
    row["tip"] = *component.tip_colour, 0.0
    return row


class _Tables:
    """Tables one after the other, each once."""

    def __init__(self) -> None:
        self.rows: list[Floats] = []
        self._count = 0
        self._places: dict[tuple[int, int], tuple[int, int, int, int]] = {}

    def place_of(self, table: PoseTable, sections: int) -> tuple[int, int, int, int]:
        """First row of a table, simplified if it has more sections, and its bins of angle, norm and direction."""
        key = id(table), sections
        if key not in self._places:
            drawn = table if sections == table.section_count else simplify_table(table, sections)
            angle, norm, direction = (nodes - 1 for nodes in drawn.turns.shape[:3])
            self._places[key] = self._count, angle, norm, direction
            self.rows.append(drawn.turns.reshape(-1, 2))
            self._count += len(self.rows[-1])
        return self._places[key]


class _Borders:
    """Half widths at the joints of kinds, each once."""

    def __init__(self) -> None:
        self.rows: list[Floats] = []
        self._count = 0
        self._places: dict[tuple[int, int], int] = {}

    def place_of(self, kind: BladeKind, sections: int) -> int:
        """First number of a kind's borders with so many sections; between fewer joints the mean width stays."""
        key = id(kind), sections
        if key not in self._places:
            border = np.abs(kind.blade.left[:, 2]).astype(np.float64)
            place = np.linspace(0.0, 1.0, len(border))
            drawn = np.interp(np.linspace(0.0, 1.0, sections + 1), place, border)
            drawn *= np.trapezoid(border, place) / np.trapezoid(drawn, dx=1.0 / sections)
            self._places[key] = self._count
            self.rows.append(drawn.astype(np.float32))
            self._count += len(drawn)
        return self._places[key]


def _blade_rows(one: _Set, number: int) -> NDArray[np.void]:
    """(B,) ``BLADE_ROW`` of a set."""
    blades = one.blades
    rows = np.zeros(blades.count, BLADE_ROW)
    rows["place"][:, :3] = blades.base
    if blades.parent_kind >= 0:
        rows["place"][:, 0] = blades.attach
    rows["place"][:, 3] = blades.size
    # The columns of the rotation are the frame's axes.
    turned = Rotation.from_matrix(blades.frame.transpose(0, 2, 1).astype(np.float64)).as_quat()
    rows["bits"][:, 0] = _pairs(turned[:, 0], turned[:, 1])
    rows["bits"][:, 1] = _pairs(turned[:, 2], turned[:, 3])
    down = octahedral(rest_frame(blades)[:, :, 2].astype(np.float64))
    rows["bits"][:, 2] = _pairs(*down.T)
    chance = np.random.default_rng([number, 0xB1ADE]).integers(0, 65536, blades.count).astype(np.uint32)
    rows["bits"][:, 3] = chance | (_rests(down) << np.uint32(16))
    return rows


def octahedral(vectors: Doubles) -> Doubles:
    """(B, 2) in -1..1 from unit vectors (B, 3): folded onto the octahedron (Meyer et al. 2010)."""
    flat = vectors / np.abs(vectors).sum(axis=1, keepdims=True)
    folded = (1.0 - np.abs(flat[:, 1::-1])) * np.where(flat[:, :2] >= 0.0, 1.0, -1.0)
    return np.where(flat[:, 2:] >= 0.0, flat[:, :2], folded)


def _pairs(low: Doubles, high: Doubles) -> NDArray[np.uint32]:
    """(B,) two numbers of -1..1 each, as ``pack2x16snorm`` packs them."""
    parts = [
        np.rint(32767.0 * np.clip(part, -1.0, 1.0)).astype(np.int16).view(np.uint16) for part in (low, high)
    ]
    return parts[0].astype(np.uint32) | (parts[1].astype(np.uint32) << np.uint32(16))


def _rests(values: Doubles) -> NDArray[np.uint32]:
    """(B,) what ``_pairs`` loses of two numbers, 8 bits each: a blade that is pressed flat shows errors of its load.

    A lean of nearly 1 stands for any large load, so that there a small error turns the tip by much.
    """
    lost = 32767.0 * values - np.rint(32767.0 * values)
    low, high = (np.rint(254.0 * part).astype(np.int8).view(np.uint8) for part in lost.T)
    return low.astype(np.uint32) | (high.astype(np.uint32) << np.uint32(8))


def _chunks(one: _Set) -> tuple[Ints, Doubles]:
    """First blade of every chunk of a set, and (C, 4) balls that none of its blades can leave."""
    first = np.arange(0, one.blades.count, CHUNK, dtype=np.int32)
    low, high = np.minimum.reduceat(one.root, first), np.maximum.reduceat(one.root, first)
    radius = 0.5 * np.linalg.norm(high - low, axis=1) + np.maximum.reduceat(one.reach, first)
    return first, np.column_stack([0.5 * (low + high), radius]).astype(np.float64)
