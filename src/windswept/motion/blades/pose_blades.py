"""pose_blades: from leans to where every section of every blade is."""

from __future__ import annotations

import numpy as np
from numba import njit, prange

from windswept.motion.blades.blades import AXIS, NORMAL, Blades, BladeState, from_tiles
from windswept.motion.blades.pose_table import PoseTable, look_up
from windswept.motion.blades.step_plain import rest_lean
from windswept.plants.plant import Floats
from windswept.plants.underbrush.blade_pose import BladePose


def pose_blades(
    blades: Blades,
    state: BladeState | None = None,
    parents: BladePose | None = None,
    ahead: float = 0.0,
    tables: tuple[PoseTable, PoseTable] | None = None,
) -> BladePose:
    """Pose of blades of one kind.

    Args:
        blades: what stands where.
        state: their motion; None for rest.
        parents: pose of the blades that carry them; None where they stand on the ground.
        ahead: seconds since the last step; leans go on at their rate, so that motion is smooth at any frame rate.
        tables: poses while whole and once broken, with fewer sections (`simplify_table`); None for the kind's own.
    """
    base, frame = carried(blades, parents)
    whole, broken_table = tables or (blades.kind.table, blades.kind.broken_table)
    broken = np.zeros(blades.count, np.bool_) if state is None else state.broken
    lean = rest_lean(blades.kind, rest_frame(blades), broken)
    if state is not None:
        lean += state.lean + np.float32(ahead) * state.rate
    count = whole.section_count
    joint = np.empty((blades.count, count + 1, 3), np.float32)
    frames = np.empty((blades.count, count, 3, 3), np.float32)
    for table, chosen in ((whole, ~broken), (broken_table, broken)):
        index = np.flatnonzero(chosen)
        _pose(table.turns, table.length, index, lean, blades.size, base, frame, joint, frames)
    return BladePose(joint, frames)


def rest_frame(blades: Blades) -> Floats:
    """(B, 3, 3) base frames in the scene while nothing moves, as they were packed."""
    rows = from_tiles(blades.constants)[: blades.count]
    axis, normal = rows[:, AXIS : AXIS + 3], rows[:, NORMAL : NORMAL + 3]
    return np.stack([axis, normal, np.cross(axis, normal)], axis=1)


def carried(blades: Blades, parents: BladePose | None) -> tuple[Floats, Floats]:
    """Roots (B, 3) and base frames (B, 3, 3) in the scene of blades that stand on the ground or on their parents."""
    if parents is None:
        return blades.base, blades.frame
    count = parents.frame.shape[1]
    along = np.clip(blades.attach, 0.0, 1.0) * count
    section = np.minimum(along.astype(int), count - 1)
    below, above = parents.joint[blades.parent, section], parents.joint[blades.parent, section + 1]
    base = below + (along - section)[:, None] * (above - below)
    frame = np.einsum("bij,bjk->bik", blades.frame, parents.frame[blades.parent, section])
    return base.astype(np.float32), frame.astype(np.float32)


@njit(parallel=True, cache=True)
def _pose(table, length, index, lean, size, base, frame, joint, frames):  # type: ignore[no-untyped-def]
    for i in prange(len(index)):
        b = index[i]
        _pose_one(table, length, lean[b], size[b], base[b], frame[b], joint[b], frames[b])


@njit(cache=True)
def _pose_one(table, length, lean, size, base, frame, joint, frames):  # type: ignore[no-untyped-def]
    """Writes joints (K + 1, 3) and frames (K, 3, 3) of one blade."""
    turns, f = np.empty((len(length), 2), np.float32), np.empty((3, 3), np.float32)
    look_up(table, lean, turns)
    for a in range(3):
        joint[0, a] = base[a]
        f[0, a], f[1, a], f[2, a] = frame[0, a], frame[1, a], frame[2, a]
    for section in range(len(length)):
        flat_cosine, flat_sine = np.cos(turns[section, 0]), np.sin(turns[section, 0])
        side_cosine, side_sine = np.cos(turns[section, 1]), np.sin(turns[section, 1])
        for a in range(3):
            bent = f[0, a] * flat_cosine + f[1, a] * flat_sine
            f[1, a] = f[1, a] * flat_cosine - f[0, a] * flat_sine
            f[0, a] = bent * side_cosine + f[2, a] * side_sine
            f[2, a] = f[2, a] * side_cosine - bent * side_sine
            joint[section + 1, a] = joint[section, a] + size * length[section] * f[0, a]
            for k in range(3):
                frames[section, k, a] = f[k, a]
