"""Buffers on the card that are filled from NumPy arrays and grow when a frame needs more."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.errors import GraphicsError
from windswept.gpu.failures import card_errors

STORAGE = wgpu.BufferUsage.STORAGE | wgpu.BufferUsage.COPY_DST | wgpu.BufferUsage.COPY_SRC
UNIFORM = wgpu.BufferUsage.UNIFORM | wgpu.BufferUsage.COPY_DST
UNIFORM_STRIDE = 256
"""Alignment that every device accepts for dynamic uniform offsets, bytes."""


def filled(device: Any, rows: NDArray[Any], usage: int = STORAGE) -> Any:
    """Buffer that holds an array; at least one row long, since a binding may not be empty."""
    if len(rows) == 0:
        rows = np.zeros((1, *rows.shape[1:]), rows.dtype)
    return device.create_buffer_with_data(data=np.ascontiguousarray(rows), usage=usage)


def room(device: Any, layout: np.dtype[Any], rows: int, usage: int = STORAGE) -> Any:
    """Buffer of zeros for rows of one layout.

    Raises:
        GraphicsError: the device cannot bind so much at once, or has not so much memory.
    """
    check_size(device, rows * layout.itemsize)
    with card_errors("its buffers"):
        return device.create_buffer(size=max(rows, 1) * layout.itemsize, usage=usage)


def check_size(device: Any, size: int) -> None:
    """Raises GraphicsError where a buffer of ``size`` bytes cannot be bound at once."""
    limit = device.limits["max-storage-buffer-binding-size"]
    if size > limit:
        raise GraphicsError(
            f"{size / 1e6:.0f} MB are needed in one buffer and this adapter takes {limit / 1e6:.0f} MB: "
            "place fewer plants"
        )


class GrowingBuffer:
    """Storage for rows of one layout; contents are lost when it grows."""

    def __init__(self, device: Any, layout: np.dtype[np.void]) -> None:
        self._device = device
        self.row_bytes = layout.itemsize
        self.buffer: Any = None
        self.reserve(1)

    def reserve(self, rows: int) -> None:
        """Make room for this many rows, with a little to spare.

        Raises:
            GraphicsError: the device cannot bind so much at once.
        """
        if self.buffer is None or self.buffer.size < rows * self.row_bytes:
            check_size(self._device, rows * self.row_bytes)
            limit = self._device.limits["max-storage-buffer-binding-size"]
            size = min(max(rows + rows // 4, 64) * self.row_bytes, limit // self.row_bytes * self.row_bytes)
            with card_errors("the parts of a frame"):
                self.buffer = self._device.create_buffer(size=size, usage=STORAGE)

    @property
    def rows(self) -> int:
        """How many there is room for."""
        return int(self.buffer.size) // self.row_bytes

    def write(self, rows: NDArray[Any], first: int = 0) -> None:
        """Copy rows to the card; there must be room."""
        if len(rows):
            data = np.ascontiguousarray(rows)
            self._device.queue.write_buffer(self.buffer, first * self.row_bytes, data)
