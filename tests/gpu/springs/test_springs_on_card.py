"""Parity of the motion at every level, and what holds of it whatever the card."""

from __future__ import annotations

import numpy as np

from stands import both, gaps, only, stand_of
from windswept.gpu.springs.rows import links_that_end


def test_ten_gusty_seconds_at_every_level(soft_trees, soft_ladders):
    tree, ladder = soft_trees[0], soft_ladders[0]
    count = len(ladder.levels)
    ladders = [only(ladder, place) for place in range(count)]
    simulation, card = both(stand_of([tree] * count, [2] * count), ladders, [tree] * count)
    worst, far = np.zeros(count), np.zeros(count)
    for _ in range(10):
        worst = np.maximum(worst, gaps(simulation.advance(1.0), card.advance(1.0)))
        rest = tree.link_base
        far = np.maximum(far, [np.abs(pose.position - rest).max() for pose in simulation.pose])
    assert [set(levels.tolist()) for levels in card.levels_now] == [{k} for k in range(count)]
    assert far[:-1].min() > 0.02 * tree.height
    assert far[-1] < 1e-6
    # Single precision, added up in another order; asked are 1e-3.
    assert worst.max() < 5e-6


def test_rotations_agree_between_two_steps(soft_trees, soft_ladders):
    simulation, card = both(stand_of(soft_trees, [3, 2]), soft_ladders, soft_trees)
    for seconds in (1.003, 0.0041, 0.5):
        simulation.advance(seconds)
        card.advance(seconds)
        for theirs, ours in zip(simulation.pose, card.pose, strict=True):
            np.testing.assert_allclose(ours.rotation, theirs.rotation, atol=5e-6)
        assert gaps(simulation, card).max() < 5e-6


def test_frame_rate_does_not_matter(soft_trees, soft_ladders):
    ends = []
    for rate in (30, 144):
        card = both(stand_of(soft_trees, [5, 4]), soft_ladders, soft_trees)[1]
        for _ in range(rate):
            card.advance(1.0 / rate)
        ends.append((card.step_count, card.card.read("state", "<f4")))
    assert ends[0][0] == ends[1][0] == 120
    assert np.array_equal(ends[0][1], ends[1][1])


def test_more_placements_than_a_block_holds(soft_trees, soft_ladders):
    ladders = [only(ladder, 1) for ladder in soft_ladders]
    simulation, card = both(stand_of(soft_trees, [130, 1]), ladders, soft_trees)
    assert gaps(simulation.advance(1.0), card.advance(1.0)).max() < 5e-6


def test_links_that_end_are_counted_at_their_last_descendant():
    #        0 - 1 - 2 - 3
    #            |   4
    #            5 - 6
    depth = np.array([0, 1, 2, 3, 3, 2, 3], np.int32)
    assert links_that_end(depth).tolist() == [0, 0, 0, 1, 2, 0, 4]
    assert links_that_end(np.array([0, 0, 1], np.int32)).tolist() == [1, 0, 2]
