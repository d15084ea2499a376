"""A simulation on a card that is lost, or over its limits, ends in one clear line."""

from __future__ import annotations

import numpy as np
import pytest
import wgpu

from stands import both, stand_of
from windswept.errors import GraphicsError
from windswept.gpu import device as device_module
from windswept.gpu import failures, layouts
from windswept.gpu.springs import simulation as simulation_module
from windswept.gpu.springs.rung_arrays import rung_arrays


def test_a_card_lost_while_stepping(soft_trees, soft_ladders, monkeypatch):
    own = device_module._best_adapter().request_device_sync()
    monkeypatch.setattr(simulation_module, "shared_device", lambda: own)
    monkeypatch.setattr(failures.shared_device, "cache_clear", lambda: None, raising=False)
    _, card = both(stand_of(soft_trees, [2, 1]), soft_ladders, soft_trees)
    card.advance(0.1)
    own.destroy()
    with pytest.raises(GraphicsError, match="lost while stepping plants"):
        card.advance(0.1)
    with pytest.raises(GraphicsError, match="lost while posing plants"):
        card.motion()
    for told in ("wind_speeds", "levels_now", "placements_by_level", "stepped_count", "refused_count"):
        with pytest.raises(GraphicsError, match="lost while reading motion back"):
            getattr(card, told)
    with pytest.raises(GraphicsError, match="lost while posing plants"):
        assert card.pose


def test_more_kinds_than_the_shaders_tables_hold(soft_trees, soft_ladders):
    _, card = both(stand_of(soft_trees, [1, 1]), soft_ladders, soft_trees)
    with pytest.raises(GraphicsError, match=f"{layouts.KIND_LIMIT} kinds"):
        rung_arrays(card.kinds * (layouts.KIND_LIMIT // 2 + 1), 1 << 27)


def test_limits_of_the_device_hold_every_buffer(soft_trees, soft_ladders):
    _, card = both(stand_of(soft_trees, [3, 2]), soft_ladders, soft_trees)
    limit = device_module.shared_device().limits["max-storage-buffer-binding-size"]
    sizes = [item.size for item in card.card.resources.values() if isinstance(item, wgpu.GPUBuffer)]
    assert 0 < max(sizes) <= limit
    assert card.card.bytes == sum(sizes)
    assert np.dtype(layouts.RUNG).itemsize * layouts.RUNG_LIMIT <= 65536
