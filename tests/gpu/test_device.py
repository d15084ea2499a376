from __future__ import annotations

import pytest

from windswept.errors import GraphicsError
from windswept.gpu import device as device_module
from windswept.gpu import layouts
from windswept.gpu.buffers import GrowingBuffer


def test_the_adapter_has_a_line_of_its_own():
    assert len(device_module.adapter_summary().splitlines()) == 1


def test_no_adapter_names_the_line_that_mends_it(monkeypatch):
    device_module._best_adapter.cache_clear()
    monkeypatch.setattr(device_module.wgpu.gpu, "enumerate_adapters_sync", list)
    with pytest.raises(GraphicsError, match="mesa-vulkan-drivers"):
        device_module.adapter_summary()
    device_module._best_adapter.cache_clear()


def test_adapters_that_may_not_be_used_are_none(monkeypatch):
    def refuse(**_options):
        raise RuntimeError("No suitable adapter")

    device_module._best_adapter.cache_clear()
    monkeypatch.setattr(device_module.wgpu.gpu, "enumerate_adapters_sync", lambda: ["OpenGL"])
    monkeypatch.setattr(device_module.wgpu.gpu, "request_adapter_sync", refuse)
    with pytest.raises(GraphicsError, match="mesa-vulkan-drivers"):
        device_module.adapter_summary()
    device_module._best_adapter.cache_clear()


def test_more_than_a_buffer_takes_is_said_in_megabytes(device):
    store = GrowingBuffer(device, layouts.LINK_POSE)
    with pytest.raises(GraphicsError, match="MB"):
        store.reserve(device.limits["max-storage-buffer-binding-size"] // 16)
