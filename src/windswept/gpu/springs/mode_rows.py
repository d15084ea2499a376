"""mode_rows: the modes of every level as the card reads them, in the order in which its walk leaves the links."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.motion import Level
from windswept.motion.modal import MODE_COUNT, Modes, no_modes
from windswept.plants.plant import Ints

HEADER, ROWS_PER_LINK = 3 * MODE_COUNT, 3
"""Rows of ``modes`` that every level has, and every link that takes part: as in ``springs.wgsl``."""


def mode_rows(levels: list[Level]) -> NDArray[np.uint32]:
    """(n, 4) words: for each level where its rows begin and how many links take part; then those rows.

    A level's rows are the three matrices of ``Modes.gain``, row by row; and for every link its number, w, c and the
    inner step, and the modes' torques about its two axes. One that `multibody` moves has no links.
    """
    every = [no_modes() if level.coupled else level.modes for level in levels]
    links = np.array([len(modes.link) for modes in every], np.int64)
    size = HEADER + ROWS_PER_LINK * links
    table = np.zeros((len(levels), 4), np.uint32)
    table[:, 0], table[:, 1] = len(levels) + np.cumsum(size) - size, links
    return np.concatenate([table, *map(_rows_of, levels, every)])


def _rows_of(level: Level, modes: Modes) -> NDArray[np.uint32]:
    header = modes.gain.reshape(-1, MODE_COUNT).view(np.uint32)
    order = np.argsort(leaving(level.parent)[modes.link], kind="stable")
    rows = np.zeros((len(order), ROWS_PER_LINK, 4), np.uint32)
    rows[:, 0, 0] = modes.link[order]
    rows[:, 0, 1:3] = modes.own[order].view(np.uint32)
    rows[:, 0, 3] = np.float32(modes.time_step).view(np.uint32)
    rows[:, 1:] = np.ascontiguousarray(modes.torque[order], np.float32).view(np.uint32)
    return np.concatenate([header, rows.reshape(-1, 4)])


def leaving(parent: Ints) -> Ints:
    """(A,) when a walk from the root leaves every link: after its last descendant, children before parents."""
    last = np.arange(len(parent))
    for link in range(len(parent) - 1, 0, -1):
        if parent[link] >= 0:
            last[parent[link]] = max(last[parent[link]], last[link])
    rank = np.empty(len(parent), np.int32)
    rank[np.lexsort((-np.arange(len(parent)), last))] = np.arange(len(parent), dtype=np.int32)
    return rank
