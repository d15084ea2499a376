"""A card that is lost or full is said in one line; whatever else goes wrong stays the bug that it is."""

from __future__ import annotations

import numpy as np
import pytest
import wgpu

from windswept.errors import GraphicsError
from windswept.gpu import device as device_module
from windswept.gpu import failures, layouts
from windswept.gpu.buffers import STORAGE, GrowingBuffer, room
from windswept.gpu.failures import card_errors


class Forgetful:
    """Stands in for ``shared_device``, so that the tests' own device is not forgotten."""

    forgotten = 0

    def cache_clear(self) -> None:
        self.forgotten += 1


@pytest.fixture
def forgetful(monkeypatch) -> Forgetful:
    one = Forgetful()
    monkeypatch.setattr(failures, "shared_device", one)
    return one


@pytest.fixture
def lost():
    device = device_module._best_adapter().request_device_sync()
    buffer = device.create_buffer(size=64, usage=STORAGE)
    device.destroy()
    return device, buffer


def test_a_lost_card_is_said_and_forgotten(lost, forgetful):
    device, buffer = lost
    said = r"was lost while stepping plants: simulate .* on the CPU"
    with pytest.raises(GraphicsError, match=said), card_errors("stepping plants"):
        device.queue.write_buffer(buffer, 0, np.zeros(4, np.float32))
    assert forgetful.forgotten == 1


def test_a_new_buffer_on_a_lost_card(lost, forgetful):
    with pytest.raises(GraphicsError, match="lost"):
        room(lost[0], layouts.ROW, 4)


def test_too_little_memory_is_said(device, monkeypatch, forgetful):
    def full(**_asked):
        raise wgpu.GPUOutOfMemoryError("Out of Memory")

    store = GrowingBuffer(device, layouts.LINK_POSE)
    monkeypatch.setattr(device, "create_buffer", full)
    with pytest.raises(GraphicsError, match="too little memory for the parts of a frame"):
        store.reserve(10_000)
    with pytest.raises(GraphicsError, match="too little memory"):
        room(device, layouts.ROW, 10)
    assert forgetful.forgotten == 0


def test_more_than_a_binding_takes_is_said_before_it_is_asked_for(device):
    with pytest.raises(GraphicsError, match="MB are needed in one buffer"):
        room(device, layouts.ROW, device.limits["max-storage-buffer-binding-size"] // 16 + 1)


def test_a_bug_stays_a_bug(device):
    with pytest.raises(wgpu.GPUValidationError), card_errors("stepping plants"):
        device.create_shader_module(code="fn broken(")
