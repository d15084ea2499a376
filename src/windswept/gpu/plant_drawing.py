"""Draws posed stems and leaves, into the picture and into the shadow map.

Vertices are pulled: an instance is a batch of items, and the shader finds item and grid point from the vertex
number. Small meshes instanced one by one would leave most of a card idle.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.geometry.leaves import LeafMesh, leaf_mesh
from windswept.gpu import layouts
from windswept.gpu.buffers import UNIFORM_STRIDE, filled
from windswept.gpu.draw_plan import DRAWS, SHADOW_LEAF_STEP, DrawPlan
from windswept.gpu.posing import Posing
from windswept.gpu.wiring import (
    DRAWING,
    DYNAMIC_UNIFORM,
    READ,
    bind,
    buffers_layout,
    colour_pipeline,
    shadow_pipeline,
)
from windswept.gpu.wiring import UNIFORM as UNIFORM_BINDING
from windswept.plants.plant import Ints

STEM_GRIDS = ((12, 20), (5, 9), (3, 5), (2, 3))
"""Rings along a piece and sides round it, for each bucket."""
STEM_LIT = ("", "", "_lit", "_lit")
"""Whether each bucket is lit at its vertices: cheaper where faces are as small as pixels."""
STEM_SHADOW_GRIDS = ((5, 8), (3, 5), (2, 3))
"""The same for shadows; the finest twigs throw none."""
STEM_BATCH = 32
"""BATCH of ``bark.wgsl``."""
LEAF_STATIONS = (5, 3, 1)
"""Edge points of each leaf mesh."""
LEAF_LIT = ("", "", "_lit")
"""Whether each leaf mesh is lit at its vertices."""
LEAF_BATCH = 64
"""BATCH of ``leaves.wgsl``."""


class PlantDrawing:
    """Pipelines and meshes for stems and leaves.

    Args:
        device: the card.
        posing: holds what is drawn.
        frame_layout: layout of bind group 0.
        light_layout: layout of bind group 2.
        colour_format: of the picture.
        samples: of the picture.
    """

    def __init__(
        self,
        device: Any,
        posing: Posing,
        frame_layout: Any,
        light_layout: Any,
        colour_format: str,
        samples: int,
    ) -> None:
        self._device = device
        self._posing = posing
        self._layout = buffers_layout(device, DRAWING, READ, READ, UNIFORM_BINDING, DYNAMIC_UNIFORM)
        shadows = [frame_layout, self._layout]
        colours = [*shadows, light_layout]
        picture = (colour_format, samples)
        self._stems = [
            BatchedMesh(
                device,
                grid_triangles(rings, sides),
                (rings + 1) * (sides + 1),
                STEM_BATCH,
                colour_pipeline(
                    device,
                    colours,
                    "bark",
                    *picture,
                    {"RINGS": rings, "SIDES": sides},
                    cull="back",
                    lit=lit,
                ),
            )
            for (rings, sides), lit in zip(STEM_GRIDS, STEM_LIT, strict=True)
        ]
        self._stem_shadows = [
            BatchedMesh(
                device,
                grid_triangles(rings, sides),
                (rings + 1) * (sides + 1),
                STEM_BATCH,
                shadow_pipeline(device, shadows, "bark", {"RINGS": rings, "SIDES": sides}),
            )
            for rings, sides in STEM_SHADOW_GRIDS
        ]
        meshes = [leaf_mesh(stations) for stations in LEAF_STATIONS]
        self._blades = [filled(device, _blade_rows(mesh)) for mesh in meshes]
        self._leaves = []
        for mesh, lit in zip(meshes, LEAF_LIT, strict=True):
            count = mesh.vertices.shape[1]
            pipeline = colour_pipeline(device, colours, "leaves", *picture, {"VERTICES": count}, lit=lit)
            self._leaves.append(BatchedMesh(device, mesh.triangles, count, LEAF_BATCH, pipeline))
        kite = meshes[-1]
        count = kite.vertices.shape[1]
        pipeline = shadow_pipeline(device, shadows, "leaves", {"VERTICES": count})
        self._leaf_shadow = BatchedMesh(device, kite.triangles, count, LEAF_BATCH, pipeline)

    @property
    def meshes(self) -> Ints:
        """(M, 4) draws of a ``DrawPlan``: stems and leaves, then the shadows of both."""
        ranges = range(len(STEM_GRIDS) + len(LEAF_STATIONS))
        picture = [mesh.row(1) for mesh in self._stems + self._leaves]
        stem_shadows = [mesh.row(1) for mesh in self._stem_shadows]
        no_shadows = [(0, 1, 1)] * (len(STEM_GRIDS) - len(stem_shadows))
        leaf_shadows = [self._leaf_shadow.row(SHADOW_LEAF_STEP)] * len(LEAF_STATIONS)
        rows = picture + stem_shadows + no_shadows + leaf_shadows
        return np.column_stack([rows, [*ranges, *ranges]]).astype(np.int32)

    def draw(self, render_pass: Any, plan: DrawPlan) -> None:
        """Record the draws into the picture; bind groups 0 and 2 are set."""
        stem_group, leaf_groups = self._groups(plan)
        groups = [stem_group] * len(self._stems) + leaf_groups
        for slot, (mesh, group) in enumerate(zip(self._stems + self._leaves, groups, strict=True)):
            mesh.draw_planned(render_pass, group, slot, plan.words, DRAWS)

    def draw_shadows(self, render_pass: Any, plan: DrawPlan) -> None:
        """Record the draws into the shadow map; bind group 0 is set."""
        stem_group, leaf_groups = self._groups(plan)
        first = len(STEM_GRIDS) + len(LEAF_STATIONS)
        for slot, mesh in enumerate(self._stem_shadows):
            mesh.draw_planned(render_pass, stem_group, first + slot, plan.words, DRAWS)
        first += len(STEM_GRIDS)
        for slot in range(len(LEAF_STATIONS)):
            self._leaf_shadow.draw_planned(render_pass, leaf_groups[-1], first + slot, plan.words, DRAWS)

    def _groups(self, plan: DrawPlan) -> tuple[Any, list[Any]]:
        """Bind group 1 for stems, and for the leaves of each mesh; posed buffers may have grown."""
        posing = self._posing
        batch = {"buffer": plan.batches, "offset": 0, "size": layouts.BATCH.itemsize}
        stems = bind(
            self._device, self._layout, posing.stems, posing.posed_pieces.buffer, posing.looks, batch
        )
        leaves = [
            bind(self._device, self._layout, blade, posing.posed_leaves.buffer, posing.looks, batch)
            for blade in self._blades
        ]
        return stems, leaves


class BatchedMesh:
    """Indices of one batch of equal meshes, and the pipeline they are drawn with."""

    def __init__(self, device: Any, triangles: Ints, vertices: int, batch: int, pipeline: Any) -> None:
        repeated = triangles.reshape(1, -1) + vertices * np.arange(batch)[:, None]
        self._indices = filled(device, repeated.astype(np.uint32).ravel(), wgpu.BufferUsage.INDEX)
        self._index_count = triangles.size
        self._batch = batch
        self._pipeline = pipeline

    def row(self, step: int) -> tuple[int, int, int]:
        """What a ``DrawPlan`` knows of it, drawn for one of ``step`` items."""
        return self._index_count, self._batch, step

    def draw(self, render_pass: Any, group: Any, slot: int, items: int) -> None:
        """Record the draw of this many items out of a batch slot."""
        if items == 0:
            return
        self._set(render_pass, group, slot)
        render_pass.draw_indexed(self._index_count * min(self._batch, items), -(-items // self._batch))

    def draw_planned(self, render_pass: Any, group: Any, slot: int, words: Any, first: int) -> None:
        """Record the draw of a batch slot whose arguments stand in a buffer, 5 words a slot from ``first`` on."""
        self._set(render_pass, group, slot)
        render_pass.draw_indexed_indirect(words, 4 * (first + 5 * slot))

    def _set(self, render_pass: Any, group: Any, slot: int) -> None:
        render_pass.set_pipeline(self._pipeline)
        render_pass.set_index_buffer(self._indices, "uint32")
        render_pass.set_bind_group(1, group, [slot * UNIFORM_STRIDE])


def grid_triangles(rings: int, sides: int) -> Ints:
    """(2 rings sides, 3) triangles of a grid of (rings+1) by (sides+1) vertices, facing outwards."""
    row = sides + 1
    corner = (np.arange(rings)[:, None] * row + np.arange(sides)).ravel()
    lower = np.stack([corner, corner + 1, corner + row], axis=1)
    upper = np.stack([corner + 1, corner + row + 1, corner + row], axis=1)
    return np.concatenate([lower, upper]).astype(np.int32)


def _blade_rows(mesh: LeafMesh) -> NDArray[np.float32]:
    """(2 shapes V, 4) position and normal of every vertex, shape by shape."""
    both = np.stack([mesh.vertices, mesh.normals], axis=2).reshape(-1, 3)
    return np.pad(both, [(0, 0), (0, 1)])
