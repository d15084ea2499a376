"""The live window: orbit with the mouse, set the wind, pause."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import wgpu

from windswept.errors import GraphicsError
from windswept.geometry.geometry import Geometry
from windswept.gpu.culling import Told
from windswept.gpu.device import shared_device
from windswept.gpu.failures import card_errors
from windswept.gpu.frame import FLAT_GROUND, Camera, Frame, Ground
from windswept.gpu.renderer import Renderer
from windswept.plants.plant import Look, Plant
from windswept.render.orbit import Orbit, orbit_from
from windswept.scene.meadow_bed import Bed

TURN_PER_PIXEL = 0.006
ZOOM_PER_STEP = 1.0015
LONGEST_STEP = 0.1
"""Most time that one frame advances, s: after a stall the scene goes on where it was."""
STRONGEST_WIND = 25.0
"""End of the wind slider, m/s."""
STAGES_EVERY = 30
"""Frames between two looks at the card's clock, which wait for it."""


@dataclass(slots=True)
class Controls:
    """What the window's sliders set; the caller reads it at every frame."""

    wind_speed: float = 5.0
    """m/s."""
    wind_heading: float = 0.0
    """Direction in which the wind blows, rad from +X towards +Y."""
    paused: bool = False
    counters: str = ""
    """A line of text shown below the sliders; the caller may set it."""


Advance = Callable[[float, Controls, Camera, tuple[int, int]], Frame]
"""Given the seconds since the last frame (0 while paused), the controls, the camera, and width and height of the
window in pixels: the frame to draw."""


def show_window(
    plants: list[Plant],
    geometries: list[Geometry],
    advance: Advance,
    camera: Camera,
    ground: Ground = FLAT_GROUND,
    controls: Controls | None = None,
    title: str = "windswept",
    extra_looks: tuple[Look, ...] = (),
    beds: tuple[Bed, ...] = (),
) -> None:
    """Open a window and run until it is closed.

    Args:
        plants: one of each kind.
        geometries: the drawn form of each.
        advance: steps the scene and gives the frame to draw.
        camera: where the view begins; the window orbits round its target.
        ground: terrain heights.
        controls: where the sliders begin.
        title: of the window.
        extra_looks: that placements may wear instead of their plant's own.
        beds: blades of underbrush.

    Raises:
        GraphicsError: no display, no adapter, the ``view`` extra is not installed, or the card was lost.
    """
    require_display()
    try:
        from rendercanvas.glfw import RenderCanvas, loop
        from wgpu.utils.imgui import ImguiRenderer
    except ImportError as error:
        raise GraphicsError(f"the window needs: pip install 'windswept[view]' ({error})") from error
    device = shared_device()
    canvas = RenderCanvas(title=title, size=(1280, 720), update_mode="continuous", max_fps=60)
    context = canvas.get_wgpu_context()
    colour_format = context.get_preferred_format(device.adapter)
    usage = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_DST
    context.configure(device=device, format=colour_format, usage=usage)
    renderer = Renderer(
        plants, geometries, ground, canvas.get_physical_size(), None, colour_format, extra_looks, beds
    )
    panel = ImguiRenderer(device, canvas)
    view = _LiveView(renderer, advance, orbit_from(camera), controls or Controls())
    panel.set_gui(view.panel)
    canvas.add_event_handler(view.handle, "pointer_move", "wheel")

    failures: list[GraphicsError] = []

    def draw() -> None:
        try:
            with card_errors("drawing the window"):
                view.draw(canvas.get_physical_size())
                # The window's own texture is held as shortly as can be: to release it on a lost card ends the process.
                renderer.copy_into(context.get_current_texture())
                panel.render()
        except GraphicsError as error:
            failures.append(error)
            loop.stop()
            raise wgpu.DrawCancelled from error  # any other error would be logged, and the window drawn again

    canvas.request_draw(draw)
    loop.run()
    if failures:
        raise failures[0]


def require_display() -> None:
    """Refuse early: without a display the window library would abort the process."""
    names = ("DISPLAY", "WAYLAND_DISPLAY")
    if os.name == "posix" and os.uname().sysname == "Linux" and not any(os.environ.get(n) for n in names):
        raise GraphicsError(
            "no display: neither DISPLAY nor WAYLAND_DISPLAY is set; `windswept render` needs none"
        )


class _LiveView:
    """State of one window."""

    def __init__(self, renderer: Renderer, advance: Advance, orbit: Orbit, controls: Controls) -> None:
        self._renderer = renderer
        self._advance = advance
        self._orbit = orbit
        self._controls = controls
        self._last = perf_counter()
        self._frame_time = 0.0
        self._pointer: tuple[float, float] | None = None
        self._drawn: Told | None = None
        self._frames = 0
        self._stages = ""

    def draw(self, size: tuple[int, int]) -> None:
        """Advance the scene and draw it for a window of so many pixels."""
        now = perf_counter()
        passed, self._last = now - self._last, now
        self._frame_time += 0.1 * (passed - self._frame_time)
        if size != self._renderer.size:
            self._renderer.resize(size)
        step = 0.0 if self._controls.paused else min(passed, LONGEST_STEP)
        frame = self._advance(step, self._controls, self._orbit.camera(), self._renderer.size)
        self._drawn = self._renderer.draw_aside(frame)
        self._frames += 1
        if self._frames % STAGES_EVERY == 0:
            times = self._renderer.stage_milliseconds
            self._stages = ", ".join(f"{stage} {ms:.1f} ms" for stage, ms in times.items())

    def handle(self, event: dict[str, Any]) -> None:
        """Orbit on drag, zoom on scroll."""
        if event["event_type"] == "wheel":
            self._orbit = self._orbit.zoomed(ZOOM_PER_STEP ** event["dy"])
        elif 1 in event["buttons"]:
            x, y = event["x"], event["y"]
            before = self._pointer or (x, y)
            self._orbit = self._orbit.turned(
                TURN_PER_PIXEL * (x - before[0]), TURN_PER_PIXEL * (y - before[1])
            )
            self._pointer = (x, y)
            return
        self._pointer = None

    def panel(self) -> None:
        """Sliders and counters."""
        from imgui_bundle import imgui

        controls = self._controls
        imgui.set_next_window_pos((12.0, 12.0), imgui.Cond_.first_use_ever)
        imgui.begin("wind", None, imgui.WindowFlags_.always_auto_resize)
        _, controls.wind_speed = imgui.slider_float("m/s", controls.wind_speed, 0.0, STRONGEST_WIND)
        _, controls.wind_heading = imgui.slider_angle("towards", controls.wind_heading, -180.0, 180.0)
        _, controls.paused = imgui.checkbox("pause", controls.paused)
        imgui.text(self._counter_line())
        if self._stages:
            imgui.text(self._stages)
        if controls.counters:
            imgui.text(controls.counters)
        imgui.end()

    def _counter_line(self) -> str:
        if self._drawn is None:
            return ""
        rate = 1.0 / max(self._frame_time, 1e-6)
        drawn = self._drawn
        without_room = f", without room: {drawn.refused:,}" if drawn.refused else ""
        return (
            f"{rate:.0f} frames/s, plants: {drawn.placements:,}, "
            f"stem pieces: {drawn.pieces:,}, leaves: {drawn.leaves:,}{without_room}"
        )
