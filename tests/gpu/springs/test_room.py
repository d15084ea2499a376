"""How much room every level gets on a card that has too little for all."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.errors import GraphicsError
from windswept.gpu.springs.room import BlockSize, room_for

SIZE = BlockSize(
    state=np.array([1000, 300, 4, 80]),
    stack=np.array([0, 50, 5, 20]),
    wind=np.array([40, 20, 2, 10]),
    carried=np.array([500, 0, 0, 0]),
    records=np.array([900, 0, 0, 0]),
    slots=np.array([100, 0, 0, 0]),
)
PLACEMENTS = np.array([500, 500, 500, 5])
COARSEST = np.array([False, False, True, True])


def needed(room: np.ndarray) -> np.ndarray:
    return 16 * (room[:, None] * SIZE.columns).sum(axis=0)


def test_where_all_fit_every_level_has_room_for_all_in_whole_blocks():
    assert room_for(SIZE, PLACEMENTS, COARSEST, 1 << 30).tolist() == [512, 512, 512, 8]


@pytest.mark.parametrize("limit", [100_000, 400_000, 3_000_000, 9_000_000])
def test_the_limit_holds_and_the_coarsest_levels_keep_their_room(limit):
    room = room_for(SIZE, PLACEMENTS, COARSEST, limit)
    assert (needed(room) <= limit).all()
    assert room[2] == 512
    assert room[3] == 8
    assert (room % np.array([64, 64, 64, 8]) == 0).all()
    # A level whose placements take less has room for more of them.
    assert room[1] >= room[0]


def test_more_room_is_never_less():
    rooms = [room_for(SIZE, PLACEMENTS, COARSEST, limit) for limit in np.geomspace(1e5, 2e7, 20).astype(int)]
    assert (np.diff(np.array(rooms), axis=0) >= 0).all()
    assert rooms[-1].tolist() == [512, 512, 512, 8]


def test_nothing_fits_without_the_coarsest_levels():
    with pytest.raises(GraphicsError, match="on the CPU"):
        room_for(SIZE, PLACEMENTS, COARSEST, 40_000)
