"""What the window asks for at every frame, without a window."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from windswept.cli.view import view_scene
from windswept.errors import GraphicsError
from windswept.gpu.frame import Camera
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.render import window
from windswept.render.live_scene import LiveScene
from windswept.render.live_view import Controls
from windswept.scene.load_scene import build_scene, load_scene
from windswept.scene.scene import Scene
from windswept.scene.simulation import Simulation

SIZE = (960, 640)


def opened(scene: Scene, gpu: bool, monkeypatch: pytest.MonkeyPatch, losses: int = 0) -> list[LiveScene]:
    """The scenes that windows open on, the first of which lose their card."""
    shown: list[LiveScene] = []

    def show(live: LiveScene, *_begin: Any) -> None:
        shown.append(live)
        if len(shown) <= losses:
            raise GraphicsError("the graphics card was lost")

    monkeypatch.setattr(window, "require_window", lambda: None)
    monkeypatch.setattr(window, "show_window", show)
    view_scene(scene, gpu=gpu)
    return shown


@pytest.mark.parametrize("gpu", [False, True])
def test_a_frame_follows_the_sliders_and_the_camera(gpu: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    advance = opened(load_scene("hazel", 1), gpu, monkeypatch)[0].advance
    controls = Controls(wind_speed=9.0, wind_heading=1.0)
    camera = Camera((1.0, -9.0, 2.0), (0.0, 0.0, 1.5))
    frame = advance(0.1, controls, camera, SIZE)
    assert frame.camera == camera
    assert frame.time == pytest.approx(0.1)
    assert np.hypot(*frame.wind) == pytest.approx(9.0)
    assert "links stepped" in controls.counters
    assert (frame.motion is not None) == gpu
    assert (frame.plants[0].link is None) == gpu


def test_who_stays_at_a_level_for_want_of_room_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    advance = opened(load_scene("hazel", 1), True, monkeypatch)[0].advance
    monkeypatch.setattr(GpuSimulation, "refused_count", 1234)
    controls = Controls()
    advance(0.1, controls, Camera((1.0, -9.0, 2.0), (0.0, 0.0, 1.5)), SIZE)
    assert "1,234 plants without room for another level" in controls.counters


@pytest.mark.parametrize("gpu", [False, True])
def test_levels_are_chosen_for_what_the_window_shows(gpu: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    advance = opened(load_scene("hazel", 1), gpu, monkeypatch)[0].advance
    monkeypatch.setattr("windswept.render.live_scene.COUNT_EVERY", 1)

    def stepped(target: float, size: tuple[int, int]) -> int:
        """Links once the plant, 24 m away, has gone to its level."""
        controls = Controls()
        for _ in range(2):
            advance(1.0, controls, Camera((0.0, -24.0, 1.5), (0.0, target, 1.5)), size)
        return int(controls.counters.split()[0].replace(",", ""))

    ahead = stepped(0.0, SIZE)
    assert stepped(-48.0, SIZE) < 0.9 * ahead, "behind the viewer"
    assert stepped(0.0, (SIZE[0] // 4, SIZE[1] // 4)) < 0.9 * ahead, "in a small window"
    assert stepped(0.0, SIZE) == ahead


@pytest.mark.parametrize("gpu", [False, True])
def test_underbrush_is_in_the_window(gpu: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    plant = {"source": "common_poppy", "position": [0.0, 0.0]}
    camera = {"eye": [0.0, -1.5, 0.6], "target": [0.0, 0.0, 0.3]}
    live = opened(build_scene("tuft.toml", {"plant": [plant], "camera": camera}), gpu, monkeypatch)[0]
    frame = live.advance(0.1, Controls(), Camera((1.0, -2.0, 1.0), (0.0, 0.0, 0.2)), SIZE)
    assert live.simulation.meadow is not None
    assert [bed.source for bed in live.simulation.meadow.beds] == ["common_poppy"]
    assert (frame.meadow.leans is not None) == gpu
    assert (len(frame.meadow.lanes) == 0) == gpu


def test_a_window_whose_card_is_lost_opens_again_on_the_cpu(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    lost, again = opened(load_scene("hazel", 1), True, monkeypatch, losses=1)
    assert isinstance(lost.simulation, GpuSimulation)
    assert isinstance(again.simulation, Simulation)
    assert again.simulation.kinds[0].plant is lost.simulation.kinds[0].plant
    assert "windswept: the graphics card was lost; starting again on the CPU\n" in capsys.readouterr().err


@pytest.mark.parametrize(("gpu", "losses"), [(False, 1), (True, 2)])
def test_a_card_lost_under_the_cpus_own_window_ends_the_command(
    gpu: bool, losses: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(GraphicsError, match="was lost"):
        opened(load_scene("hazel", 1), gpu, monkeypatch, losses)
