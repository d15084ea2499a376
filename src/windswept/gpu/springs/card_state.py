"""CardState: everything that a simulation keeps on the card, by the names that the shaders give it."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.gpu import layouts
from windswept.gpu.buffers import STORAGE, UNIFORM, GrowingBuffer, filled, room, table
from windswept.gpu.failures import card_errors
from windswept.gpu.springs.air import AirRows
from windswept.gpu.springs.rung_arrays import RungArrays
from windswept.gpu.springs.seats import Seats
from windswept.plants.plant import Floats

STEP, WIND, SHIFT, JOIN, JOIN_GROUPS = 0, 3, 6, 9, 12
"""Rows of ``dispatches``, as in ``plan.wgsl``."""
PROBE_CREWS = 8
"""Workgroups that share the probes of a block: most plants of a forest are at levels that have one or two."""
INDIRECT = STORAGE | wgpu.BufferUsage.INDIRECT


class CardState:
    """Buffers of a simulation; what a step reads and what it writes.

    Args:
        device: the card.
        arrays: constants of all levels.
        seats: where the placements begin, at rest.
        heights: (G, G) of the terrain, m.

    Raises:
        GraphicsError: the card has too little memory.
    """

    def __init__(self, device: Any, arrays: RungArrays, seats: Seats, heights: Floats) -> None:
        self._device, self.arrays = device, arrays
        self._waves, self._gusts = GrowingBuffer(device, layouts.WAVE), GrowingBuffer(device, layouts.GUST)
        placements, rungs = len(arrays.rooted), len(arrays.rungs)
        self.resources: dict[str, Any] = {
            "kinds": filled(device, table(arrays.kinds, layouts.KIND_LIMIT, "kinds of plants"), UNIFORM),
            "rungs": filled(device, table(arrays.rungs, layouts.RUNG_LIMIT, "simulation levels"), UNIFORM),
            "links": filled(device, arrays.links),
            "groups": filled(device, arrays.groups),
            "modes": filled(device, arrays.modes),
            "probes": filled(device, arrays.probes),
            "listeners": filled(device, arrays.listeners),
            "shapes": filled(device, arrays.shapes),
            "rooted": filled(device, arrays.rooted),
            "motions": filled(device, seats.motions),
            "members": filled(device, seats.members),
            "populations": filled(device, seats.populations),
            "wishes": room(device, layouts.WORD, rungs),
            "blocks": room(device, layouts.ROW, 1 + rungs + arrays.member_rows // layouts.LANES),
            "shifts": room(device, layouts.SHIFT, 2 * placements),
            "joins": room(device, layouts.WORD, placements),
            "tally": room(device, layouts.WORD, 4, STORAGE | UNIFORM),
            "dispatches": filled(device, self._dispatches(), INDIRECT),
            "state": room(device, layouts.ROW, arrays.state_rows),
            "stack": room(device, layouts.ROW, arrays.stack_rows),
            "wind": room(device, layouts.ROW, arrays.wind_rows),
            "speeds": room(device, np.dtype("<f4"), placements),
            "notes": room(device, layouts.LINK_POSE, arrays.joins_together * arrays.longest),
            "moment": room(device, layouts.MOMENT, 1, UNIFORM),
            "ends": room(device, layouts.AIR, 2, UNIFORM),
            "waves": self._waves.buffer,
            "gusts": self._gusts.buffer,
            "terrain": _heights_texture(device, heights).create_view(),
        }

    def _dispatches(self) -> NDArray[np.uint32]:
        """Workgroups along x, y and z of everything that the card itself dispatches; x is up to the card."""
        rungs = self.arrays.rungs
        rows = np.ones((5, 3), np.uint32)
        rows[:, 0] = 0
        rows[WIND // 3, 1:] = min(rungs["probes"][:, 1].max(initial=0), PROBE_CREWS), 2
        rows[JOIN_GROUPS // 3, 1] = rungs["groups"][:, 1].max(initial=1)
        return rows.ravel()

    @property
    def bytes(self) -> int:
        """Memory of all buffers."""
        return sum(item.size for item in self.resources.values() if isinstance(item, wgpu.GPUBuffer))

    def write_moment(self, moment: NDArray[np.void]) -> None:
        """Tells the card who looks and what is due."""
        self._device.queue.write_buffer(self.resources["moment"], 0, moment)

    def write_air(self, air: AirRows) -> bool:
        """Tells the card of the wind; True where buffers had to grow and must be bound anew."""
        self._device.queue.write_buffer(self.resources["ends"], 0, air.ends)
        for rows, store in ((air.waves, self._waves), (air.gusts, self._gusts)):
            store.reserve(len(rows))
            store.write(rows)
        before = self.resources["waves"], self.resources["gusts"]
        after = self._waves.buffer, self._gusts.buffer
        self.resources["waves"], self.resources["gusts"] = after
        return before != after

    @card_errors("reading motion back")
    def read(self, name: str, layout: np.dtype[Any] | str, first: int = 0, count: int | None = None) -> Any:
        """Rows of a buffer, read back; waits for the card, so not for every frame.

        Raises:
            GraphicsError: the card was lost.
        """
        row = np.dtype(layout).itemsize
        buffer = self.resources[name]
        size = buffer.size - first * row if count is None else count * row
        return np.frombuffer(self._device.queue.read_buffer(buffer, first * row, size), layout).copy()


def _heights_texture(device: Any, heights: Floats) -> Any:
    """Heights of the terrain as texels."""
    rows, columns = heights.shape
    texture = device.create_texture(
        size=(columns, rows, 1),
        format="r32float",
        usage=wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST,
    )
    device.queue.write_texture(
        {"texture": texture},
        np.ascontiguousarray(heights, np.float32),
        {"bytes_per_row": 4 * columns, "rows_per_image": rows},
        (columns, rows, 1),
    )
    return texture
