from __future__ import annotations

import pytest

from windswept.errors import GraphicsError
from windswept.gpu import device as device_module


def test_the_adapter_has_a_line_of_its_own():
    assert len(device_module.adapter_summary().splitlines()) == 1


def test_no_adapter_names_the_line_that_mends_it(monkeypatch):
    device_module._best_adapter.cache_clear()
    monkeypatch.setattr(device_module.wgpu.gpu, "enumerate_adapters_sync", list)
    with pytest.raises(GraphicsError, match="mesa-vulkan-drivers"):
        device_module.adapter_summary()
    device_module._best_adapter.cache_clear()
