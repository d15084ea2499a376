"""Holds the blades of a meadow on the card, chooses and poses those in sight and draws them."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu

from windswept.gpu.buffers import UNIFORM_STRIDE, filled, room
from windswept.gpu.frame import MeadowMotion
from windswept.gpu.meadow.blade_choice import MOST_DEPTH, BladeChoice
from windswept.gpu.meadow.blade_list import BladeRules, Sharpness
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
MOST_JOINTS = 1 << 22
"""That one frame poses: 128 MiB, which every adapter binds; where more are in sight, blades get fewer sections."""
_LEAN = np.dtype("<f4")


class MeadowDrawing:
    """Buffers and pipelines of a meadow.

    Args:
        device: the card.
        beds: the blades of the scene.
        rules: what may be spent.
        frame_layout: layout of bind group 0.
        light_layout: layout of bind group 2.
        picture: colour format and samples of a pixel.

    Raises:
        GraphicsError: the card has too little memory.
    """

    def __init__(
        self,
        device: Any,
        beds: tuple[Bed, ...],
        rules: BladeRules,
        frame_layout: Any,
        light_layout: Any,
        picture: tuple[str, int],
    ) -> None:
        self._device = device
        self.rows: MeadowRows = meadow_rows(beds)
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
        joints = min(most_joints(self.rows), MOST_JOINTS)
        self._posed = room(device, POSED_JOINT, joints)
        self.choice = BladeChoice(device, self.rows, rules, joints)
        self._strips = {
            sections: filled(device, strip_triangles(sections), wgpu.BufferUsage.INDEX)
            for sections in self.choice.section_numbers
        }
        self._own_leans: Any = None
        self._seen: tuple[MeadowMotion, Sharpness] | None = None

    @property
    def drawn_count(self) -> int:
        """Blades that the last frame drew, read back."""
        return 0 if self._seen is None else self.choice.chosen_count

    def upload(self, motion: MeadowMotion, sharpness: Sharpness) -> None:
        """Take what the next frame shows.

        Args:
            motion: leans of all sets that move; sent to the card where they are not there.
            sharpness: who looks.
        """
        self._seen = motion, sharpness
        if motion.leans is not None:
            return
        if self._own_leans is None:
            self._own_leans = room(self._device, _LEAN, sum(self.rows.state_sizes))
        first = 0
        for lanes, size in zip(motion.lanes, self.rows.state_sizes, strict=True):
            self._device.queue.write_buffer(self._own_leans, 4 * first, lanes)
            first += size

    def choose(self, encoder: Any, timestamps: dict[str, Any]) -> None:
        """Record the choice of what is posed and drawn."""
        if self._seen is not None:
            motion, sharpness = self._seen
            self.choice.record(encoder, sharpness, motion.ahead, timestamps)

    def encode(self, compute_pass: Any) -> None:
        """Record the dispatches that pose what is drawn, parents first; bind groups 0 and 2 are set."""
        if self._seen is None:
            return
        leans = self._seen[0].leans
        group = bind(
            self._device,
            self._pose_layout,
            self._blades,
            self.choice.items,
            self._own_leans if leans is None else leans,
            self._tables,
            self._runs,
            self._borders,
            self._posed,
            self._pass_binding(),
        )
        compute_pass.set_pipeline(self._pose)
        for depth in range(self.choice.depths):
            compute_pass.set_bind_group(1, group, [depth * UNIFORM_STRIDE])
            compute_pass.dispatch_workgroups_indirect(self.choice.plan, 12 * depth)

    def draw(self, render_pass: Any) -> None:
        """Record the draws into the picture; bind group 0 is set."""
        if self._seen is None:
            return
        group = bind(self._device, self._draw_layout, self._posed, self._pass_binding())
        render_pass.set_pipeline(self._draw)
        for row, sections in enumerate(self.choice.section_numbers):
            render_pass.set_bind_group(1, group, [(MOST_DEPTH + row) * UNIFORM_STRIDE])
            render_pass.set_index_buffer(self._strips[sections], "uint32")
            render_pass.draw_indexed_indirect(self.choice.plan, 4 * (3 * MOST_DEPTH + 5 * row))

    def _pass_binding(self) -> dict[str, Any]:
        return {"buffer": self.choice.passes, "offset": 0, "size": MEADOW_PASS.itemsize}


def most_joints(rows: MeadowRows) -> int:
    """Joints of all blades with all their sections."""
    return int((np.diff(rows.chunk_first) * (rows.sections[rows.chunk_set].max(axis=1) + 1)).sum())


def strip_triangles(sections: int) -> Ints:
    """Indices of a batch of strips with two vertices at each of ``sections`` + 1 joints."""
    left = 2 * np.arange(sections)[:, None]
    one = np.concatenate([left + np.array([0, 1, 2]), left + np.array([1, 3, 2])], axis=1)
    vertices = 2 * (sections + 1)
    return (
        (one.reshape(1, -1) + vertices * np.arange(BATCH)[:, None]).astype(np.uint32).ravel().view(np.int32)
    )
