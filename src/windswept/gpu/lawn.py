"""Lawn: the blades of meadow grass in sight of a camera, found on the card as ``grass_field`` finds them on the CPU."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.gpu import layouts
from windswept.gpu.buffers import STORAGE, UNIFORM, filled, room
from windswept.gpu.frame import Ground
from windswept.gpu.grass_field import RINGS, ring_cells
from windswept.gpu.kernel import Kernel
from windswept.gpu.layouts import COUNTS, REALS

Doubles = NDArray[np.float64]

LAWN_LOOK = np.dtype(
    [
        ("eye", *REALS),
        ("planes", "<f4", (5, 4)),
        ("ground", *REALS),
        ("counts", *COUNTS),
        ("rings", "<f4", (3, 4)),
        ("cells", "<u4", (3, 4)),
    ]
)
"""``LawnLook`` of ``lawn.wgsl``; a test compares them."""
WORKGROUP, BITS = 64, 32


class Lawn:
    """Chooses blades; nothing is read back, and nothing uploaded but where the camera is.

    Args:
        device: the card.
        ground: what they stand on.
    """

    def __init__(self, device: Any, ground: Ground) -> None:
        self._device, self._ground = device, ground
        sides = [2 * ring_cells(*ring) + 1 for ring in RINGS]
        self._firsts = np.cumsum([0, *(side * side for side in sides)])
        self._sides = sides
        self._look = room(device, LAWN_LOOK, 1, UNIFORM)
        self._marks = room(device, layouts.WORD, self._words)
        self.blades = room(device, layouts.GRASS_BLADE, int(self._firsts[-1]))
        """``GRASS_BLADE`` rows of those in sight."""
        self.words = room(device, layouts.WORD, 5, STORAGE | wgpu.BufferUsage.INDIRECT)
        """Arguments of their draw."""
        self.batch = room(device, layouts.BATCH, 1, STORAGE | UNIFORM)
        """``BATCH`` of all of them."""
        resources = {
            "look": self._look,
            "heights": filled(device, np.ascontiguousarray(ground.height, np.float32).ravel()),
            "marks": self._marks,
            "firsts": room(device, layouts.WORD, self._words),
            "blades": self.blades,
            "words": self.words,
            "batch": self.batch,
        }
        self._mark, self._plan, self._sow = (
            Kernel(device, "lawn", entry, resources) for entry in ("mark", "plan_lawn", "sow")
        )

    def record(self, encoder: Any, eye: Doubles, planes: Doubles, timestamps: dict[str, Any]) -> None:
        """Records the choice into a command encoder, which must be submitted before the next call.

        Args:
            encoder: takes it.
            eye: (3,) the camera, m.
            planes: (5, 4) planes of its frustum.
            timestamps: what the pass is begun with.
        """
        self._device.queue.write_buffer(self._look, 0, self._look_row(eye, planes))
        encoder.clear_buffer(self._marks)
        groups = -(-int(self._firsts[-1]) // WORKGROUP)
        compute_pass = encoder.begin_compute_pass(**timestamps)
        self._mark.record(compute_pass, groups)
        self._plan.record(compute_pass, 1)
        self._sow.record(compute_pass, groups)
        compute_pass.end()

    @property
    def _words(self) -> int:
        return -(-int(self._firsts[-1]) // BITS)

    def _look_row(self, eye: Doubles, planes: Doubles) -> NDArray[np.void]:
        """(1,) ``LAWN_LOOK``."""
        row = np.zeros(1, LAWN_LOOK)
        ground = self._ground
        row["eye"][:, :3] = eye
        row["planes"] = planes
        row["ground"][:, :3] = *ground.origin, ground.spacing
        rows, columns = ground.height.shape
        row["counts"] = columns, rows, self._words, self._firsts[-1]
        for k, (spacing, inner, outer) in enumerate(RINGS):
            first = np.floor(eye[:2] / spacing).astype(np.int32) - self._sides[k] // 2
            row["rings"][0, k, :3] = spacing, inner, outer
            row["cells"][0, k] = *first.view(np.uint32), self._sides[k], self._firsts[k]
        return row
