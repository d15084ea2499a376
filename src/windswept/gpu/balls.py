"""Draws balls that roll through the scene."""

from __future__ import annotations

from typing import Any

from windswept.gpu.buffers import GrowingBuffer
from windswept.gpu.layouts import BALL
from windswept.gpu.wiring import DRAWING, READ, bind, buffers_layout, colour_pipeline, shadow_pipeline
from windswept.plants.plant import Floats

VERTICES = 6 * 14 * 28
"""Corners of all triangles: 6 RINGS SIDES of ``balls.wgsl``."""


class Balls:
    """Pipelines for balls, and the balls of a frame.

    Args:
        device: the card.
        frame_layout: layout of bind group 0.
        light_layout: layout of bind group 2.
        picture: colour format and samples of a pixel.
    """

    def __init__(self, device: Any, frame_layout: Any, light_layout: Any, picture: tuple[str, int]) -> None:
        self._device = device
        self._layout = buffers_layout(device, DRAWING, READ)
        shadows = [frame_layout, self._layout]
        self._colour = colour_pipeline(device, [*shadows, light_layout], "balls", *picture)
        self._shadow = shadow_pipeline(device, shadows, "balls", {})
        self._rows = GrowingBuffer(device, BALL)
        self._count = 0

    def upload(self, balls: Floats) -> None:
        """Send the balls of a frame: (n, 8) middle and radius, m, and quaternion."""
        self._count = len(balls)
        self._rows.reserve(self._count)
        self._rows.write(balls)

    def draw(self, render_pass: Any) -> None:
        """Record the draw into the picture; bind groups 0 and 2 are set."""
        self._record(render_pass, self._colour)

    def draw_shadows(self, render_pass: Any) -> None:
        """Record the draw into the shadow map; bind group 0 is set."""
        self._record(render_pass, self._shadow)

    def _record(self, render_pass: Any, pipeline: Any) -> None:
        if self._count:
            render_pass.set_pipeline(pipeline)
            render_pass.set_bind_group(1, bind(self._device, self._layout, self._rows.buffer))
            render_pass.draw(VERTICES, self._count)
