"""A shortened run of the hour: nothing that the loop holds on to grows."""

from __future__ import annotations

from dataclasses import replace

import pytest

from handmade import random_tree
from stands import SOFT, stand_of
from windswept.gpu.springs.kinds import GrownKind
from windswept.levels import build_ladder, simplify
from windswept.motion import build_model
from windswept.studies.one_hour import aspen_in_grass, one_hour


@pytest.fixture(scope="module")
def rows() -> list[dict[str, float]]:
    tree = random_tree(3, material=SOFT)
    model = build_model(tree)
    trees, grass = stand_of([tree], [20]), aspen_in_grass(15.0)
    scene = replace(grass, kinds=trees.kinds, placements=trees.placements)
    kinds = [GrownKind(tree, model, build_ladder(simplify(model)), scene.placements[0])]
    return list(one_hour(scene, kinds, seconds=15.0, rate=20.0, size=(64, 48)))


def test_time_passes_in_whole_frames(rows):
    assert len(rows) == 10
    assert rows[-1]["simulated_s"] == pytest.approx(15.0)
    assert rows[-1]["steps"] == 1800
    assert rows[-1]["frames"] == 300


def test_neither_memory_nor_objects_grow(rows):
    warm, last = rows[1], rows[-1]
    assert last["card_objects"] == warm["card_objects"]
    # A frame's lists grow with what is in sight, by a quarter more than is needed.
    assert last["card_mb"] - warm["card_mb"] < 0.1
    assert last["resident_mb"] - warm["resident_mb"] < 2.0
