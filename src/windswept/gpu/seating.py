"""Seating: where the poses of drawn placements go, and how many of each are needed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class Seating:
    """Buffers between whoever chooses what is drawn and whoever moves the plants."""

    seats: Any
    """Rows of four words: how many follow, 0, 0, 0; then placement, first pose, poses from rank 0 on, 0."""
    ranks: Any
    """(L, 2) words of every kind, kind after kind: link of each rank, rank of each link."""
    poses: Any
    """``LINK_POSE`` rows to be written."""
    dispatches: Any
    """Its first three words are workgroups of 64 seats along x, y and z."""
