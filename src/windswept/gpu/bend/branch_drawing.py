"""The second pass: the deformer draws every branch as an instance of one grid mesh, from the buffer it was bent in."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.gpu import layouts
from windswept.gpu.bend.bending import Bending
from windswept.gpu.buffers import UNIFORM, UNIFORM_STRIDE, filled
from windswept.gpu.failures import card_errors
from windswept.gpu.plant_drawing import STEM_BATCH, BatchedMesh, grid_triangles
from windswept.gpu.renderer import Renderer
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

LEVEL_GRIDS = ((16, 24), (6, 8), (4, 5), (3, 3))
"""Rings along a branch and sides round it, for each level; the last for all further ones."""
SHADOW_GRID = (4, 4)
"""The same in the shadow map, for all levels."""


class BranchDrawing:
    """Draws the branches of a ``Bending`` with the bark, light and shadows of a renderer.

    Args:
        renderer: whose pictures they are drawn into; its looks and stems are those of the branches.
        bending: holds the branches.
        looks: (R,) ``BRANCH_LOOK`` rows.
        grids: rings and sides for each level; one for all makes the paper's single mesh.
        lit: entry points of ``bark.wgsl``: "" for furrowed bark, "_lit" for light worked out at the vertices.

    Raises:
        GraphicsError: the card has too little memory, or was lost.
    """

    @card_errors("drawing branches")
    def __init__(
        self,
        renderer: Renderer,
        bending: Bending,
        looks: NDArray[np.void],
        grids: tuple[tuple[int, int], ...] = LEVEL_GRIDS,
        lit: str = "",
    ) -> None:
        canvas, device = renderer.canvas, renderer.canvas.device
        self._device, self._bending, self._renderer = device, bending, renderer
        self._looks = filled(device, looks)
        self._layout = buffers_layout(
            device, DRAWING, READ, READ, UNIFORM_BINDING, DYNAMIC_UNIFORM, READ, READ
        )
        shadows = [canvas.frame_layout, self._layout]
        colours = [*shadows, canvas.light_layout]

        def mesh(rings: int, sides: int, pipeline: Any) -> BatchedMesh:
            triangles = grid_triangles(rings, sides)
            return BatchedMesh(device, triangles, (rings + 1) * (sides + 1), STEM_BATCH, pipeline)

        self._meshes = []
        for rings, sides in grids:
            constants: dict[str, float] = {"RINGS": rings, "SIDES": sides}
            pipeline = colour_pipeline(
                device, colours, "bend_bark", *canvas.picture, constants, cull="back", lit=lit
            )
            self._meshes.append(mesh(rings, sides, pipeline))
        constants = {"RINGS": SHADOW_GRID[0], "SIDES": SHADOW_GRID[1]}
        self._shadow = mesh(*SHADOW_GRID, shadow_pipeline(device, shadows, "bend_bark", constants))
        self._batches = filled(device, _batch_rows(bending.branches.level_start), UNIFORM)

    def draw(self, render_pass: Any) -> None:
        """Record the draws into the picture; bind groups 0 and 2 are set."""
        group = self._group()
        for level, count in enumerate(np.diff(self._bending.branches.level_start)):
            mesh = self._meshes[min(level, len(self._meshes) - 1)]
            mesh.draw(render_pass, group, level, int(count))

    def draw_shadows(self, render_pass: Any) -> None:
        """Record the draws into the shadow map; bind group 0 is set."""
        group = self._group()
        for level, count in enumerate(np.diff(self._bending.branches.level_start)):
            self._shadow.draw(render_pass, group, level, int(count))

    def _group(self) -> Any:
        """Bind group 1; the two bent buffers swap from step to step."""
        posing = self._renderer.posing
        batch = {"buffer": self._batches, "offset": 0, "size": layouts.BATCH.itemsize}
        bending = self._bending
        return bind(
            self._device,
            self._layout,
            posing.stems,
            bending.bent,
            posing.looks,
            batch,
            bending.rest,
            self._looks,
        )


def _batch_rows(level_start: NDArray[np.int32]) -> NDArray[np.uint8]:
    """(D, UNIFORM_STRIDE) ``BATCH`` of every level."""
    rows = np.zeros((len(level_start) - 1, UNIFORM_STRIDE), np.uint8)
    for row, (first, end) in zip(rows, pairwise(level_start.tolist()), strict=True):
        batch = np.zeros(1, layouts.BATCH)
        batch["items"] = first, end - first, 1, 0
        batch["scale"] = 1.0, 0.0, 0.0, 0.0
        row[: layouts.BATCH.itemsize] = batch.view(np.uint8)
    return rows
