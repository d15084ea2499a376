"""Holds the blades of a meadow on the card, poses those in sight and draws them."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu

from windswept.gpu import layouts
from windswept.gpu.buffers import UNIFORM, UNIFORM_STRIDE, GrowingBuffer, filled, room
from windswept.gpu.frame import Ground, MeadowMotion
from windswept.gpu.meadow.blade_list import BladeList, BladeRules, Sharpness, blade_list
from windswept.gpu.meadow.layouts import MEADOW_PASS, POSED_JOINT
from windswept.gpu.meadow.meadow_rows import MeadowRows, meadow_rows
from windswept.gpu.wiring import (
    COMPUTE,
    DRAWING,
    DYNAMIC_UNIFORM,
    READ,
    WRITE,
    bind,
    buffers_layout,
    colour_pipeline,
    compute_pipeline,
)
from windswept.motion.blades.pose_table import LAST_NORM
from windswept.plants.plant import Ints
from windswept.scene.meadow_bed import Bed

BATCH = 64
"""Of ``blades.wgsl``."""
WORKGROUP, ROW = 64, 65536
"""Threads of a workgroup, and of a row of workgroups, of ``blades_pose.wgsl``."""
MOST_DEPTH = 8
"""Blades that hang on one another; a species file has at most 16 components."""
MOST_DRAWS = 16
_LEAN = np.dtype("<f4")


class MeadowDrawing:
    """Buffers and pipelines of a meadow.

    Args:
        device: the card.
        beds: the blades of the scene.
        ground: they stand on.
        rules: what may be spent.
        frame_layout: layout of bind group 0.
        light_layout: layout of bind group 2.
        picture: colour format and samples of a pixel.
    """

    def __init__(
        self,
        device: Any,
        beds: tuple[Bed, ...],
        ground: Ground,
        rules: BladeRules,
        frame_layout: Any,
        light_layout: Any,
        picture: tuple[str, int],
    ) -> None:
        self._device, self._rules = device, rules
        self.rows: MeadowRows = meadow_rows(beds, ground)
        self._pose_layout = buffers_layout(device, COMPUTE, *[READ] * 6, WRITE, DYNAMIC_UNIFORM)
        self._draw_layout = buffers_layout(device, DRAWING, READ, DYNAMIC_UNIFORM)
        constants = {"LAST_NORM": LAST_NORM}
        self._pose = compute_pipeline(
            device, [frame_layout, self._pose_layout, light_layout], "blades_pose", "pose", constants
        )
        self._draw = colour_pipeline(device, [frame_layout, self._draw_layout], "blades", *picture)
        self._blades = filled(device, self.rows.blades)
        self._tables = filled(device, self.rows.tables)
        self._runs = filled(device, self.rows.runs)
        self._borders = filled(device, self.rows.borders)
        self._leans = room(device, _LEAN, sum(self.rows.state_sizes))
        self._items = GrowingBuffer(device, np.dtype(layouts.COUNTS))
        self._posed = GrowingBuffer(device, POSED_JOINT)
        self._passes = device.create_buffer(size=UNIFORM_STRIDE * (MOST_DEPTH + MOST_DRAWS), usage=UNIFORM)
        self._strips = {
            sections: filled(device, strip_triangles(sections), wgpu.BufferUsage.INDEX)
            for sections in np.unique(self.rows.sections).tolist()
        }
        self._wanted: BladeList | None = None
        self._seen_from: Sharpness | None = None

    @property
    def drawn_count(self) -> int:
        """Blades that the last frame drew."""
        return 0 if self._wanted is None else len(self._wanted.items)

    def upload(self, motion: MeadowMotion, sharpness: Sharpness) -> None:
        """Choose what is drawn and send how it leans.

        Args:
            motion: leans of all sets that move.
            sharpness: who looks.
        """
        before = self._seen_from
        if before is None or (
            before.pixels != sharpness.pixels or not np.array_equal(before.planes, sharpness.planes)
        ):
            self._wanted, self._seen_from = blade_list(self.rows, sharpness, self._rules), sharpness
            self._items.reserve(len(self._wanted.items))
            self._items.write(self._wanted.items)
            self._posed.reserve(self._wanted.joint_count)
        assert self._wanted is not None
        self._write_passes(self._wanted, motion.ahead, sharpness.pixels)
        first = 0
        for lanes, size in zip(motion.lanes, self.rows.state_sizes, strict=True):
            self._device.queue.write_buffer(self._leans, 4 * first, lanes)
            first += size

    def _write_passes(self, wanted: BladeList, ahead: float, pixels: float) -> None:
        """One row for each dispatch, then one for each draw."""
        now = ahead, pixels, self._rules.width_pixels, self._rules.reach
        firsts = np.cumsum([0, *wanted.depth_counts])
        rows = np.zeros((MOST_DEPTH + MOST_DRAWS, UNIFORM_STRIDE), np.uint8)
        items = [
            (slot, first, n, 0)
            for slot, (first, n) in enumerate(zip(firsts, wanted.depth_counts, strict=False))
        ]
        items += [
            (MOST_DEPTH + slot, first, count, 2 * (sections + 1))
            for slot, (first, count, sections) in enumerate(wanted.draws)
        ]
        for slot, first, count, vertices in items:
            row = np.zeros(1, MEADOW_PASS)
            row["items"], row["now"] = (first, count, vertices, 0), now
            rows[slot, : MEADOW_PASS.itemsize] = row.view(np.uint8)
        self._device.queue.write_buffer(self._passes, 0, rows)

    def encode(self, compute_pass: Any) -> None:
        """Record the dispatches that pose what is drawn, parents first; bind groups 0 and 2 are set."""
        if self._wanted is None or not len(self._wanted.items):
            return
        group = bind(
            self._device,
            self._pose_layout,
            self._blades,
            self._items.buffer,
            self._leans,
            self._tables,
            self._runs,
            self._borders,
            self._posed.buffer,
            self._pass_binding(),
        )
        compute_pass.set_pipeline(self._pose)
        for slot, count in enumerate(self._wanted.depth_counts):
            compute_pass.set_bind_group(1, group, [slot * UNIFORM_STRIDE])
            compute_pass.dispatch_workgroups(-(-min(count, ROW) // WORKGROUP), -(-count // ROW))

    def draw(self, render_pass: Any) -> None:
        """Record the draws into the picture; bind group 0 is set."""
        if self._wanted is None:
            return
        group = bind(self._device, self._draw_layout, self._posed.buffer, self._pass_binding())
        render_pass.set_pipeline(self._draw)
        for slot, (_, count, sections) in enumerate(self._wanted.draws):
            render_pass.set_bind_group(1, group, [(MOST_DEPTH + slot) * UNIFORM_STRIDE])
            render_pass.set_index_buffer(self._strips[sections], "uint32")
            render_pass.draw_indexed(6 * sections * min(BATCH, count), -(-count // BATCH))

    def _pass_binding(self) -> dict[str, Any]:
        return {"buffer": self._passes, "offset": 0, "size": MEADOW_PASS.itemsize}


def strip_triangles(sections: int) -> Ints:
    """Indices of a batch of strips with two vertices at each of ``sections`` + 1 joints."""
    left = 2 * np.arange(sections)[:, None]
    one = np.concatenate([left + np.array([0, 1, 2]), left + np.array([1, 3, 2])], axis=1)
    vertices = 2 * (sections + 1)
    return (
        (one.reshape(1, -1) + vertices * np.arange(BATCH)[:, None]).astype(np.uint32).ravel().view(np.int32)
    )
