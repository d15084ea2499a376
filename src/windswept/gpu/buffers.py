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
    """Buffer that holds an array; at least one row long, since a binding may not be empty.

    Raises:
        GraphicsError: the device cannot bind so much at once, or has not so much memory.
    """
    if len(rows) == 0:
        rows = np.zeros((1, *rows.shape[1:]), rows.dtype)
    check_size(rows.nbytes, binding_limit(device))
    with card_errors("holding the scene"):
        return device.create_buffer_with_data(data=np.ascontiguousarray(rows), usage=usage)


def room(device: Any, layout: np.dtype[Any], rows: int, usage: int = STORAGE) -> Any:
    """Buffer of zeros for rows of one layout.

    Raises:
        GraphicsError: the device cannot bind so much at once, or has not so much memory.
    """
    check_size(rows * layout.itemsize, binding_limit(device))
    with card_errors("holding the scene"):
        return device.create_buffer(size=max(rows, 1) * layout.itemsize, usage=usage)


def table(rows: NDArray[Any], length: int, things: str) -> NDArray[Any]:
    """Rows, and zeros up to the length that a uniform table has in the shaders.

    Args:
        rows: (n, ...) of the table.
        length: of the table.
        things: what the rows stand for, as in "kinds of plants".

    Raises:
        GraphicsError: there are more rows than that.
    """
    check_count(len(rows), length, things)
    whole = np.zeros((length, *rows.shape[1:]), rows.dtype)
    whole[: len(rows)] = rows
    return whole


def check_count(count: int, most: int, things: str) -> None:
    """Raises GraphicsError where there are more things than a table of the shaders holds."""
    if count > most:
        raise GraphicsError(f"the card holds up to {most} {things}, and there are {count}: use fewer")


def binding_limit(device: Any) -> int:
    """Bytes of a buffer that the device can bind at once."""
    return int(device.limits["max-storage-buffer-binding-size"])


def check_size(size: int, limit: int) -> None:
    """Raises GraphicsError where a buffer of ``size`` bytes is larger than it may be."""
    if size > limit:
        raise GraphicsError(
            f"{size / 1e6:.2f} MB are needed in one buffer, which may have {limit / 1e6:.2f} MB on this card: "
            "place fewer plants"
        )


class GrowingBuffer:
    """Storage for rows of one layout; contents are lost when it grows.

    Args:
        device: the card.
        layout: of a row.
        most: bytes that it may have unless more are insisted on; None for what the device can bind.
    """

    def __init__(self, device: Any, layout: np.dtype[np.void], most: int | None = None) -> None:
        self._device = device
        self.row_bytes = layout.itemsize
        self._limit = binding_limit(device)
        self.most_rows = min(most or self._limit, self._limit) // self.row_bytes
        """How many it should make room for at most."""
        self.buffer: Any = None
        self.reserve(1)

    def reserve(self, rows: int) -> None:
        """Make room for this many rows, with a little to spare.

        Raises:
            GraphicsError: the device cannot bind so much at once, or has not so much memory.
        """
        if self.buffer is None or self.rows < rows:
            check_size(rows * self.row_bytes, self._limit)
            roomy = max(rows, min(max(rows + rows // 4, 64), self.most_rows))
            with card_errors("the parts of a frame"):
                self.buffer = self._device.create_buffer(size=roomy * self.row_bytes, usage=STORAGE)

    @property
    def rows(self) -> int:
        """How many there is room for."""
        return int(self.buffer.size) // self.row_bytes

    def write(self, rows: NDArray[Any], first: int = 0) -> None:
        """Copy rows to the card; there must be room."""
        if len(rows):
            data = np.ascontiguousarray(rows)
            self._device.queue.write_buffer(self.buffer, first * self.row_bytes, data)
