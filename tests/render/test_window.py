"""What a window tells who steps its scene, without a display."""

from __future__ import annotations

from typing import Any

from windswept.gpu.culling import Told
from windswept.gpu.frame import Camera, Frame
from windswept.render.orbit import orbit_from
from windswept.render.window import Controls, _LiveView


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

    window: Any = _LiveView(Paper(), advance, orbit_from(camera), Controls())
    for size in ((64, 48), (300, 200)):
        window.draw(size)
    assert sizes == [(64, 48), (300, 200)]
