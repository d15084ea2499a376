"""Plants near the camera, cut branch by branch."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import build_plant, straight
from windswept.levels import (
    Eye,
    Ladder,
    away_from,
    build_ladder,
    measured_ladder,
    near_cut,
    node_balls,
    outside_view,
    seen_distance,
    simplify,
)
from windswept.levels.near_cut import node_tolerance
from windswept.motion import build_model
from windswept.plants.sources import grow_source
from windswept.plants.weber_penn import grow


@pytest.fixture(scope="module")
def oak() -> Ladder:
    return build_ladder(simplify(build_model(grow("california_black_oak", 1))))


def eye(*position: float, tolerance: float = 1.0) -> Eye:
    return Eye(np.array(position, np.float32), float(np.radians(60.0)), tolerance=tolerance)


def test_balls_hold_what_their_nodes_move(oak: Ladder) -> None:
    hierarchy, balls = oak.hierarchy, node_balls(oak.hierarchy)
    skeleton = hierarchy.model.skeleton
    tip = skeleton.base + skeleton.vector
    rng = np.random.default_rng(0)
    for node in rng.integers(0, len(hierarchy.first), 200).tolist():
        inside = slice(hierarchy.first[node], hierarchy.stop[node])
        away = np.linalg.norm(tip[inside] - balls.centre[node], axis=1)
        assert away.max() <= balls.radius[node] * (1.0 + 1e-9) + 1e-9


def test_the_near_side_is_finer_than_the_far_side(oak: Ladder) -> None:
    skeleton = oak.hierarchy.model.skeleton
    height = skeleton.base[:, 2].max()
    looker = eye(-4.0, 0.0, 0.6 * height, tolerance=4.0)
    level = near_cut(oak, node_balls(oak.hierarchy), looker, looker.position)
    middle = skeleton.base + 0.5 * skeleton.vector
    own = np.zeros(len(middle), bool)
    own[level.link] = True
    near, far = middle[:, 0] < -1.0, middle[:, 0] > 1.0
    assert near.sum() > 1000
    assert far.sum() > 1000
    assert own[near].mean() > 1.3 * own[far].mean()
    assert level.group_count > 0
    assert level.link_count + level.group_count < oak.oscillators[0]


def test_tolerance_follows_the_stated_errors(oak: Ladder) -> None:
    metres = np.geomspace(1e-6, 10.0, 50)
    tolerance = node_tolerance(oak, metres)
    assert (np.diff(tolerance) >= 0.0).all()
    assert (tolerance[metres < oak.error[1]] < 0.0).all()
    cuts = slice(2, len(oak.levels) - 2)
    distinct = np.diff(oak.error[1 : len(oak.levels) - 2], prepend=0.0)[1:] > 0.0
    exact = node_tolerance(oak, oak.error[cuts])
    assert exact[distinct] == pytest.approx(oak.tolerance[cuts][distinct], rel=1e-6)


def test_coupled_links_are_cut_by_the_errors_of_coupled_levels() -> None:
    ladder = measured_ladder(
        build_ladder(simplify(build_model(grow_source("flowering_herb"))), multibody=True)
    )
    merged = ladder.merged(coupled=True)
    assert len(merged) > 0
    assert set(merged).isdisjoint(ladder.merged(coupled=False))
    looker = eye(0.0, -2.0, 1.0, tolerance=2.0)
    levels = [
        near_cut(ladder, node_balls(ladder.hierarchy), looker, looker.position, c) for c in (True, False)
    ]
    assert [level.coupled for level in levels] == [True, False]
    assert 0 < levels[0].group_count < levels[0].link_count < ladder.hierarchy.model.link_count


def test_what_cannot_be_seen_counts_as_farther() -> None:
    looker = replace(eye(0.0, 0.0, 2.0), forward=np.array([0.0, 1.0, 0.0], np.float32))
    places = np.array([[0.0, 30.0, 0.0], [0.0, -30.0, 0.0], [60.0, -20.0, 0.0], [0.0, -3.0, 0.0]], np.float32)
    plain = seen_distance(looker, places, 5.0)
    spared = seen_distance(replace(looker, measures=(outside_view,)), places, 5.0)
    assert (spared / plain).tolist() == [1.0, 4.0, 4.0, 1.0]


def test_what_is_away_from_the_subject_counts_as_farther() -> None:
    looker = eye(0.0, 0.0, 2.0)
    places = np.array([[0.0, 30.0, 0.0], [0.0, 130.0, 0.0]], np.float32)
    measure = away_from(np.array([0.0, 30.0, 0.0], np.float32), 20.0)
    factor = seen_distance(replace(looker, measures=(measure,)), places, 5.0) / seen_distance(
        looker, places, 5.0
    )
    assert factor == pytest.approx([1.0, 95.0 / 20.0])


def test_a_trembling_view_changes_no_distance_by_more_than_the_dead_band() -> None:
    azimuth = np.linspace(0.0, np.pi, 2000)
    places = 40.0 * np.column_stack([np.sin(azimuth), np.cos(azimuth), 0.0 * azimuth]).astype(np.float32)
    looker = replace(eye(0.0, 0.0, 2.0), measures=(outside_view,))
    seen = [
        seen_distance(replace(looker, forward=np.array([np.sin(turn), np.cos(turn), 0.0])), places, 5.0)
        for turn in (0.0, np.radians(0.4))
    ]
    assert np.abs(seen[1] / seen[0] - 1.0).max() < looker.dead_band
    assert seen[0].max() > 3.9 * seen[0].min()


def test_plants_of_one_and_two_links_have_a_ladder_down_to_still() -> None:
    for count in (1, 2):
        plant = build_plant(straight(1.0, count, 0.01))
        ladder = build_ladder(simplify(build_model(plant)))
        assert ladder.oscillators == [count, 1, 1, 1]
        looker = eye(0.0, -2.0, 0.5)
        level = near_cut(ladder, node_balls(ladder.hierarchy), looker, looker.position)
        assert 1 <= level.link_count + level.group_count <= count
