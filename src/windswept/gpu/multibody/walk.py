"""CoupledWalk: the kernels of springs/, and those that step the links of a block together."""

from __future__ import annotations

from windswept.gpu.kernel import Kernel
from windswept.gpu.springs.card_state import JOIN, SHIFT
from windswept.gpu.springs.turns import check_walked_whole
from windswept.gpu.springs.walk import Walk

TURNS_PER_LINK = 2
"""Turns of the loops of ``multibody_descend.wgsl`` for a link, see turns.py: its own, its groups'."""


class CoupledWalk(Walk):
    """Records what the card is to do; made as a ``Walk`` over resources that `multibody` has been added to."""

    def _new_steppers(self) -> list[Kernel]:
        """Kernels that step a block, those of `springs` first.

        Raises:
            GraphicsError: a plant is too large for a software driver.
        """
        arrays, resources = self._card.arrays, self._card.resources
        check_walked_whole(self._device, arrays.rungs[arrays.coupled], TURNS_PER_LINK)
        entries = ("descend_block", "ascend_block", "advance_block")
        coupled = [Kernel(self._device, "multibody", entry, resources) for entry in entries]
        return coupled if arrays.coupled.all() else super()._new_steppers() + coupled

    def _new_movers(self) -> list[tuple[Kernel, int]]:
        """Kernels that take along what moves with placements that change slot or level, and what dispatches each."""
        shift, join = (
            Kernel(self._device, "multibody_change", entry, self._card.resources)
            for entry in ("shift_carried", "join_carried")
        )
        return [*super()._new_movers(), (shift, SHIFT), (join, JOIN)]
