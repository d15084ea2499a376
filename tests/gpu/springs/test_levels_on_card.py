"""Levels chosen, blended and packed on the card, beside the CPU's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from stands import blending, both, check_seats, come_near, eye_at, fly, gaps, kinds_of, stand_of
from windswept.errors import GraphicsError
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.levels import Eye, outside_view


def looking(y: float, way: float) -> Eye:
    """An eye that spares what it does not see."""
    ahead = np.array([np.sin(way), np.cos(way), 0.0], np.float32)
    return replace(eye_at(y), forward=ahead, measures=(outside_view,))


def test_levels_and_blends_are_those_of_the_cpu(soft_trees, soft_ladders):
    simulation, card = both(stand_of(soft_trees, [30, 21]), soft_ladders, soft_trees)
    way = -2.0 - 60.0 * (1.0 - np.cos(np.arange(100) * 3.0 / 16.0))
    changes, worst, before = 0, [], simulation.placements_by_level
    for _ in fly(simulation, card, way, seconds=0.1):
        for kind, levels in zip(simulation.kinds, card.levels_now, strict=True):
            assert np.array_equal(kind.at, levels)
        assert blending(card) == sum(len(kind.blends) for kind in simulation.kinds)
        assert card.stepped_count == simulation.stepped_count
        changes += simulation.placements_by_level != before
        before = simulation.placements_by_level
        worst.append(gaps(simulation, card).max())
    check_seats(card)
    assert card.refused_count == 0
    assert changes > 8
    # Who has just been merged differs most: both fit a group's pressure to its joints, the CPU in double precision. The
    # farthest link in the stand, over 10 s: 4e-7, 2.5e-5 and 4.5e-5 of the height.
    assert (np.quantile(worst, (0.5, 0.95, 1.0)) < (2e-6, 5e-5, 1e-4)).all()


def test_who_is_out_of_sight_is_spared_as_on_the_cpu(soft_trees, soft_ladders):
    simulation, card = both(stand_of(soft_trees, [30, 21]), soft_ladders, soft_trees)
    around = [looking(15.0, 0.7 * turn) for turn in range(9)]
    seen = set()
    for _ in fly(simulation, card, around, seconds=0.6):
        for kind, levels in zip(simulation.kinds, card.levels_now, strict=True):
            assert np.array_equal(kind.at, levels)
        seen.add(card.stepped_count)
    assert len(seen) > 2


def test_an_eye_that_jumps_leaves_no_seat_open(soft_trees, soft_ladders):
    scene = stand_of(soft_trees, [90, 40], depth=300.0)
    simulation, card = both(scene, soft_ladders, soft_trees)
    rng = np.random.default_rng(4)
    for _ in fly(simulation, card, rng.uniform(-400.0, 300.0, 12), seconds=0.3):
        check_seats(card)
        assert card.stepped_count == simulation.stepped_count
    assert np.isfinite(card.card.read("state", "<f4")).all()


def test_a_blend_neither_jumps_nor_stops(soft_trees, soft_ladders):
    _, card = both(stand_of(soft_trees, [9, 4]), soft_ladders, soft_trees)
    card.eye = eye_at(-1.0)
    card.advance(2.0)
    card.eye = eye_at(-80.0)
    track = []
    for _ in range(80):
        track.append(card.advance(1.0 / 120.0).pose[0].position)
    steps = np.abs(np.diff(np.array(track), axis=0)).max(axis=(1, 2))
    assert blending(card) == 0
    assert steps.min() > 0.0
    assert steps.max() < 0.02 * soft_trees[0].height


def test_who_finds_no_room_stays_and_is_counted(soft_trees, soft_ladders):
    simulation, full = both(stand_of(soft_trees, [200, 40]), soft_ladders, soft_trees)
    # Less than all would need at the finest level alone.
    room = 160 * 16 * soft_trees[0].link_count
    card = GpuSimulation(simulation.scene, full.kinds, picture_height=1080, room=room)
    rooms = card._arrays.rungs["room"][:, 3]
    assert rooms[0] < 200 <= rooms[len(soft_ladders[0].levels) - 1]
    come_near(card)


def test_too_little_room_is_said_at_once(soft_trees, soft_ladders):
    simulation, _ = both(stand_of(soft_trees, [3, 2]), soft_ladders, soft_trees)
    with pytest.raises(GraphicsError, match=r"needs .* MB .* on the CPU"):
        GpuSimulation(simulation.scene, kinds_of(simulation), room=1_000)
