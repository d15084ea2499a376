"""Draws what is not a plant of the scene: sky, ground and the meadow grass round the camera."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.gpu.buffers import filled
from windswept.gpu.frame import Ground
from windswept.gpu.ground_mesh import ground_mesh
from windswept.gpu.lawn import Lawn
from windswept.gpu.wiring import DRAWING, READ, bind, buffers_layout, colour_pipeline
from windswept.gpu.wiring import UNIFORM as UNIFORM_BINDING

Doubles = NDArray[np.float64]

GRASS_BATCH = 64
"""BATCH of ``grass.wgsl``."""
BLADE_TRIANGLES = np.array([(0, 1, 2), (1, 3, 2), (2, 3, 4)], np.uint32)
"""Of a blade of five vertices."""
_VERTEX = {
    "array_stride": 24,
    "step_mode": "vertex",
    "attributes": [
        {"format": "float32x3", "offset": 0, "shader_location": 0},
        {"format": "float32x3", "offset": 12, "shader_location": 1},
    ],
}


class Backdrop:
    """Pipelines and meshes of sky, ground and grass.

    Args:
        device: the card.
        ground: terrain heights.
        frame_layout: layout of bind group 0.
        light_layout: layout of bind group 2.
        colour_format: of the picture.
        samples: of the picture.
    """

    def __init__(
        self,
        device: Any,
        ground: Ground,
        frame_layout: Any,
        light_layout: Any,
        colour_format: str,
        samples: int,
    ) -> None:
        self._device = device
        self._grass_layout = buffers_layout(device, DRAWING, READ, UNIFORM_BINDING)
        layouts_far = [frame_layout, buffers_layout(device, DRAWING), light_layout]
        layouts_near = [frame_layout, self._grass_layout, light_layout]
        self._no_buffers = bind(device, layouts_far[1])
        picture = (colour_format, samples)
        mesh = ground_mesh(ground)
        self._vertices = filled(device, mesh.vertices, wgpu.BufferUsage.VERTEX)
        self._triangles = filled(device, mesh.triangles.astype(np.uint32), wgpu.BufferUsage.INDEX)
        self._index_count = mesh.triangles.size
        self._ground = colour_pipeline(
            device, layouts_far, "ground", *picture, cull="back", vertex_buffers=[_VERTEX]
        )
        self._sky = colour_pipeline(device, layouts_far, "sky", *picture)
        self._grass = colour_pipeline(device, layouts_near, "grass", *picture)
        self._ground_shape = ground
        self._lawn: Lawn | None = None
        self._stood_for: Doubles | None = None
        blades = BLADE_TRIANGLES.reshape(1, -1) + 5 * np.arange(GRASS_BATCH, dtype=np.uint32)[:, None]
        self._blades = filled(device, blades.ravel(), wgpu.BufferUsage.INDEX)

    def encode(self, encoder: Any, eye: Doubles, planes: Doubles, timestamps: dict[str, Any]) -> None:
        """Finds the blades of grass in sight of a camera at ``eye`` (3,) with frustum ``planes`` (5, 4)."""
        if self._stood_for is not None and np.array_equal(planes, self._stood_for):
            return
        if self._lawn is None:
            self._lawn = Lawn(self._device, self._ground_shape)
        self._stood_for = planes
        self._lawn.record(encoder, eye, planes, timestamps)

    def draw_near(self, render_pass: Any) -> None:
        """Record the grass; bind groups 0 and 2 are set."""
        if self._lawn is None:
            return
        group = bind(self._device, self._grass_layout, self._lawn.blades, self._lawn.batch)
        render_pass.set_bind_group(1, group)
        render_pass.set_index_buffer(self._blades, "uint32")
        render_pass.set_pipeline(self._grass)
        render_pass.draw_indexed_indirect(self._lawn.words, 0)

    def draw_far(self, render_pass: Any) -> None:
        """Record ground and sky, best after everything that hides them."""
        render_pass.set_bind_group(1, self._no_buffers)
        render_pass.set_pipeline(self._ground)
        render_pass.set_vertex_buffer(0, self._vertices)
        render_pass.set_index_buffer(self._triangles, "uint32")
        render_pass.draw_indexed(self._index_count)
        render_pass.set_pipeline(self._sky)
        render_pass.draw(3)
