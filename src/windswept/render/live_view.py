"""LiveView: what is drawn frame by frame while somebody turns the camera and moves sliders."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import Any

from windswept.gpu.culling import Told
from windswept.gpu.frame import Camera, Frame
from windswept.gpu.renderer import Renderer
from windswept.render.orbit import Orbit

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


class LiveView:
    """State of one window, which may be there or not.

    Args:
        renderer: draws it.
        advance: steps the scene and gives the frame to draw.
        orbit: where the camera begins.
        controls: where the sliders begin.
        clock: tells seconds.
    """

    def __init__(
        self,
        renderer: Renderer,
        advance: Advance,
        orbit: Orbit,
        controls: Controls,
        clock: Callable[[], float] = perf_counter,
    ) -> None:
        self._renderer = renderer
        self._advance = advance
        self._orbit = orbit
        self._controls = controls
        self._clock, self._last = clock, clock()
        self._frame_time = 0.0
        self._pointer: tuple[float, float] | None = None
        self._drawn: Told | None = None
        self._frames = 0
        self._stages = ""

    def draw(self, size: tuple[int, int]) -> None:
        """Advance the scene and draw it for a window of so many pixels."""
        now = self._clock()
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
        for line in self.lines():
            imgui.text(line)
        imgui.end()

    def lines(self) -> list[str]:
        """What stands below the sliders."""
        lines = [self._drawn_line(self._drawn)] if self._drawn else []
        return lines + [line for line in (self._stages, self._controls.counters) if line]

    def _drawn_line(self, drawn: Told) -> str:
        rate = 1.0 / max(self._frame_time, 1e-6)
        without_room = f", without room: {drawn.refused:,}" if drawn.refused else ""
        return (
            f"{rate:.0f} frames/s, plants: {drawn.placements:,}, "
            f"stem pieces: {drawn.pieces:,}, leaves: {drawn.leaves:,}{without_room}"
        )
