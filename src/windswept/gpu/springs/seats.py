"""seats: who stands in which slot of which level when a simulation begins."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.errors import GraphicsError
from windswept.gpu import layouts
from windswept.gpu.springs.kinds import GrownKind
from windswept.gpu.springs.rows import Rows
from windswept.gpu.springs.rung_arrays import RungArrays
from windswept.levels import Eye, choose, fill_registers, seen_distance
from windswept.plants.plant import Ints


@dataclass(frozen=True, slots=True)
class Seats:
    """Where all placements are simulated."""

    motions: Rows
    """(P,) ``MOTION``"""
    members: NDArray[np.uint32]
    """Placement in every slot of every rung."""
    populations: NDArray[np.uint32]
    """(R,) members of every rung."""


def first_seats(kinds: list[GrownKind], arrays: RungArrays, eye: Eye) -> Seats:
    """Seats at the levels that an eye asks for, or the next coarser one with room.

    Args:
        kinds: what is simulated.
        arrays: their levels on the card.
        eye: who looks at the first moment.

    Raises:
        GraphicsError: there is not even room at the coarsest level.
    """
    motions = np.zeros(len(arrays.rooted), layouts.MOTION)
    members = np.zeros(arrays.member_rows, np.uint32)
    populations = np.zeros(len(arrays.rungs), np.uint32)
    for kind, row in zip(kinds, arrays.kinds, strict=True):
        first_rung, rung_count, first, count = (int(n) for n in row["ladder"])
        wanted = _wanted(kind, eye)
        room = arrays.rungs["room"][first_rung : first_rung + rung_count, 3]
        given = _with_room(fill_registers(wanted), room.astype(np.int64))
        own = motions[first : first + count]
        own["at"][:, 0] = first_rung + given
        own["origin"] = layouts.NONE
        own["wish"][:, 0] = wanted
        for place in range(rung_count):
            rung = first_rung + place
            who = np.flatnonzero(given == place)
            own["at"][who, 1] = np.arange(len(who))
            slot = int(arrays.rungs["probes"][rung, 3])
            members[slot : slot + len(who)] = first + who
            populations[rung] = len(who)
    return Seats(motions, members, populations)


def _wanted(kind: GrownKind, eye: Eye) -> Ints:
    """(P,) coarsest level that the eye allows each placement."""
    start = np.zeros(kind.placements.count, np.int32)
    if kind.ladder is None:
        return start
    return choose(kind.ladder, eye, seen_distance(eye, kind.placements.position, kind.radius), start)


def _with_room(given: Ints, room: NDArray[np.int64]) -> Ints:
    """(P,) levels with those that find no room moved on to the next coarser one."""
    levels = given.copy()
    for place, slots in enumerate(room):
        beyond = np.flatnonzero(levels == place)[slots:]
        if len(beyond) and place + 1 == len(room):
            raise GraphicsError(
                "the graphics card has too little room for the plants: simulate them on the CPU"
            )
        levels[beyond] = place + 1
    return levels
