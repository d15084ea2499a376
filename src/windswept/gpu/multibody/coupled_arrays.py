"""coupled_arrays: what the card needs to couple the links of a level."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.gpu.layouts import NONE
from windswept.gpu.multibody import layouts
from windswept.gpu.springs.kinds import GrownKind
from windswept.gpu.springs.room import block_size
from windswept.gpu.springs.rows import Rows
from windswept.gpu.springs.rung_arrays import RungArrays
from windswept.motion import Level, Model
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
    pack_level,
    warped_step,
)
from windswept.plants.plant import Ints


@dataclass(frozen=True, slots=True)
class CoupledArrays:
    """Constants of the rungs whose links are coupled, of R in all, and the memory that they move in."""

    rods: Rows
    """``ROD``, rung after rung."""
    coupled: Rows
    """(R,) ``COUPLED``; zeros where links are not."""
    carried_rows: int
    """Rows of ``vec4f`` that all rungs together need for carried velocities, records and slots."""
    record_rows: int
    slot_rows: int


def coupled_arrays(kinds: list[GrownKind], arrays: RungArrays) -> CoupledArrays:
    """Brings the multibody constants of kinds into the card's layouts.

    Args:
        kinds: what is simulated.
        arrays: their levels on the card.
    """
    models = [kinds[kind].model for kind in arrays.rungs["links"][:, 3]]
    size, room = block_size(list(arrays.levels)), arrays.rungs["room"][:, 3].astype(np.int64)
    rods, coupled = [np.zeros(0, layouts.ROD)], np.zeros(len(models), layouts.COUPLED)
    for row, model, level in zip(coupled, models, arrays.levels, strict=True):
        if level.coupled:
            step, ahead = warped_step(model), forces_at(model)
            row["pace"] = step, ahead, step / ahead, 0.0
            row["rows"][0] = sum(map(len, rods))
            rods.append(rod_rows(model, level))
    sizes = room * np.stack([size.carried, size.records, size.slots])
    coupled["rows"][:, 1:] = ((np.cumsum(sizes, axis=1) - sizes) * arrays.coupled).T
    return CoupledArrays(np.concatenate(rods), coupled, *(int(rows) for rows in sizes.sum(axis=1)))


def rod_rows(model: Model, level: Level) -> Rows:
    """(A,) ``ROD`` rows of the active links of a level of a plant."""
    c, up = pack_level(model, level), level.parent
    rows = np.zeros(level.link_count, layouts.ROD)
    rows["axis_1"] = c[:, [AXIS_1, AXIS_1 + 1, AXIS_1 + 2, STIFFNESS_1]]
    rows["axis_2"] = c[:, [AXIS_2, AXIS_2 + 1, AXIS_2 + 2, STIFFNESS_2]]
    above = c[np.maximum(up, 0), DIRECTION : DIRECTION + 3]
    rows["foot"] = np.column_stack([c[:, REACH, None] * above, c[:, LEVER]])
    rows["leaf_1"] = np.column_stack([c[:, DRAG_LEAF : DRAG_LEAF + 3], c[:, DRAG_WOOD]])
    rows["leaf_2"] = np.column_stack([c[:, DRAG_LEAF + 3 : DRAG_LEAF + 6], c[:, LAG]])
    rows["mass"] = np.column_stack([c[:, [MASS, MOMENT, INERTIA]], level.group_start[2:]])
    parent = np.where(up < 0, NONE, up.astype(np.int64))
    rows["rows"] = np.column_stack([parent, level.probe, level.depth, ways(up)])
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
