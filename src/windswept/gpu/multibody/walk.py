"""CoupledWalk: the kernels of springs/, but that all links of a block are stepped together."""

from __future__ import annotations

from windswept.gpu.springs.walk import Walk


class CoupledWalk(Walk):
    """Records what the card is to do; made as a ``Walk`` over resources that `multibody` has been added to."""

    steppers = (("multibody", "descend_block"), ("multibody", "ascend_block"), ("multibody", "advance_block"))
