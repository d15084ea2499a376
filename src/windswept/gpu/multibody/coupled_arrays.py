"""coupled_arrays: what the card needs to couple the links of every kind."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.errors import GraphicsError
from windswept.gpu.layouts import NONE, ROW
from windswept.gpu.multibody import layouts
from windswept.gpu.springs.kinds import GrownKind
from windswept.gpu.springs.rows import Rows
from windswept.motion import Model
from windswept.motion.multibody.constants import (
    AXIS_1,
    AXIS_2,
    DIRECTION,
    DRAG_LEAF,
    DRAG_WOOD,
    INERTIA,
    LAG,
    LEVER,
    MASS,
    MOMENT,
    REACH,
    STIFFNESS_1,
    STIFFNESS_2,
    forces_at,
    pack_multibody,
    warped_step,
)
from windswept.plants.plant import Ints


@dataclass(frozen=True, slots=True)
class CoupledArrays:
    """Constants of K kinds whose links are coupled, and the memory that they move in."""

    rods: Rows
    """``ROD``, kind after kind."""
    coupled: Rows
    """(K,) ``COUPLED``"""
    carried_rows: int
    """Rows of ``vec4f`` that all kinds together need for carried velocities, records and slots."""
    record_rows: int
    slot_rows: int


def coupled_arrays(kinds: list[GrownKind], rungs: Rows, limit: int) -> CoupledArrays:
    """Brings the multibody constants of kinds into the card's layouts.

    Args:
        kinds: what is simulated, all at its finest level.
        rungs: (K,) ``RUNG`` of their finest levels.
        limit: bytes that a buffer may have.

    Raises:
        GraphicsError: the card has too little room.
    """
    room = rungs["room"][:, 3].astype(np.int64)
    links = rungs["links"][:, 1].astype(np.int64)
    depths = rungs["links"][:, 2].astype(np.int64) + 1
    sizes = room * np.stack([layouts.CARRIED * links, layouts.RECORD * links, layouts.SLOT * depths])
    needed = ROW.itemsize * int(sizes.sum(axis=1).max())
    if needed > limit:
        raise GraphicsError(
            f"coupled links need {needed / 1e6:.2f} MB in one buffer and this adapter takes {limit / 1e6:.2f} MB: "
            "place fewer plants, or simulate on the CPU"
        )
    coupled = np.zeros(len(kinds), layouts.COUPLED)
    for row, kind in zip(coupled, kinds, strict=True):
        step, ahead = warped_step(kind.model), forces_at(kind.model)
        row["pace"] = step, ahead, step / ahead, 0.0
    firsts = np.cumsum(sizes, axis=1) - sizes
    coupled["rows"] = np.column_stack([np.cumsum(links) - links, *firsts])
    carried, records, slots = (int(rows) for rows in sizes.sum(axis=1))
    rods = [np.zeros(0, layouts.ROD), *(rod_rows(kind.model) for kind in kinds)]
    return CoupledArrays(np.concatenate(rods), coupled, carried, records, slots)


def rod_rows(model: Model) -> Rows:
    """(L,) ``ROD`` rows of a plant."""
    c, skeleton = pack_multibody(model), model.skeleton
    rows = np.zeros(model.link_count, layouts.ROD)
    rows["axis_1"] = c[:, [AXIS_1, AXIS_1 + 1, AXIS_1 + 2, STIFFNESS_1]]
    rows["axis_2"] = c[:, [AXIS_2, AXIS_2 + 1, AXIS_2 + 2, STIFFNESS_2]]
    above = c[np.maximum(skeleton.parent, 0), DIRECTION : DIRECTION + 3]
    rows["foot"] = np.column_stack([c[:, REACH, None] * above, c[:, LEVER]])
    rows["leaf_1"] = np.column_stack([c[:, DRAG_LEAF : DRAG_LEAF + 3], c[:, DRAG_WOOD]])
    rows["leaf_2"] = np.column_stack([c[:, DRAG_LEAF + 3 : DRAG_LEAF + 6], c[:, LAG]])
    rows["mass"][:, :3] = c[:, [MASS, MOMENT, INERTIA]]
    parent = np.where(skeleton.parent < 0, NONE, skeleton.parent.astype(np.int64))
    rows["rows"] = np.column_stack([parent, model.link_probe, skeleton.depth, ways(skeleton.parent)])
    return rows


def ways(parent: Ints) -> NDArray[np.int64]:
    """(L,) what the walks do at every link: TIP, FOLLOWS, FORKS and LATER, added up; parents in depth-first order."""
    count = len(parent)
    links = np.arange(count)
    children = np.bincount(parent[parent >= 0], minlength=count)
    last_child = np.full(count, -1)
    inner = np.flatnonzero(parent >= 0)
    last_child[parent[inner]] = inner
    follows = (parent >= 0) & (parent == links - 1)
    later = (parent >= 0) & (last_child[parent] != links)
    return (
        layouts.TIP * (children == 0)
        + layouts.FOLLOWS * follows
        + layouts.FORKS * (children > 1)
        + layouts.LATER * later
    )
