"""A card that is lost while pictures are drawn: every call says so in one line, and the next renderer has a new one."""

from __future__ import annotations

from functools import cache

import pytest

from windswept.errors import GraphicsError
from windswept.gpu import device as device_module
from windswept.gpu import failures, renderer
from windswept.gpu.blades import Leaning
from windswept.gpu.renderer import Renderer

SIZE = (32, 32)
CALLS = {
    "draw": lambda lost, frame, view: lost.draw(frame),
    "draw_aside": lambda lost, frame, view: lost.draw_aside(frame),
    "draw_into": lambda lost, frame, view: lost.draw_into(view, frame),
    "resize": lambda lost, frame, view: lost.resize((16, 16)),
    "told_now": lambda lost, frame, view: lost.told_now,
    "submitted": lambda lost, frame, view: lost._tally.submitted(),
    "stage_milliseconds": lambda lost, frame, view: lost.stage_milliseconds,
}


@pytest.fixture
def devices(monkeypatch):
    """Devices of this test's own: losing one leaves the other tests theirs."""
    own = cache(device_module.shared_device.__wrapped__)
    for module in (renderer, failures):
        monkeypatch.setattr(module, "shared_device", own)
    return own


@pytest.mark.parametrize("call", CALLS)
def test_every_call_says_that_the_card_was_lost(stand, devices, call):
    lost = Renderer(stand.plants, stand.geometries, size=SIZE)
    lost.draw(stand.frame())
    view = lost._picture.create_view()
    devices().destroy()
    if call == "stage_milliseconds" and not lost._times.works:
        pytest.skip("this card has no clock")
    with pytest.raises(GraphicsError, match="the graphics card was lost while"):
        CALLS[call](lost, stand.frame(), view)


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
