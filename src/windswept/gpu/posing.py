"""The compute stage: link poses in, posed pieces and leaves out. See ``shaders/curves.wgsl``."""

from __future__ import annotations

from typing import Any

import numpy as np

from windswept.gpu import layouts
from windswept.gpu.buffers import UNIFORM, GrowingBuffer, filled
from windswept.gpu.draw_list import DrawList
from windswept.gpu.frame import FLUTTER_SPEED, LARGEST_FLUTTER, CardMotion, PosedPlants
from windswept.gpu.kernel import Kernel
from windswept.gpu.plant_buffers import PlantArrays
from windswept.gpu.wiring import COMPUTE, READ, WRITE, bind, buffers_layout, compute_pipeline
from windswept.gpu.wiring import UNIFORM as UNIFORM_BINDING

WORKGROUP = 64
STAGES = ("offsets", "sum_shifts", "pose_pieces", "pose_leaves")


class Posing:
    """Holds all plants at rest on the card and poses those of a draw list.

    Args:
        device: the card.
        frame_layout: layout of the bind group that holds the frame's uniforms.
        plants: all kinds at rest.
    """

    def __init__(self, device: Any, frame_layout: Any, plants: PlantArrays) -> None:
        self._device = device
        self._layout = buffers_layout(device, COMPUTE, *[READ] * 5, *[WRITE] * 3, UNIFORM_BINDING)
        pipeline_layouts = [frame_layout, self._layout]
        self._pipelines = [compute_pipeline(device, pipeline_layouts, "curves", stage) for stage in STAGES]
        self._pieces = filled(device, plants.pieces)
        self._leaves = filled(device, plants.leaves)
        self.stems = filled(device, plants.stems)
        self.looks = filled(device, plants.looks, UNIFORM)
        self.placements = GrowingBuffer(device, layouts.PLACEMENT)
        self.links = GrowingBuffer(device, layouts.LINK_POSE)
        self.shifts = GrowingBuffer(device, layouts.STEM_SHIFT)
        self.posed_pieces = GrowingBuffer(device, layouts.POSED_PIECE)
        self.posed_leaves = GrowingBuffer(device, layouts.POSED_LEAF)
        self._flutter: Kernel | None = None

    def upload(self, plants: tuple[PosedPlants, ...], shift_count: int, wanted: DrawList) -> None:
        """Send the poses of all placements that are not on the card, and make room for what the draw list wants.

        Args:
            plants: placements of each kind.
            shift_count: stems of all placements together.
            wanted: what will be posed.
        """
        poses = [np.asarray(p.link, np.float32).reshape(-1, 8) for p in plants if p.link is not None]
        self.links.reserve(sum(map(len, poses)))
        first = 0
        for rows in poses:
            self.links.write(rows, first)
            first += len(rows)
        self.shifts.reserve(shift_count)
        self.placements.reserve(len(wanted.placements))
        self.placements.write(wanted.placements)
        self.posed_pieces.reserve(wanted.piece_count)
        self.posed_leaves.reserve(wanted.leaf_count)

    def encode(
        self,
        encoder: Any,
        frame_group: Any,
        wanted: DrawList,
        motion: CardMotion | None,
        timestamps: dict[str, Any],
    ) -> None:
        """Record the dispatches that pose a draw list.

        Args:
            encoder: records them.
            frame_group: the frame's uniforms.
            wanted: what is drawn.
            motion: poses and winds that are on the card already.
            timestamps: what the pass is begun with.
        """
        group = bind(
            self._device,
            self._layout,
            self.placements.buffer,
            self.stems,
            self._pieces,
            self._leaves,
            self.links.buffer if motion is None else motion.links,
            self.shifts.buffer,
            self.posed_pieces.buffer,
            self.posed_leaves.buffer,
            self.looks,
        )
        reach = (wanted.stem_most, wanted.stem_most, wanted.piece_most, wanted.leaf_most)
        stage_pass = encoder.begin_compute_pass(**timestamps)
        if motion is not None and len(wanted.placements):
            self._flutter_kernel(motion).record(stage_pass, -(-len(wanted.placements) // WORKGROUP))
        stage_pass.set_bind_group(0, frame_group)
        stage_pass.set_bind_group(1, group)
        for pipeline, items in zip(self._pipelines, reach, strict=True):
            if items and len(wanted.placements):
                stage_pass.set_pipeline(pipeline)
                stage_pass.dispatch_workgroups(-(-items // WORKGROUP), len(wanted.placements))
        stage_pass.end()

    def _flutter_kernel(self, motion: CardMotion) -> Kernel:
        """Kernel that lets leaves tremble by the winds on the card."""
        resources = {"speeds": motion.speeds, "placements": self.placements.buffer}
        if self._flutter is None:
            constants = {"LARGEST_FLUTTER": LARGEST_FLUTTER, "FLUTTER_SPEED": FLUTTER_SPEED}
            self._flutter = Kernel(self._device, "flutter", "flutter", resources, constants)
        self._flutter.bind(resources)
        return self._flutter
