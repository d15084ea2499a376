"""`multibody`: every link a rigid body, all coupled, by the articulated-body algorithm; linear in links."""

from __future__ import annotations

import numpy as np
from numba import get_num_threads, get_thread_id, njit, prange

from windswept.motion.lanes import FAST_MATH, WIDTH
from windswept.motion.level import Level, finest_level
from windswept.motion.model import Model
from windswept.motion.multibody.advance import MOTION, advance
from windswept.motion.multibody.ascend import SUM, ascend
from windswept.motion.multibody.constants import pack_level
from windswept.motion.multibody.descend import RECORD, SLOT, descend
from windswept.motion.multibody.rules import step_rules
from windswept.motion.springs import pack_wind
from windswept.motion.state import CoupledState, State
from windswept.plants.plant import Floats, Ints

_F = np.float32


@njit(fastmath=FAST_MATH, parallel=True, cache=True)
def _step_tiles(  # type: ignore[no-untyped-def]
    c,
    depth,
    probe,
    source,
    crowd,
    group_start,
    joints,
    groups,
    carried,
    wind,
    scratch,
    starts,
    rules,
    first,
    last,
    interval,
):
    """Inner steps first..last of an interval over which the wind goes linearly from wind[t, 0] to wind[t, 1]."""
    slots, sums, motions = np.uintp(starts[0]), np.uintp(starts[1]), np.uintp(starts[2])
    for tile in prange(joints.shape[0]):
        a = scratch[get_thread_id()]
        now = a[a.size - wind.shape[2] :]
        for taken in range(first, last):
            late = _F((taken + 0.5) / interval)
            now[:] = wind[tile, 0] + late * (wind[tile, 1] - wind[tile, 0])
            descend(
                c,
                depth,
                probe,
                crowd,
                group_start,
                joints[tile],
                groups[tile],
                carried[tile],
                now,
                a,
                slots,
                rules,
            )
            ascend(c, depth, source, joints[tile], a, sums, rules)
            advance(c, depth, joints[tile], carried[tile], a, motions, rules)


class MultibodyStepper:
    """Steps states of one plant with all links of a level coupled; owns the scratch memory that the kernel works in.

    Args:
        model: the plant's constants.
        level: what of the plant is stepped; None for every link.
    """

    def __init__(self, model: Model, level: Level | None = None) -> None:
        self.level = finest_level(model) if level is None else level
        self._constants = pack_level(model, self.level)
        self._rules = step_rules(model)
        self._source = sum_sources(self.level)
        self._scratch, self._starts = _scratch(self.level)

    def step(
        self,
        state: State,
        wind_before: Floats,
        wind_after: Floats,
        substeps: int = 1,
        taken: int = 0,
        interval: int | None = None,
    ) -> CoupledState:
        """Advances a state by ``substeps`` inner steps; arguments as in ``springs.Stepper.step``."""
        assert isinstance(state, CoupledState)
        level, tiles = self.level, len(state.joints)
        if tiles == 0:
            state.step_count += substeps
            return state
        wind = np.stack([pack_wind(level, wind_before), pack_wind(level, wind_after)], axis=1)
        _step_tiles(
            self._constants,
            level.depth,
            level.probe,
            self._source,
            (level.group_constants, level.group_probe),
            level.group_start,
            state.joints.reshape(tiles, -1),
            state.groups.reshape(tiles, -1),
            state.carried.reshape(tiles, -1),
            wind,
            self._scratch,
            self._starts,
            self._rules,
            taken,
            taken + substeps,
            float(interval or substeps),
        )
        state.step_count += substeps
        return state


def sum_sources(level: Level) -> Ints:
    """(L, 3) slot that holds the sum of a link's children, slot that its own share is added to, and its parent.

    The last slot stays zero: it is the sum of no children, and what the first child that is reached adds to.
    """
    count, depth = level.link_count, level.depth
    zero = int(depth.max(initial=0)) + 1
    source = np.full((count, 3), zero, np.int32)
    last_child = np.full(count + 1, -1, np.int32)
    last_child[level.parent] = np.arange(count)
    inner = last_child[:count] >= 0
    source[inner, 0] = depth[inner] + 1
    later = last_child[level.parent] != np.arange(count)
    source[later, 1] = depth[later]
    source[:, 2] = np.maximum(level.parent, 0)
    return source


def _scratch(level: Level) -> tuple[Floats, Ints]:
    """Per-thread scratch with the ground's slots at rest, and where slots, sums and motions begin."""
    depths = int(level.depth.max(initial=0)) + 2
    slots = level.link_count * int(RECORD)
    sums = slots + depths * int(SLOT)
    motions = sums + depths * int(SUM)
    size = motions + depths * int(MOTION) + 4 * len(level.probe_position) * WIDTH
    scratch = np.zeros((get_num_threads(), size), np.float32)
    scratch[:, slots + 3 * WIDTH : slots + 4 * WIDTH] = 1.0
    return scratch, np.array([slots, sums, motions], np.int64)
