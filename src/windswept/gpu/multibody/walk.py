"""CoupledWalk: the kernels of springs/, and those that step the links of a block together."""

from __future__ import annotations

import numpy as np

from windswept.gpu.kernel import Kernel
from windswept.gpu.springs.card_state import JOIN, SHIFT
from windswept.gpu.springs.turns import check_walked_whole
from windswept.gpu.springs.walk import Walk

LADEN_TURNS = 2
"""Turns of the loops of ``multibody_descend.wgsl`` for a link, see turns.py: its own, its groups'."""


class CoupledWalk(Walk):
    """Records what the card is to do; made as a ``Walk`` over resources that `multibody` has been added to."""

    def _new_steppers(self) -> list[Kernel]:
        """Kernels that step a block, one after the other: those of `springs`, if it moves any rung, then ours.

        Raises:
            GraphicsError: a plant is too large for a software driver.
        """
        arrays, resources = self._card.arrays, self._card.resources
        rungs = arrays.rungs[arrays.coupled]
        laden = rungs["groups"][:, 1] > 0
        check_walked_whole(self._device, rungs[laden], LADEN_TURNS)
        out = [
            Kernel(self._device, "multibody", "descend_block", resources, {"LADEN": float(groups)})
            for groups in np.unique(laden)
        ]
        back = [
            Kernel(self._device, "multibody", entry, resources) for entry in ("ascend_block", "advance_block")
        ]
        coupled = out + back
        return coupled if arrays.coupled.all() else super()._new_steppers() + coupled

    def _new_movers(self) -> list[tuple[Kernel, int]]:
        """Kernels that take along what moves with placements that change slot or level, and what dispatches each."""
        resources = self._card.resources
        shift = Kernel(self._device, "multibody_change", "shift_carried", resources)
        join = Kernel(self._device, "multibody_change", "join_carried", resources)
        return [*super()._new_movers(), (shift, SHIFT), (join, JOIN)]
