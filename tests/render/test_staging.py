"""A frame without read-back or upload of poses shows what the CPU's frame shows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import random_tree
from stands import SOFT, both, kinds_of, stand_of
from windswept.geometry.detail import DetailRules
from windswept.gpu.meadow.blade_list import BladeRules
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.levels import Eye, build_ladder, simplify
from windswept.motion import build_model
from windswept.render.staging import LevelLooks, frame_now, stage
from windswept.scene.camera import View
from windswept.scene.load_scene import build_scene
from windswept.scene.simulation import Simulation

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
        seen.append((from_card, renderer.stage_milliseconds, card.stage_milliseconds))
        expected = stage(card, SIZE, DetailRules()).draw(frame_now(simulation, view))
        # A face's edge may fall on the other side of a sample.
        far = np.abs(from_card.astype(int) - expected).max(axis=2) > 8
        assert far.mean() < 0.002
    assert (seen[0][0] != seen[1][0]).any(axis=2).mean() > 0.01


@pytest.fixture(scope="module")
def meadows():
    """Grass and a tree with a ball that rolls through, on the CPU and on the card."""
    stand = {
        "count": 60,
        "area": {"rectangle": [-1.0, -1.0, 1.0, 1.0]},
        "source": [{"source": name, "spacing_m": 0.1} for name in ("meadow_fescue", "oxeye_daisy")],
    }
    stops = [{"time_s": 0.0, "position": [-1.2, 0.0]}, {"time_s": 2.0, "position": [1.2, 0.0]}]
    ball = {"kind": "ball", "radius_m": 0.25, "stop": stops}
    field = {"area": [-1.5, -1.5, 1.5, 1.5], "cell_m": 0.1, "layer_m": 0.1, "height_m": 0.9, "agent": [ball]}
    data = {"stand": [stand], "field": field, "camera": {"eye": [0.5, -2.6, 1.0], "target": [0.0, 0.0, 0.2]}}
    tree = random_tree(3, material=SOFT)
    trees = stand_of([tree], [2])
    scene = replace(build_scene("m.toml", data), kinds=trees.kinds, placements=trees.placements)
    simulation = Simulation(scene, [tree], picture_height=SIZE[1])
    return simulation, GpuSimulation(scene, kinds_of(simulation), beds=simulation.meadow.beds)


def test_the_picture_of_a_meadow_is_that_of_the_cpu(meadows):
    simulation, card = meadows
    renderer, seen = stage(card, SIZE, DetailRules(), BladeRules()), []
    for seconds in (0.61, 0.5):
        from_card = renderer.draw(frame_now(card.advance(seconds)))
        expected = stage(simulation, SIZE, DetailRules(), BladeRules()).draw(
            frame_now(simulation.advance(seconds))
        )
        far = np.abs(from_card.astype(int) - expected).max(axis=2) > 8
        assert far.mean() < 0.002
        seen.append(from_card)
    changed = np.abs(seen[0].astype(int) - seen[1]).max(axis=2) > 20
    assert changed.mean() > 0.05, "the ball rolls on and the grass closes behind it"


def test_level_colours_are_sent_when_somebody_changes_and_then_no_more(stands):
    _, card = stands
    renderer, looks = stage(card, SIZE), LevelLooks()
    place = renderer.culling.place
    assert place(frame_now(card.advance(0.5), level_looks=looks).plants)
    worn = [posed.extra_look for posed in frame_now(card.advance(0.5), level_looks=looks).plants]
    assert not place(frame_now(card.advance(0.1), level_looks=looks).plants)
    card.eye = Eye(np.array([0.0, -3000.0, 2.0], np.float32), 0.8)
    assert place(frame_now(card.advance(1.0), level_looks=looks).plants)
    assert all((now != before).any() for now, before in zip(looks.of(card), worn, strict=True))
    card.eye = None


def test_blades_are_timed_as_well(meadows, device_has_clock):
    _, card = meadows
    renderer = stage(card, SIZE)
    renderer.draw(frame_now(card))
    named = set(renderer.stage_milliseconds) | set(card.stage_milliseconds)
    assert named >= {"wind", "simulate", "pose", "lean", "choose", "blades"} or not device_has_clock


def test_stages_are_timed_by_the_cards_own_clock(stands, device_has_clock):
    _, card = stands
    renderer = stage(card, SIZE)
    renderer.draw(frame_now(card.advance(0.1)))
    if device_has_clock:
        assert set(renderer.stage_milliseconds) == {"lawn", "cull", "curves", "shadows", "picture"}
        assert {"wind", "simulate", "pose"} <= set(card.stage_milliseconds)
    else:
        assert renderer.stage_milliseconds == card.stage_milliseconds == {}


@pytest.fixture
def device_has_clock() -> bool:
    from windswept.gpu.device import TIMESTAMPS, shared_device

    return TIMESTAMPS in shared_device().features
