"""What a window tells who steps its scene, without a window."""

from __future__ import annotations

from typing import Any

from windswept.gpu.culling import Told
from windswept.gpu.frame import Camera, Frame
from windswept.render.live_view import LONGEST_STEP, Controls, LiveView
from windswept.render.orbit import orbit_from


class Paper:
    """A renderer that draws nothing."""

    size = (64, 48)

    def resize(self, size: tuple[int, int]) -> None:
        self.size = size

    def draw_aside(self, _frame: Frame) -> Told:
        return Told((0, 0, 0, 0), 0, 0, 0, 0)


def test_who_steps_the_scene_learns_the_windows_size_as_it_is_now() -> None:
    camera, sizes = Camera((0.0, -9.0, 2.0), (0.0, 0.0, 1.5)), []

    def advance(_seconds: float, _controls: Controls, seen_from: Camera, size: tuple[int, int]) -> Frame:
        sizes.append(size)
        return Frame((), seen_from)

    window: Any = LiveView(Paper(), advance, orbit_from(camera), Controls())
    for size in ((64, 48), (300, 200)):
        window.draw(size)
    assert sizes == [(64, 48), (300, 200)]


def test_time_passes_by_the_clock_but_not_through_a_stall_nor_a_pause() -> None:
    camera, passed = Camera((0.0, -9.0, 2.0), (0.0, 0.0, 1.5)), []
    clock = iter((0.0, 0.02, 3.0, 3.05))

    def advance(seconds: float, controls: Controls, seen_from: Camera, _size: tuple[int, int]) -> Frame:
        passed.append(seconds)
        controls.paused = len(passed) == 2
        return Frame((), seen_from)

    paper: Any = Paper()
    view = LiveView(paper, advance, orbit_from(camera), Controls(), clock=lambda: next(clock))
    for _ in range(3):
        view.draw((64, 48))
    assert passed == [0.02, LONGEST_STEP, 0.0]
    assert view.lines() == ["4 frames/s, plants: 0, stem pieces: 0, leaves: 0"]
