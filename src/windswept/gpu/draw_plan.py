"""DrawPlan: what a frame dispatches and draws, as the card reads it; written from a draw list or by culling/."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.gpu import layouts
from windswept.gpu.buffers import STORAGE, UNIFORM, UNIFORM_STRIDE, GrowingBuffer, room
from windswept.gpu.draw_list import DrawList, ItemRange
from windswept.plants.plant import Ints

POSES, STEMS, PIECES, LEAVES = 0, 3, 6, 9
"""Words of ``plan`` at which workgroups along x, y and z stand, of POSES for 64 placements."""
DRAWS = 12
"""Word at which the arguments of the draws begin, 5 each, in the order of ``MeshRow``."""
TALLY = 96
"""Word at which the card tells how it went, see culling/tally.py."""
WORDS = 112
MOST_GROUPS = 65_535
"""Workgroups along x that every adapter takes."""
SHADOW_LEAF_STEP = 2
"""Of so many leaves one throws a shadow, and one that much larger."""
_BATCH = np.dtype(f"V{UNIFORM_STRIDE}")


class DrawPlan:
    """Placements that are drawn, and the arguments of indirect dispatches and draws.

    Args:
        device: the card.
        meshes: (M, 4) of every draw: indices of one item; items of a batch; of how many items one is drawn; item range
            of the draw list, pieces before leaves. Those of the picture come before those of the shadows.
    """

    def __init__(self, device: Any, meshes: Ints) -> None:
        self._device, self.meshes = device, meshes
        self._rows = GrowingBuffer(device, layouts.PLACEMENT)
        self.words = room(device, layouts.WORD, WORDS, STORAGE | wgpu.BufferUsage.INDIRECT)
        """Arguments of dispatches and draws."""
        self.batches = room(device, _BATCH, len(meshes) + 1, STORAGE | UNIFORM)
        """``BATCH`` of every draw and then ``LISTED``, each at a multiple of UNIFORM_STRIDE bytes."""

    @property
    def placements(self) -> Any:
        """Buffer of ``PLACEMENT`` rows."""
        return self._rows.buffer

    @property
    def listed(self) -> dict[str, Any]:
        """Binding of ``LISTED``."""
        offset = UNIFORM_STRIDE * len(self.meshes)
        return {"buffer": self.batches, "offset": offset, "size": layouts.LISTED.itemsize}

    def reserve(self, placements: int) -> None:
        """Makes room for so many placements."""
        self._rows.reserve(placements)

    def write(self, wanted: DrawList) -> None:
        """Takes a draw list that was made on the CPU."""
        queue = self._device.queue
        self.reserve(len(wanted.placements))
        self._rows.write(wanted.placements)
        batches = batch_rows(wanted, self.meshes)
        queue.write_buffer(self.words, 0, _words(wanted, batches, self.meshes))
        uniforms = np.zeros((len(batches) + 1, UNIFORM_STRIDE), np.uint8)
        uniforms[:-1, : layouts.BATCH.itemsize] = batches.view(np.uint8).reshape(len(batches), -1)
        counts = np.array([len(wanted.placements), *wanted.chunks], np.uint32)
        uniforms[-1, : layouts.LISTED.itemsize] = counts.view(np.uint8)
        queue.write_buffer(self.batches, 0, uniforms)


def batch_rows(wanted: DrawList, meshes: Ints) -> NDArray[np.void]:
    """(M,) ``BATCH`` rows: first item, items and step of every draw, the picture's before the shadows'."""
    ranges = wanted.pieces + wanted.leaves
    rows = np.zeros(len(meshes), layouts.BATCH)
    for slot, (_, _, step, item_range) in enumerate(meshes.tolist()):
        taken = _seen if slot < len(meshes) // 2 else _casting
        rows["items"][slot, :3] = *taken(ranges[item_range], step), step
        rows["scale"][slot, 0] = np.sqrt(step)
    return rows


def _seen(items: ItemRange, step: int) -> tuple[int, int]:
    """First item and number of those in sight."""
    return items.first + items.hidden, (items.total - items.hidden) // step


def _casting(items: ItemRange, step: int) -> tuple[int, int]:
    """First item and number of those that throw a shadow."""
    return items.first, items.casters // step


def _words(wanted: DrawList, batches: NDArray[np.void], meshes: Ints) -> NDArray[np.uint32]:
    """Arguments of all dispatches and draws."""
    words = np.zeros(WORDS, np.uint32)
    for word, chunks in zip((STEMS, PIECES, LEAVES), wanted.chunks, strict=True):
        words[word : word + 3] = min(chunks, MOST_GROUPS), -(-chunks // MOST_GROUPS), 1
    indices, batch = meshes[:, 0], meshes[:, 1]
    items = batches["items"][:, 1].astype(np.int64)
    draws = words[DRAWS : DRAWS + 5 * len(meshes)].reshape(-1, 5)
    draws[:, 0] = indices * np.minimum(batch, items)
    draws[:, 1] = -(-items // batch)
    return words
