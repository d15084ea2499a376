"""CardField: what a force field adds to the wind, where the probes of plants read it on the card."""

from __future__ import annotations

from typing import Any

import numpy as np

from windswept.gpu.blades.layouts import AIR_GRID
from windswept.gpu.buffers import UNIFORM, room
from windswept.gpu.layouts import ROW
from windswept.plants.plant import Floats
from windswept.wind.field import Field


class CardField:
    """The field at both ends of an interval of the wind; where there is none, a grid without nodes.

    Args:
        device: the card.
        field: as it is when the first interval begins; None for none.

    Raises:
        GraphicsError: the card has too little memory.
    """

    def __init__(self, device: Any, field: Field | None) -> None:
        self._device = device
        self._count = 0 if field is None else field.velocity[..., 0].size
        self._end = 1
        self.resources: dict[str, Any] = {
            "field_nodes": room(device, ROW, 2 * self._count),
            "field_grids": room(device, AIR_GRID, 2, UNIFORM),
        }
        """By the names that ``wind.wgsl`` gives them."""
        if field is not None:
            self._write(field)

    def advance(self, field: Field) -> None:
        """Takes the field as it is at the end of the next interval; at its beginning it is as it was."""
        self._end = 1 - self._end
        self._write(field)
        grid = field.plan.grid
        rows = np.zeros(2, AIR_GRID)
        rows["nodes"][:, :3] = grid.shape
        rows["nodes"][:, 3] = (1 - self._end) * self._count, self._end * self._count
        rows["origin"][:, :2] = grid.origin
        rows["per_metre"][:, :3] = 1.0 / np.array(grid.cell)
        self._device.queue.write_buffer(self.resources["field_grids"], 0, rows)

    def _write(self, field: Field) -> None:
        """Sends the nodes of the end."""
        first = self._end * self._count * ROW.itemsize
        self._device.queue.write_buffer(self.resources["field_nodes"], first, added_at_nodes(field))


def added_at_nodes(field: Field) -> Floats:
    """(N, 4) what a field adds to its wind at every node, m/s; 0."""
    wind = field.ambient[:, :, None, :] * field.profile[:, None]
    added = np.zeros((*field.velocity.shape[:3], 4), np.float32)
    np.subtract(field.velocity, wind, out=added[..., :3])
    return added.reshape(-1, 4)
