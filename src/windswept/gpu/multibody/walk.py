"""CoupledWalk: the kernels of springs/, but that all links of a block are stepped together."""

from __future__ import annotations

from windswept.gpu.kernel import Kernel
from windswept.gpu.springs.walk import Walk


class CoupledWalk(Walk):
    """Records what the card is to do; made as a ``Walk`` over resources that `multibody` has been added to."""

    def _new_steppers(self) -> list[Kernel]:
        """Kernels that step a block, one after the other."""
        entries = ("descend_block", "ascend_block", "advance_block")
        return [Kernel(self._device, "multibody", entry, self._card.resources) for entry in entries]
