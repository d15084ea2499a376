"""Draws what is not a plant of the scene: sky, ground and the meadow grass round the camera."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu

from windswept.gpu.buffers import filled
from windswept.gpu.frame import Ground
from windswept.gpu.ground_mesh import ground_mesh
from windswept.gpu.wiring import bind, colour_pipeline

GRASS_SPACINGS = (0.07, 0.16, 0.40)
"""Lattice spacing of each ring of grass, m; a ring ends where the next begins."""
GRASS_CELLS = 110
"""CELLS of ``grass.wgsl``."""
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
        height_layout = device.create_bind_group_layout(
            entries=[
                {
                    "binding": 0,
                    "visibility": wgpu.ShaderStage.VERTEX,
                    "texture": {"sample_type": "unfilterable-float"},
                }
            ]
        )
        self._heights = bind(device, height_layout, _height_texture(device, ground).create_view())
        layouts = [frame_layout, height_layout, light_layout]
        picture = (colour_format, samples)
        mesh = ground_mesh(ground)
        self._vertices = filled(device, mesh.vertices, wgpu.BufferUsage.VERTEX)
        self._triangles = filled(device, mesh.triangles.astype(np.uint32), wgpu.BufferUsage.INDEX)
        self._index_count = mesh.triangles.size
        self._ground = colour_pipeline(
            device, layouts, "ground", *picture, cull="back", vertex_buffers=[_VERTEX]
        )
        self._sky = colour_pipeline(device, layouts, "sky", *picture)
        inner = 0.0
        self._grass = []
        for spacing in GRASS_SPACINGS:
            constants = {"SPACING": spacing, "INNER": inner}
            self._grass.append(colour_pipeline(device, layouts, "grass", *picture, constants))
            inner = 0.5 * GRASS_CELLS * spacing * 0.8
        blades = BLADE_TRIANGLES.reshape(1, -1) + 5 * np.arange(GRASS_BATCH, dtype=np.uint32)[:, None]
        self._blades = filled(device, blades.ravel(), wgpu.BufferUsage.INDEX)

    def draw_near(self, render_pass: Any) -> None:
        """Record the grass; bind groups 0 and 2 are set."""
        render_pass.set_bind_group(1, self._heights)
        render_pass.set_index_buffer(self._blades, "uint32")
        instances = -(-(GRASS_CELLS**2) // GRASS_BATCH)
        for pipeline in self._grass:
            render_pass.set_pipeline(pipeline)
            render_pass.draw_indexed(BLADE_TRIANGLES.size * GRASS_BATCH, instances)

    def draw_far(self, render_pass: Any) -> None:
        """Record ground and sky, best after everything that hides them."""
        render_pass.set_bind_group(1, self._heights)
        render_pass.set_pipeline(self._ground)
        render_pass.set_vertex_buffer(0, self._vertices)
        render_pass.set_index_buffer(self._triangles, "uint32")
        render_pass.draw_indexed(self._index_count)
        render_pass.set_pipeline(self._sky)
        render_pass.draw(3)


def _height_texture(device: Any, ground: Ground) -> Any:
    rows, columns = ground.height.shape
    texture = device.create_texture(
        size=(columns, rows, 1),
        format="r32float",
        usage=wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST,
    )
    data = np.ascontiguousarray(ground.height, np.float32)
    device.queue.write_texture(
        {"texture": texture},
        data,
        {"bytes_per_row": 4 * columns, "rows_per_image": rows},
        (columns, rows, 1),
    )
    return texture
