"""rung_arrays: every level of every kind in the card's layouts, one after another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.errors import GraphicsError
from windswept.gpu import layouts
from windswept.gpu.springs.kinds import GrownKind
from windswept.gpu.springs.mode_rows import mode_rows
from windswept.gpu.springs.room import block_size, joins_for, room_for
from windswept.gpu.springs.rows import Rows, group_rows, link_rows, listener_rows, shape_rows
from windswept.motion import Level
from windswept.plants.plant import Floats


@dataclass(frozen=True, slots=True)
class RungArrays:
    """Constants of K kinds with R rungs; a *rung* is one simulation level of one kind."""

    kinds: Rows
    """(K,) ``KIND``"""
    rungs: Rows
    """(R,) ``RUNG``"""
    links: Rows
    """``LINK``, level after level."""
    groups: Rows
    """``GROUP``, level after level."""
    modes: NDArray[np.uint32]
    """(n, 4) see mode_rows.py."""
    probes: Floats
    """(n, 4) positions of the probes in the plant's frame, level after level, m; 0."""
    listeners: NDArray[np.uint32]
    """(n, 4) what turns each joint of the plant, level after level."""
    shapes: Rows
    """``SHAPE``, kind after kind."""
    rooted: Rows
    """(P,) ``ROOTED``, kind after kind."""
    levels: tuple[Level, ...]
    """(R,)"""
    state_rows: int
    """Rows of ``vec4f`` that all rungs together need for state, stack and wind."""
    stack_rows: int
    wind_rows: int
    member_rows: int
    """Slots of all rungs."""
    pose_rows: int
    """Links of all placements."""
    longest: int
    """Links of the largest plant."""
    joins_each: int
    """Placements that may join a rung at once, and all rungs together."""
    joins_together: int

    @property
    def coupled(self) -> NDArray[np.bool_]:
        """(R,) whether `multibody` moves the plants of a rung."""
        return np.array([level.coupled for level in self.levels], bool)


def rung_arrays(kinds: list[GrownKind], limit: int) -> RungArrays:
    """Brings kinds into the card's layouts.

    Args:
        kinds: what is simulated.
        limit: bytes that a buffer may have.

    Raises:
        GraphicsError: the card has too little room.
    """
    if not kinds:
        return _nothing()
    levels = [level for kind in kinds for level in kind.levels]
    if len(kinds) > layouts.KIND_LIMIT or len(levels) > layouts.RUNG_LIMIT:
        raise GraphicsError(
            f"the card simulates up to {layouts.KIND_LIMIT} kinds of plants with {layouts.RUNG_LIMIT} levels in all, "
            f"and the scene has {len(kinds)} with {len(levels)}: simulate it on the CPU"
        )
    owner = np.repeat(np.arange(len(kinds)), [len(kind.levels) for kind in kinds])
    rungs = _rung_rows(kinds, levels, owner, limit)
    size = block_size(levels)
    room = rungs["room"][:, 3].astype(np.int64)
    placed, longest = (
        sum(kind.placements.count for kind in kinds),
        max(kind.model.link_count for kind in kinds),
    )
    joins_each, joins_together = joins_for(placed, longest, len(levels), limit)
    return RungArrays(
        kinds=_kind_rows(kinds, rungs),
        rungs=rungs,
        links=np.concatenate([link_rows(level) for level in levels]),
        groups=np.concatenate([group_rows(level) for level in levels]),
        modes=mode_rows(levels),
        probes=np.pad(np.concatenate([level.probe_position for level in levels]), [(0, 0), (0, 1)]),
        listeners=np.concatenate([listener_rows(level) for level in levels]),
        shapes=np.concatenate([shape_rows(kind.levels[-1], kind.model) for kind in kinds]),
        rooted=_rooted_rows(kinds),
        levels=tuple(levels),
        state_rows=int((room * size.state).sum()),
        stack_rows=int((room * size.stack).sum()),
        wind_rows=int((room * size.wind).sum()),
        member_rows=int(room.sum()),
        pose_rows=sum(kind.placements.count * kind.model.link_count for kind in kinds),
        longest=longest,
        joins_each=joins_each,
        joins_together=joins_together,
    )


def _nothing() -> RungArrays:
    """Of a scene without plants that stand by themselves, such as a meadow."""
    return RungArrays(
        kinds=np.zeros(0, layouts.KIND),
        rungs=np.zeros(0, layouts.RUNG),
        links=np.zeros(0, layouts.LINK),
        groups=np.zeros(0, layouts.GROUP),
        modes=np.zeros((0, 4), np.uint32),
        probes=np.zeros((0, 4), np.float32),
        listeners=np.zeros((0, 4), np.uint32),
        shapes=np.zeros(0, layouts.SHAPE),
        rooted=np.zeros(0, layouts.ROOTED),
        levels=(),
        state_rows=0,
        stack_rows=0,
        wind_rows=0,
        member_rows=0,
        pose_rows=0,
        longest=1,
        joins_each=0,
        joins_together=0,
    )


def _rung_rows(kinds: list[GrownKind], levels: list[Level], owner: NDArray[np.int64], limit: int) -> Rows:
    """``RUNG`` rows: where everything of each level begins, and how much room it has."""
    place = np.concatenate([np.arange(len(kind.levels)) for kind in kinds])
    last = np.append(owner[1:] != owner[:-1], True)
    size = block_size(levels)
    room = room_for(size, np.array([kind.placements.count for kind in kinds])[owner], last, limit)
    link_count = np.array([level.link_count for level in levels])
    group_count = np.array([level.group_count for level in levels])
    probe_count = np.array([len(level.probe_position) for level in levels])
    joint_count = np.array([kind.model.link_count for kind in kinds])[owner]
    rows = np.zeros(len(levels), layouts.RUNG)
    depth = [int(level.depth.max(initial=0)) for level in levels]
    rows["links"] = np.stack([_starts(link_count), link_count, depth, owner], axis=1)
    grounded = [int(level.group_start[1]) for level in levels]
    rows["groups"] = np.stack([_starts(group_count), group_count, grounded, place], axis=1)
    rows["probes"] = np.stack(
        [_starts(probe_count), probe_count, _starts(joint_count), _starts(room)], axis=1
    )
    firsts = [_starts(room * column) for column in (size.state, size.stack, size.wind)]
    rows["room"] = np.stack([*firsts, room], axis=1)
    for row, level in zip(rows, levels, strict=True):
        row["air"][:2] = level.material.reconfiguration_speed, 0.5 * level.material.reconfiguration
    errors = [np.maximum.accumulate(kind.ladder.error) if kind.ladder else np.zeros(1) for kind in kinds]
    rows["air"][:, 2] = np.concatenate(errors)
    rows["air"][:, 3] = [_moved_by(level) for level in levels]
    return rows


def _moved_by(level: Level) -> int:
    """STILL, SPRINGS or MULTIBODY."""
    if level.coupled:
        return layouts.MULTIBODY
    return layouts.SPRINGS if level.moves else layouts.STILL


def _kind_rows(kinds: list[GrownKind], rungs: Rows) -> Rows:
    """``KIND`` rows."""
    rung_count = np.array([len(kind.levels) for kind in kinds])
    placement_count = np.array([kind.placements.count for kind in kinds])
    joint_count = np.array([kind.model.link_count for kind in kinds])
    rows = np.zeros(len(kinds), layouts.KIND)
    first_rung = _starts(rung_count)
    rows["ladder"] = np.stack([first_rung, rung_count, _starts(placement_count), placement_count], axis=1)
    first_link = rungs["links"][first_rung, 0]
    rows["joints"] = np.stack([first_link, joint_count, 0 * joint_count, _starts(joint_count)], axis=1)
    rows["size"][:, :2] = [(kind.radius, kind.levels[-1].shape_limit) for kind in kinds]
    return rows


def _rooted_rows(kinds: list[GrownKind]) -> Rows:
    """``ROOTED`` rows of all placements."""
    count = [kind.placements.count for kind in kinds]
    rows = np.zeros(sum(count), layouts.ROOTED)
    yaw = np.concatenate([kind.placements.yaw for kind in kinds]).astype(np.float64)
    rows["position"][:, :3] = np.concatenate([kind.placements.position for kind in kinds])
    rows["position"][:, 3] = np.cos(yaw)
    rows["heading"][:, 0] = np.sin(yaw)
    rows["rows"][:, 0] = np.repeat(np.arange(len(kinds)), count)
    return rows


def _starts(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Where each of some runs begins when they stand one after another."""
    return np.cumsum(counts) - counts
