"""The first pass: the wind bends every branch on the card. See ``shaders/bend.wgsl``."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.gpu.bend import layouts
from windswept.gpu.bend.branch_rows import bend_scale, branch_rows
from windswept.gpu.bend.breeze import breeze
from windswept.gpu.buffers import UNIFORM, UNIFORM_STRIDE, filled
from windswept.gpu.failures import card_errors
from windswept.gpu.stage_times import StageTimes
from windswept.gpu.wiring import (
    COMPUTE,
    DYNAMIC_UNIFORM,
    READ,
    WRITE,
    bind,
    buffers_layout,
    compute_pipeline,
)
from windswept.gpu.wiring import UNIFORM as UNIFORM_BINDING
from windswept.motion.bend_branches import Branches, BranchPose
from windswept.motion.bend_plain import WEIGHTS
from windswept.wind.mean import Profile
from windswept.wind.wind import Wind, calm

WORKGROUP = 64
ROW_OF_GROUPS = 32_768
"""Workgroups along x, at most; every adapter takes as many."""


class Bending:
    """Holds branches at rest and bent on the card.

    Args:
        device: the card.
        branches: what is bent.
        rows: (R, 4) their ``rows`` as ``branch_look_rows`` gives them; None where nobody draws them.
        weights: name of the shares of b that turn the second and the third leg, see ``WEIGHTS``.

    Raises:
        GraphicsError: the card has too little memory, or was lost.
    """

    @card_errors("bending branches")
    def __init__(
        self,
        device: Any,
        branches: Branches,
        rows: NDArray[np.void] | None = None,
        weights: str = "beam",
    ) -> None:
        self._device = device
        self.branches = branches
        self._rest = branch_rows(branches)
        if rows is not None:
            self._rest["rows"] = rows
        self.rest = filled(device, self._rest)
        still = np.zeros(branches.branch_count, layouts.BENT_BRANCH)
        self._bent = [filled(device, still), filled(device, still)]
        self._newest = 0
        self.times = StageTimes(device, ("bend",))
        """How long the passes of the last call took."""
        self._profile: Profile | None = None
        self._breeze = device.create_buffer(size=layouts.BREEZE.itemsize, usage=UNIFORM)
        self._passes = filled(device, _pass_rows(branches, weights), UNIFORM)
        layout = buffers_layout(device, COMPUTE, READ, READ, WRITE, UNIFORM_BINDING, DYNAMIC_UNIFORM)
        self._lagged = compute_pipeline(device, [layout], "bend", "lagged")
        self._ordered = compute_pipeline(device, [layout], "bend", "ordered")
        now = {"buffer": self._passes, "offset": 0, "size": layouts.BEND_PASS.itemsize}
        self._groups = [
            bind(device, layout, self.rest, self._bent[1 - new], self._bent[new], self._breeze, now)
            for new in (0, 1)
        ]
        self.step_ordered(calm(), 0.0)

    @property
    def bent(self) -> Any:
        """Buffer of ``BENT_BRANCH`` rows as they are now."""
        return self._bent[self._newest]

    @property
    def bytes(self) -> int:
        """Memory of all buffers."""
        return sum(buffer.size for buffer in (self.rest, *self._bent, self._breeze, self._passes))

    def step_lagged(self, wind: Wind, time: float, steps: int = 1) -> None:
        """One pass over all branches, each on its parent of the step before; the two buffers swap.

        Args:
            wind: sampled at the tips of the branches at rest.
            time: s.
            steps: how many to take at this time; after as many as there are levels nothing lags behind.

        Raises:
            InputError: more waves or gusts blow at once than the card is given.
            GraphicsError: the card was lost.
        """
        passes = [((self._newest + step) % 2, 0, self.branches.branch_count) for step in range(1, steps + 1)]
        self._submit(self._lagged, passes, wind, time)
        self._newest = (self._newest + steps) % 2

    def step_ordered(self, wind: Wind, time: float, steps: int = 1) -> None:
        """One dispatch a level, each branch on its parent as it is now. Arguments as ``step_lagged``."""
        levels = enumerate(np.diff(self.branches.level_start).tolist(), start=1)
        self._submit(self._ordered, steps * [(self._newest, *level) for level in levels], wind, time)

    @card_errors("bending branches")
    def wait(self) -> None:
        """Returns when the card has done everything that it was told."""
        self._device.queue.read_buffer(self.bent, 0, layouts.BENT_BRANCH.itemsize)

    @card_errors("bending branches")
    def pose(self) -> BranchPose:
        """Read the branches back; waits until they are bent."""
        data = self._device.queue.read_buffer(self.bent)
        # A buffer has a row even where there is no branch.
        rows = np.frombuffer(data, np.float32).reshape(-1, 4, 4)[: self.branches.branch_count]
        return BranchPose(rows[:, :, :3].copy(), rows[:, :3, 3].copy())

    @card_errors("bending branches")
    def _submit(self, pipeline: Any, passes: list[tuple[int, int, int]], wind: Wind, time: float) -> None:
        """Run passes one after the other: each writes one of the two buffers and has a slot of ``_passes`` and a
        number of branches.
        """
        if len(self._rest) and wind.profile != self._profile:
            self._rest["side"][:, 3] = bend_scale(self.branches, wind.profile)
            self._device.queue.write_buffer(self.rest, 0, self._rest)
            self._profile = wind.profile
        self._device.queue.write_buffer(self._breeze, 0, breeze(wind, time))
        encoder = self._device.create_command_encoder()
        compute_pass = encoder.begin_compute_pass(**self.times.around("bend"))
        compute_pass.set_pipeline(pipeline)
        for new, slot, count in passes:
            groups = -(-count // WORKGROUP)
            compute_pass.set_bind_group(0, self._groups[new], [slot * UNIFORM_STRIDE])
            compute_pass.dispatch_workgroups(min(groups, ROW_OF_GROUPS), -(-groups // ROW_OF_GROUPS))
        compute_pass.end()
        self._device.queue.submit([encoder.finish()])


def _pass_rows(branches: Branches, weights: str) -> NDArray[np.uint8]:
    """(1 + D, UNIFORM_STRIDE) ``BEND_PASS`` of all branches at once and then of every level."""
    ranges = [(0, branches.branch_count), *pairwise(branches.level_start.tolist())]
    second, third = WEIGHTS[weights]
    rows = np.zeros((len(ranges), UNIFORM_STRIDE), np.uint8)
    for row, (first, end) in zip(rows, ranges, strict=True):
        one = np.zeros(1, layouts.BEND_PASS)
        one["rows"] = first, end, 0, 0
        one["weights"] = second, third - second, 0.0, 0.0
        row[: layouts.BEND_PASS.itemsize] = one.view(np.uint8)
    return rows
