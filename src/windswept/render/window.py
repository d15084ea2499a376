"""The live window: orbit with the mouse, set the wind, pause."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import closing
from typing import Any

import wgpu

from windswept.errors import GraphicsError
from windswept.gpu.device import shared_device
from windswept.gpu.failures import card_errors
from windswept.gpu.frame import Camera
from windswept.render.live_scene import LiveScene
from windswept.render.live_view import Controls, LiveView
from windswept.render.orbit import orbit_from
from windswept.render.staging import stage

SIZE = (1280, 720)
"""Pixels that the window opens with."""


def require_window() -> None:
    """Refuses early: without a display the window library would abort the process.

    Raises:
        GraphicsError: no display, or the ``view`` extra is not installed.
    """
    names = ("DISPLAY", "WAYLAND_DISPLAY")
    if os.name == "posix" and os.uname().sysname == "Linux" and not any(os.environ.get(n) for n in names):
        raise GraphicsError(
            "no display: neither DISPLAY nor WAYLAND_DISPLAY is set; `windswept render` needs none"
        )
    try:
        import rendercanvas.glfw  # noqa: F401
        import wgpu.utils.imgui  # noqa: F401
    except ImportError as error:
        raise GraphicsError(f"the window needs: pip install 'windswept[view]' ({error})") from error


def show_window(scene: LiveScene, camera: Camera, controls: Controls, title: str = "windswept") -> None:
    """Open a window and run until it is closed.

    Args:
        scene: what is to be seen.
        camera: where the view begins; the window orbits round its target.
        controls: where the sliders begin; they move them.
        title: of the window.

    Raises:
        GraphicsError: see `require_window`; or no adapter, or the card was lost.
    """
    require_window()
    from rendercanvas.glfw import RenderCanvas, loop

    with closing(RenderCanvas(title=title, size=SIZE, update_mode="continuous", max_fps=60)) as canvas:
        draw = _drawing(canvas, scene, camera, controls)
        failures: list[GraphicsError] = []

        def draw_or_end() -> None:
            try:
                with card_errors("drawing the window"):
                    draw()
            except GraphicsError as error:
                failures.append(error)
                loop.stop()
                raise wgpu.DrawCancelled from error  # any other error would be logged, and the window drawn again

        canvas.request_draw(draw_or_end)
        loop.run()
    if failures:
        raise failures[0]


def _drawing(canvas: Any, scene: LiveScene, camera: Camera, controls: Controls) -> Callable[[], None]:
    """What draws a frame on a canvas and shows it."""
    from wgpu.utils.imgui import ImguiRenderer

    device, context = shared_device(), canvas.get_wgpu_context()
    colour_format = context.get_preferred_format(device.adapter)
    usage = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_DST
    context.configure(device=device, format=colour_format, usage=usage)
    renderer = stage(scene.simulation, canvas.get_physical_size(), colour_format=colour_format)
    panel = ImguiRenderer(device, canvas)
    view = LiveView(renderer, scene.advance, orbit_from(camera), controls)
    panel.set_gui(view.panel)
    canvas.add_event_handler(view.handle, "pointer_move", "wheel")

    def draw() -> None:
        view.draw(canvas.get_physical_size())
        # The window's own texture is held as shortly as can be: to release it on a lost card ends the process.
        renderer.copy_into(context.get_current_texture())
        panel.render()

    return draw
