"""plant_tufts: tufts set down in a scene, as blades of every kind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from windswept.motion.blades.blades import Blades, middle, pack_blades, place_blades
from windswept.motion.blades.kind import BladeKind
from windswept.motion.blades.pose_blades import carried, pose_blades
from windswept.motion.model import TIME_STEP
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats, Ints
from windswept.plants.underbrush import BladePose, Tuft

BLOCK = 1.0
"""Edge of the squares by which blades are ordered, m: neighbours read the same nodes of the field."""


@dataclass(frozen=True, slots=True)
class TuftPlaces:
    """Where P tufts stand."""

    tuft: Ints
    """(P,) which of the tufts."""
    position: Floats
    """(P, 3) m."""
    yaw: Floats
    """(P,) turn round +z, rad."""
    normal: Floats
    """(P, 3) of the ground, unit vectors."""
    size: Floats
    """(P,) length over that of the tuft."""


@dataclass(frozen=True, slots=True)
class _Rows:
    """Blades of one kind on all places, before they are sorted: tuft after tuft, place after place."""

    placement: Ints
    """(B,)"""
    rank: Ints
    """(B,) of the placement among those of the same tuft."""
    tuft: Ints
    """(B,)"""
    blade: Ints
    """(B,) of its tuft."""
    start: Ints
    """(V,) first row of every tuft."""
    first: Ints
    """(V,) first blade of the kind in every tuft."""
    each: Ints
    """(V,) blades of the kind in every tuft."""


def plant_tufts(
    tufts: Sequence[Tuft], kinds: Sequence[BladeKind], places: TuftPlaces, time_step: float = TIME_STEP
) -> list[Blades]:
    """Blades of every kind of one species, in the order of its components.

    A tuft's +z is the normal of the ground. What a parent carries is at rest where the parent's rest pose puts it, and
    feels the wind there; when it is drawn, it goes where the parent goes.

    Args:
        tufts: (V,) of one species, with different seeds.
        kinds: (C,) from the tufts' components.
        places: where they stand.
        time_step: s.
    """
    planted: list[Blades] = []
    poses: list[BladePose] = []
    sorted_row: list[Ints] = []
    rows: list[_Rows] = []
    for number, kind in enumerate(kinds):
        row = _rows(tufts, places, number)
        order = _by_neighbourhood(places.position[row.placement])
        rows.append(row)
        sorted_row.append(_inverse(order))
        above = _parent_kind(tufts, number)
        if above < 0:
            blades = _on_the_ground(kind, tufts, places, row, order, time_step)
        else:
            parent = sorted_row[above][_parent_rows(tufts, row, rows[above])][order]
            blades = _on_parents(kind, tufts, places, row, order, (above, parent, poses[above]), time_step)
        planted.append(blades)
        poses.append(pose_blades(blades, parents=poses[above] if above >= 0 else None))
    return planted


def _rows(tufts: Sequence[Tuft], places: TuftPlaces, kind: int) -> _Rows:
    """All blades of a kind."""
    first = np.array([np.searchsorted(tuft.blade_kind, kind) for tuft in tufts], np.int32)
    each = np.array([np.sum(tuft.blade_kind == kind) for tuft in tufts], np.int32)
    members = [np.flatnonzero(places.tuft == t) for t in range(len(tufts))]
    start = np.concatenate([[0], np.cumsum([len(m) * n for m, n in zip(members, each, strict=True)])])[:-1]
    return _Rows(
        placement=np.concatenate([np.repeat(m, n) for m, n in zip(members, each, strict=True)]),
        rank=np.concatenate([np.repeat(np.arange(len(m)), n) for m, n in zip(members, each, strict=True)]),
        tuft=np.repeat(np.arange(len(tufts)), [len(m) * n for m, n in zip(members, each, strict=True)]),
        blade=np.concatenate(
            [np.tile(f + np.arange(n), len(m)) for m, f, n in zip(members, first, each, strict=True)]
        ),
        start=start.astype(np.int32),
        first=first,
        each=each,
    )


def _parent_kind(tufts: Sequence[Tuft], kind: int) -> int:
    """Kind on which a kind sits, -1 for the ground."""
    names = [blade.component.name for blade in tufts[0].kinds]
    parent = tufts[0].kinds[kind].component.parent
    return names.index(parent) if parent else -1


def _parent_rows(tufts: Sequence[Tuft], row: _Rows, above: _Rows) -> Ints:
    """(B,) row of every blade's parent among its own kind's rows."""
    local = _gather(tufts, row, "blade_parent") - above.first[row.tuft]
    return above.start[row.tuft] + row.rank * above.each[row.tuft] + local


def _gather(tufts: Sequence[Tuft], row: _Rows, name: str) -> np.ndarray:
    """(B, ...) a column of the tufts for every row."""
    return np.concatenate([getattr(tuft, name)[row.blade[row.tuft == t]] for t, tuft in enumerate(tufts)])


def _by_neighbourhood(position: Floats) -> Ints:
    """(B,) order in which neighbours come together: square after square, along every other row backwards."""
    square = np.floor((position[:, :2] - position[:, :2].min(axis=0)) / BLOCK).astype(np.int64)
    along = np.where(square[:, 1] % 2 == 0, square[:, 0], -square[:, 0])
    return np.lexsort((along, square[:, 1])).astype(np.int32)


def _inverse(order: Ints) -> Ints:
    """Where every row went."""
    inverse = np.empty_like(order)
    inverse[order] = np.arange(len(order), dtype=np.int32)
    return inverse


def _on_the_ground(
    kind: BladeKind, tufts: Sequence[Tuft], places: TuftPlaces, row: _Rows, order: Ints, time_step: float
) -> Blades:
    """Sorted blades that stand on the ground."""
    placement = row.placement[order]
    stand = _stands(places)[placement]
    size = (_gather(tufts, row, "blade_size")[order] * places.size[placement]).astype(np.float32)
    root = _gather(tufts, row, "blade_root")[order] * places.size[placement, None]
    base = places.position[placement] + np.einsum("bi,bij->bj", root, stand)
    frame = np.einsum("bij,bjk->bik", _gather(tufts, row, "blade_frame")[order], stand)
    point = middle(kind, base, frame, size)
    point[:, 2] -= places.position[placement, 2]
    blades = place_blades(kind, base, frame, size, point, time_step)
    return replace(blades, placement=placement.astype(np.int32))


def _on_parents(
    kind: BladeKind,
    tufts: Sequence[Tuft],
    places: TuftPlaces,
    row: _Rows,
    order: Ints,
    above: tuple[int, Ints, BladePose],
    time_step: float,
) -> Blades:
    """Sorted blades on parents: their kind, (B,) which of them, and their pose at rest."""
    placement = row.placement[order]
    size = (_gather(tufts, row, "blade_size")[order] * places.size[placement]).astype(np.float32)
    count = len(order)
    blades = Blades(
        kind=kind,
        parent_kind=above[0],
        parent=above[1].astype(np.int32),
        attach=_gather(tufts, row, "blade_attach")[order],
        placement=placement.astype(np.int32),
        base=np.zeros((count, 3), np.float32),
        frame=_gather(tufts, row, "blade_frame")[order],
        size=size,
        time_step=time_step,
        constants=np.empty((0, 0, 0), np.float32),
    )
    base, frame = carried(blades, above[2])
    point = middle(kind, base, frame, size)
    point[:, 2] -= places.position[placement, 2]
    return replace(blades, constants=pack_blades(kind, frame, size, point, time_step))


def _stands(places: TuftPlaces) -> Doubles:
    """(P, 3, 3) rows: a tuft's x, y and z in the scene; z is the ground's normal, x turned by the yaw."""
    normal = places.normal.astype(np.float64)
    ahead = np.stack([np.cos(places.yaw), np.sin(places.yaw), np.zeros(len(normal))], axis=1)
    side = np.cross(normal, ahead)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    return np.stack([np.cross(side, normal), side, normal], axis=1)
