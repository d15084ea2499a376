"""A card that is lost while pictures are drawn: every call says so in one line, and the next renderer has a new one."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import wgpu

from windswept.errors import GraphicsError
from windswept.gpu import device as device_module
from windswept.gpu import failures, renderer
from windswept.gpu.blades import Leaning
from windswept.gpu.renderer import Renderer

SIZE = (32, 32)
CALLS = {
    "draw": lambda lost, frame, texture: lost.draw(frame),
    "draw_aside": lambda lost, frame, texture: lost.draw_aside(frame),
    "copy_into": lambda lost, frame, texture: lost.copy_into(texture),
    "resize": lambda lost, frame, texture: lost.resize((16, 16)),
    "told_now": lambda lost, frame, texture: lost.told_now,
    "submitted": lambda lost, frame, texture: lost._tally.submitted(),
    "stage_milliseconds": lambda lost, frame, texture: lost.stage_milliseconds,
}


@pytest.fixture
def devices(monkeypatch):
    """Devices of this test's own: losing one leaves the other tests theirs."""
    own = cache(device_module.shared_device.__wrapped__)
    for module in (renderer, failures):
        monkeypatch.setattr(module, "shared_device", own)
    return own


def window_texture(device, size=SIZE):
    usage = wgpu.TextureUsage.COPY_DST | wgpu.TextureUsage.COPY_SRC
    return device.create_texture(size=(*size, 1), format=renderer.PICTURE_FORMAT, usage=usage)


def test_a_window_shows_what_was_drawn_as_far_as_it_reaches(stand, device):
    drawing = Renderer(stand.plants, stand.geometries, size=SIZE)
    expected = drawing.draw(stand.frame())
    width, height = SIZE[0] + 16, SIZE[1] - 8
    window = window_texture(device, (width, height))
    drawing.copy_into(window)
    shown = device.queue.read_texture({"texture": window}, {"bytes_per_row": 4 * width}, (width, height, 1))
    shown = np.frombuffer(shown, np.uint8).reshape(height, width, 4)
    assert (shown[:, : SIZE[0]] == expected[:height]).all()
    assert not shown[:, SIZE[0] :].any()


@pytest.mark.parametrize("call", CALLS)
def test_every_call_says_that_the_card_was_lost(stand, devices, call):
    lost = Renderer(stand.plants, stand.geometries, size=SIZE)
    lost.draw(stand.frame())
    texture = window_texture(devices())
    devices().destroy()
    if call == "stage_milliseconds" and not lost._times.works:
        pytest.skip("this card has no clock")
    with pytest.raises(GraphicsError, match="the graphics card was lost while"):
        CALLS[call](lost, stand.frame(), texture)


def test_the_next_renderer_has_a_new_card(stand, devices):
    lost = Renderer(stand.plants, stand.geometries, size=SIZE)
    expected = lost.draw(stand.frame())
    first = devices()
    first.destroy()
    with pytest.raises(GraphicsError, match="lost while drawing pictures"):
        Renderer(stand.plants, stand.geometries, size=SIZE)
    again = Renderer(stand.plants, stand.geometries, size=SIZE)
    assert again.canvas.device is not first
    assert (again.draw(stand.frame()) == expected).all()


def test_blades_on_a_lost_card(devices):
    device = devices()
    blades = Leaning(device, [])
    device.destroy()
    with pytest.raises(GraphicsError, match="lost while stepping blades"):
        blades.wait()
    with pytest.raises(GraphicsError, match="lost while reading leans"):
        assert blades.clamped_count
    with pytest.raises(GraphicsError, match="lost while stepping blades"):
        blades.write_air()


def test_a_read_that_the_loss_interrupts(devices):
    with pytest.raises(GraphicsError, match="lost while reading"), failures.card_errors("reading"):
        raise RuntimeError("Could not map buffer (4 : Device lost).")
    with pytest.raises(RuntimeError, match="bug"), failures.card_errors("reading"):
        raise RuntimeError("bug")
