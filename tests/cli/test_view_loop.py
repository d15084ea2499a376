"""What the window asks for at every frame, without a window."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from windswept.cli.view import view_scene
from windswept.gpu.frame import Camera
from windswept.render import window
from windswept.scene.load_scene import load_scene


@pytest.mark.parametrize("gpu", [False, True])
def test_a_frame_follows_the_sliders_and_the_camera(gpu: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    monkeypatch.setattr(window, "require_display", lambda: None)
    monkeypatch.setattr(window, "show_window", lambda *arguments: asked.extend(arguments))
    view_scene(load_scene("hazel", 1), gpu=gpu)
    advance = asked[2]
    controls = window.Controls(wind_speed=9.0, wind_heading=1.0)
    camera = Camera((1.0, -9.0, 2.0), (0.0, 0.0, 1.5))
    frame = advance(0.1, controls, camera)
    assert frame.camera == camera
    assert frame.time == pytest.approx(0.1)
    assert np.hypot(*frame.wind) == pytest.approx(9.0)
    assert "links stepped" in controls.counters
    assert (frame.motion is not None) == gpu
    assert (frame.plants[0].link is None) == gpu
