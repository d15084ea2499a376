"""Where notes have room for few, placements change their level in turn, and all arrive."""

from __future__ import annotations

import numpy as np
import pytest

from stands import both, stand_of
from windswept.gpu.springs import room
from windswept.gpu.springs.room import NOTES, joins_for
from windswept.levels import Eye
from windswept.scene.moving_kind import BLEND_TIME

FAR_OFF = Eye(np.array([0.0, -400.0, 2.0], np.float32), float(np.radians(60.0)), 1080)


@pytest.mark.parametrize(
    ("placements", "expected"), [(10, (10, 10)), (100, (100, 100)), (101, (25, 100)), (9_999, (25, 100))]
)
def test_all_join_at_once_where_their_notes_fit(placements, expected):
    assert joins_for(placements, longest=50, rungs=4, limit=100 * 50 * NOTES) == expected


def test_somebody_joins_however_little_room_there_is():
    assert joins_for(1_000, longest=50, rungs=8, limit=50 * NOTES) == (1, 8)
    assert joins_for(3, longest=50, rungs=8, limit=50 * NOTES) == (1, 3)


def test_a_crowd_changes_its_level_in_turn(soft_trees, soft_ladders, monkeypatch):
    links = max(tree.link_count for tree in soft_trees)
    monkeypatch.setattr(room, "NOTE_BYTES", 60 * NOTES * links)
    simulation, card = both(stand_of(soft_trees, [90, 40]), soft_ladders, soft_trees)
    each = card._arrays.joins_each
    assert 0 < each < 10
    assert card.card.resources["notes"].size == card._arrays.joins_together * links * NOTES
    simulation.eye = card.eye = FAR_OFF
    for _ in range(60):
        before = np.concatenate(card.levels_now)
        after = np.concatenate(card.advance(4 / 120).levels_now)
        joined = np.bincount(after[before != after], minlength=1)
        assert joined.max() <= 2 * each
        simulation.advance(4 / 120)
    card.advance(2 * BLEND_TIME)
    simulation.advance(2 * BLEND_TIME)
    for kind, levels in zip(simulation.kinds, card.levels_now, strict=True):
        assert np.array_equal(kind.at, levels)
    assert card.refused_count == 0
    assert np.isfinite(card.card.read("state", "<f4")).all()
