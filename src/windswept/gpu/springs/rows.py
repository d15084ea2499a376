"""Levels as the card holds them: links, groups, listeners and shapes in the layouts of ``motion.wgsl``."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from windswept.gpu import layouts
from windswept.motion import Level, Model
from windswept.motion.level import (
    CENTRE,
    COUPLE,
    FORCE_LEAF,
    FORCE_WOOD,
    GROUP_MOBILITY,
    GROUP_STEP,
    LEAF_FACTOR,
    SWAY,
    WOOD_FACTOR,
)
from windswept.motion.model import (
    ATTACH,
    AXIS_1,
    AXIS_2,
    COMPLIANCE_1,
    COMPLIANCE_2,
    DRAG_CENTRE,
    DRAG_LEAF,
    DRAG_WOOD,
    HALF_STEP,
    INVERSE_SQUARE,
    MOBILITY,
    OFFSET,
    PROPAGATION,
    STEP_XX,
    TENSION,
    VECTOR,
)
from windswept.plants.plant import Ints

Rows = NDArray[np.void]


def link_rows(level: Level) -> Rows:
    """(A,) ``LINK`` rows of the active links of a level."""
    c, parent = level.constants, level.parent
    carried = c[:, ATTACH, None] * c[np.maximum(parent, 0), VECTOR : VECTOR + 3]
    foot = np.where(parent[:, None] < 0, c[:, OFFSET : OFFSET + 3], carried)
    rows = np.zeros(level.link_count, layouts.LINK)
    rows["axis_1"] = _with(c[:, AXIS_1 : AXIS_1 + 3], c[:, COMPLIANCE_1])
    rows["axis_2"] = _with(c[:, AXIS_2 : AXIS_2 + 3], c[:, COMPLIANCE_2])
    rows["foot"] = _with(foot, c[:, DRAG_CENTRE])
    rows["vector"] = _with(c[:, VECTOR : VECTOR + 3], c[:, INVERSE_SQUARE])
    rows["leaf_1"] = _with(c[:, DRAG_LEAF : DRAG_LEAF + 3], c[:, MOBILITY])
    rows["leaf_2"] = _with(c[:, DRAG_LEAF + 3 : DRAG_LEAF + 6], c[:, DRAG_WOOD])
    rows["swing"] = c[:, STEP_XX : STEP_XX + 4]
    rows["more"] = np.stack([c[:, PROPAGATION], c[:, TENSION], c[:, HALF_STEP], level.depth], axis=1)
    ends = links_that_end(level.depth)
    rows["rows"] = np.stack([_or_none(parent), level.probe, level.group_start[2:], ends], axis=1)
    return rows


def links_that_end(depth: Ints) -> Ints:
    """(A,) number of links whose last descendant each link is, itself included, from depths in depth-first order."""
    following = np.append(depth[1:], 0)
    return np.maximum(depth - following + 1, 0).astype(np.int32)


def group_rows(level: Level) -> Rows:
    """(G,) ``GROUP`` rows of a level."""
    g = level.group_constants
    rows = np.zeros(level.group_count, layouts.GROUP)
    rows["centre"] = _with(g[:, CENTRE : CENTRE + 3], g[:, LEAF_FACTOR])
    rows["leaf_1"] = _with(g[:, FORCE_LEAF : FORCE_LEAF + 3], g[:, WOOD_FACTOR])
    rows["leaf_2"] = _with(g[:, FORCE_LEAF + 3 : FORCE_LEAF + 6], g[:, GROUP_MOBILITY])
    rows["wood_1"][:, :3] = g[:, FORCE_WOOD : FORCE_WOOD + 3]
    rows["wood_2"][:, :3] = g[:, FORCE_WOOD + 3 : FORCE_WOOD + 6]
    for axis, name in enumerate("xyz"):
        rows[f"couple_{name}"][:, :3] = g[:, COUPLE + 3 * axis : COUPLE + 3 * axis + 3]
        rows[f"sway_{name}"][:, :3] = g[:, SWAY + 3 * axis : SWAY + 3 * axis + 3]
    rows["swing"] = g[:, GROUP_STEP : GROUP_STEP + 4]
    rows["rows"] = np.stack(
        [level.group_probe, level.group_first, level.group_stop - level.group_first, 0 * level.group_first],
        axis=1,
    )
    return rows


def listener_rows(level: Level) -> NDArray[np.uint32]:
    """(L, 4) what turns every joint of the plant at a level: active link, group, link that carries the group; 0."""
    listens = level.listens.astype(np.int64)
    own = listens >= 0
    rows = np.full((len(listens), 4), layouts.NONE, np.uint32)
    rows[own, 0] = listens[own]
    rows[~own, 1] = group = -1 - listens[~own]
    rows[~own, 2] = _or_none(level.group_carrier)[group]
    rows[:, 3] = 0
    return rows


def shape_rows(level: Level, model: Model) -> Rows:
    """(L,) ``SHAPE`` rows of all joints of a plant, from any level that has groups."""
    rows = np.zeros(model.link_count, layouts.SHAPE)
    stiffness = 1.0 / model.rods.compliance
    for axis, name in enumerate(("1", "2")):
        shape = level.shapes[:, axis]
        rows[f"linear_{name}"] = _with(shape[:, :3], stiffness[:, axis])
        rows[f"square_{name}"][:, :3] = shape[:, 3:6]
        rows[f"mixed_{name}"][:, :3] = shape[:, 6:]
    return rows


def _with(vectors: NDArray[Any], last: NDArray[Any]) -> NDArray[Any]:
    """(n, 4) three columns and one more."""
    return np.column_stack([vectors, last])


def _or_none(index: ArrayLike) -> NDArray[np.int64]:
    """Row numbers with -1 as NONE."""
    rows = np.asarray(index, np.int64)
    return np.where(rows < 0, layouts.NONE, rows)
