"""A stand whose placements are chosen, posed and drawn on the card looks as it does when the CPU poses and lists it."""

from __future__ import annotations

import numpy as np
import pytest

from handmade import random_tree
from stands import SOFT, both, stand_of
from windswept.geometry.detail import DetailRules
from windswept.levels import build_ladder, simplify
from windswept.motion import build_model
from windswept.render.staging import frame_now, stage
from windswept.scene import moving_kind
from windswept.scene.camera import View

SIZE = (160, 96)
ROUNDING, LARGEST_SHARE = 8, 0.002
"""At most this share of pixels differs by more than so much of an 8-bit channel: a face's edge may fall on the other
side of a sample."""


@pytest.fixture
def stands(monkeypatch):
    # Levels cut for a single near plant are the CPU's alone.
    monkeypatch.setattr(moving_kind, "NEAR", 0.0)
    trees = [random_tree(seed, material=SOFT) for seed in (3, 5)]
    ladders = [build_ladder(simplify(build_model(tree))) for tree in trees]
    return both(stand_of(trees, [80, 40], depth=150.0), ladders, trees)


def test_near_far_and_out_of_sight(stands):
    simulation, card = stands
    renderer, expected = (stage(card, SIZE, DetailRules()) for _ in range(2))
    for seconds, eye, target in (
        (0.51, (2.0, -6.0, 2.0), (0.0, 20.0, 1.5)),
        (0.4, (0.0, 70.0, 6.0), (3.0, 90.0, 0.0)),
        (0.3, (0.0, 70.0, 2.0), (-3.0, 40.0, 4.0)),
    ):
        simulation.advance(seconds)
        card.advance(seconds)
        view = View(np.array(eye, np.float32), np.array(target, np.float32), 0.8)
        picture = renderer.draw(frame_now(card, view)).astype(int)
        wanted = expected.draw(frame_now(simulation, view)).astype(int)
        assert (np.abs(picture - wanted).max(axis=2) > ROUNDING).mean() < LARGEST_SHARE
        told = renderer._tally.now(0)
        assert 0 < told.placements <= 120
        assert told.wanted[0] < 0.8 * told.placements * max(k.model.link_count for k in card.kinds)
