"""Between ``CoupledState``, eight placements to a tile, and the card's rows, a block of lanes after another."""

from __future__ import annotations

import numpy as np

from windswept.motion.lanes import WIDTH
from windswept.motion.multibody import CoupledState
from windswept.plants.plant import Floats


def lane_rows(tiles: Floats, lanes: int, room: int) -> Floats:
    """(room / lanes, n, lanes) numbers of placements in blocks.

    Args:
        tiles: (T, n, WIDTH) numbers of placements in tiles.
        lanes: of a block.
        room: slots of all blocks together; those beyond the tiles are zero.
    """
    numbers = tiles.shape[1]
    placements = np.zeros((room, numbers), np.float32)
    given = tiles.transpose(0, 2, 1).reshape(-1, numbers)[:room]
    placements[: len(given)] = given
    return np.ascontiguousarray(placements.reshape(-1, lanes, numbers).transpose(0, 2, 1))


def tile_rows(blocks: Floats, placements: int) -> Floats:
    """(T, n, WIDTH) numbers of placements in tiles, from (K, n, lanes) in blocks."""
    numbers = blocks.shape[1]
    tiles = -(-placements // WIDTH)
    given = blocks.transpose(0, 2, 1).reshape(-1, numbers)[:placements]
    padded = np.zeros((tiles * WIDTH, numbers), np.float32)
    padded[: len(given)] = given
    return np.ascontiguousarray(padded.reshape(tiles, WIDTH, numbers).transpose(0, 2, 1))


def card_rows(state: CoupledState, lanes: int, room: int) -> tuple[Floats, Floats]:
    """Rows of joints (blocks, L, lanes, 4) and of carried velocities (blocks, L, 2, lanes, 4) of one kind.

    Args:
        state: of the kind.
        lanes: of a block.
        room: slots of all blocks together.
    """
    tiles, links = state.joints.shape[:2]
    joints = lane_rows(state.joints.reshape(tiles, -1, WIDTH), lanes, room)
    joints = joints.reshape(-1, links, 4, lanes).transpose(0, 1, 3, 2)
    carried = lane_rows(state.carried.reshape(tiles, -1, WIDTH), lanes, room)
    carried = carried.reshape(-1, links, 2, 3, lanes).transpose(0, 1, 2, 4, 3)
    return np.ascontiguousarray(joints), np.pad(carried, [(0, 0)] * 4 + [(0, 1)])


def state_of_rows(joints: Floats, carried: Floats, placements: int, step_count: int) -> CoupledState:
    """The state of one kind from its rows, as ``card_rows`` gives them."""
    blocks, links, lanes, _ = joints.shape
    flat = joints.transpose(0, 1, 3, 2).reshape(blocks, -1, lanes)
    moved = carried[..., :3].transpose(0, 1, 2, 4, 3).reshape(blocks, -1, lanes)
    tiles = -(-placements // WIDTH)
    return CoupledState(
        tile_rows(flat, placements).reshape(tiles, links, 4, WIDTH),
        np.zeros((tiles, 0, 6, WIDTH), np.float32),
        placements,
        step_count,
        tile_rows(moved, placements).reshape(tiles, links, 6, WIDTH),
    )
