"""A frame without read-back or upload of poses shows what the CPU's frame shows."""

from __future__ import annotations

import numpy as np
import pytest

from handmade import random_tree
from stands import SOFT, both, stand_of
from windswept.geometry.detail import DetailRules
from windswept.levels import build_ladder, simplify
from windswept.motion import build_model
from windswept.render.staging import frame_now, stage
from windswept.scene.camera import View

SIZE = (160, 96)


@pytest.fixture(scope="module")
def stands():
    trees = [random_tree(seed, material=SOFT) for seed in (3, 5)]
    ladders = [build_ladder(simplify(build_model(tree))) for tree in trees]
    return both(stand_of(trees, [3, 2], depth=6.0), ladders, trees)


def test_the_picture_is_that_of_the_cpu(stands):
    simulation, card = stands
    renderer = stage(card, SIZE, DetailRules())
    view = View(np.array([2.0, -6.0, 2.0], np.float32), np.array([0.0, 2.0, 1.5], np.float32), 0.8)
    seen = []
    for seconds in (0.51, 1.2):
        simulation.advance(seconds)
        card.advance(seconds)
        from_card = renderer.draw(frame_now(card, view))
        assert renderer.posing.links.buffer.size < 64 * 32 + 1
        seen.append((from_card, renderer.stage_milliseconds, card.stage_milliseconds))
        expected = stage(card, SIZE, DetailRules()).draw(frame_now(simulation, view))
        # A face's edge may fall on the other side of a sample.
        far = np.abs(from_card.astype(int) - expected).max(axis=2) > 8
        assert far.mean() < 0.002
    assert (seen[0][0] != seen[1][0]).any(axis=2).mean() > 0.01


def test_stages_are_timed_by_the_cards_own_clock(stands, device_has_clock):
    _, card = stands
    renderer = stage(card, SIZE)
    renderer.draw(frame_now(card.advance(0.1)))
    if device_has_clock:
        assert set(renderer.stage_milliseconds) == {"curves", "shadows", "picture"}
        assert {"wind", "simulate", "pose"} <= set(card.stage_milliseconds)
    else:
        assert renderer.stage_milliseconds == card.stage_milliseconds == {}


@pytest.fixture
def device_has_clock() -> bool:
    from windswept.gpu.device import TIMESTAMPS, shared_device

    return TIMESTAMPS in shared_device().features
