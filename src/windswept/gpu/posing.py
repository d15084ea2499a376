"""The compute stage: link poses in, posed pieces and leaves out. See ``shaders/curves.wgsl``."""

from __future__ import annotations

from typing import Any

import numpy as np

from windswept.gpu import layouts
from windswept.gpu.buffers import UNIFORM, GrowingBuffer, filled
from windswept.gpu.draw_list import DrawList
from windswept.gpu.draw_plan import LEAVES, PIECES, STEMS, DrawPlan
from windswept.gpu.frame import PosedPlants
from windswept.gpu.plant_buffers import PlantArrays
from windswept.gpu.wiring import COMPUTE, READ, WRITE, bind, buffers_layout, compute_pipeline
from windswept.gpu.wiring import UNIFORM as UNIFORM_BINDING

STAGES = (("offsets", STEMS), ("sum_shifts", STEMS), ("pose_pieces", PIECES), ("pose_leaves", LEAVES))
"""Entry points and where their workgroups stand in a plan."""
MOST_BYTES = 1 << 30
"""Of a buffer that grows with what frames want, whatever the card could bind; more only where least detail needs it."""
Counts = tuple[int, int, int, int]
"""Of link poses, shifted stems, posed pieces and posed leaves."""


class Posing:
    """Holds all plants at rest on the card and poses those of a draw plan.

    Args:
        device: the card.
        frame_layout: layout of the bind group that holds the frame's uniforms.
        plants: all kinds at rest.
    """

    def __init__(self, device: Any, frame_layout: Any, plants: PlantArrays) -> None:
        self._device, self._kinds = device, plants.kinds
        self._layout = buffers_layout(
            device, COMPUTE, *[READ] * 5, *[WRITE] * 3, UNIFORM_BINDING, UNIFORM_BINDING
        )
        pipeline_layouts = [frame_layout, self._layout]
        self._stages = [
            (compute_pipeline(device, pipeline_layouts, "curves", entry), word) for entry, word in STAGES
        ]
        self._pieces = filled(device, plants.pieces)
        self._leaves = filled(device, plants.leaves)
        self.stems = filled(device, plants.stems)
        self.looks = filled(device, plants.looks, UNIFORM)
        self.links = GrowingBuffer(device, layouts.LINK_POSE, MOST_BYTES)
        self.shifts = GrowingBuffer(device, layouts.STEM_SHIFT, MOST_BYTES)
        self.posed_pieces = GrowingBuffer(device, layouts.POSED_PIECE, MOST_BYTES)
        self.posed_leaves = GrowingBuffer(device, layouts.POSED_LEAF, MOST_BYTES)

    @property
    def room(self) -> Counts:
        """What there is room for."""
        links, shifts, pieces, leaves = (store.rows for store in self._stores)
        return links, shifts, pieces, leaves

    @property
    def bytes(self) -> int:
        """Memory of all buffers."""
        own = [self._pieces, self._leaves, self.stems, self.looks, *(store.buffer for store in self._stores)]
        return sum(buffer.size for buffer in own)

    def reserve(self, wanted: Counts) -> None:
        """Makes room for what a frame poses.

        Raises:
            GraphicsError: the device cannot bind so much at once, or has not so much memory.
        """
        for store, rows in zip(self._stores, wanted, strict=True):
            store.reserve(rows)

    def affordable(self, wanted: Counts) -> Counts:
        """As much of what is wanted as a buffer of this card may hold."""
        links, shifts, pieces, leaves = (
            min(rows, store.most_rows) for rows, store in zip(wanted, self._stores, strict=True)
        )
        return links, shifts, pieces, leaves

    def upload(self, plants: tuple[PosedPlants, ...], wanted: DrawList) -> None:
        """Sends the poses that a draw list needs, and makes room for what it wants.

        Args:
            plants: placements of each kind.
            wanted: what will be posed.
        """
        self.reserve(wanted.counts)
        poses = np.empty((wanted.counts[0], 8), np.float32)
        placed = [len(posed.position) for posed in plants]
        kind_first = np.cumsum([0, *placed])
        numbers = wanted.placements["number"][:, 0].astype(np.int64)
        kinds = np.searchsorted(kind_first, numbers, side="right") - 1
        firsts = wanted.placements["rows"][:, 0]
        for k, number, first, count in zip(kinds, numbers, firsts, wanted.links, strict=True):
            own = np.asarray(plants[k].link, np.float32)[number - kind_first[k]]
            np.take(own, self._kinds[k].pose.link_order[:count], axis=0, out=poses[first : first + count])
        self.links.write(poses)

    def encode(self, encoder: Any, frame_group: Any, plan: DrawPlan, timestamps: dict[str, Any]) -> None:
        """Records the dispatches that pose what a plan lists.

        Args:
            encoder: records them.
            frame_group: the frame's uniforms.
            plan: what is drawn.
            timestamps: what the pass is begun with.
        """
        group = bind(
            self._device,
            self._layout,
            plan.placements,
            self.stems,
            self._pieces,
            self._leaves,
            *(store.buffer for store in self._stores),
            self.looks,
            plan.listed,
        )
        stage_pass = encoder.begin_compute_pass(**timestamps)
        stage_pass.set_bind_group(0, frame_group)
        stage_pass.set_bind_group(1, group)
        for pipeline, word in self._stages:
            stage_pass.set_pipeline(pipeline)
            stage_pass.dispatch_workgroups_indirect(plan.words, 4 * word)
        stage_pass.end()

    @property
    def _stores(self) -> tuple[GrowingBuffer, ...]:
        return self.links, self.shifts, self.posed_pieces, self.posed_leaves
