"""Kinds and placements as the choice of what is drawn reads them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.gpu import layouts
from windswept.gpu.culling.layouts import DRAWN_KIND, STANDING
from windswept.gpu.draw_list import looks_of, phases
from windswept.gpu.frame import PosedPlants
from windswept.gpu.plant_buffers import Kind

Rows = NDArray[np.void]


def standing_rows(plants: tuple[PosedPlants, ...]) -> Rows:
    """(P,) ``STANDING``, kind after kind."""
    rows = [np.zeros(0, STANDING)]
    for number, posed in enumerate(plants):
        own = np.zeros(len(posed.position), STANDING)
        own["position"][:, :3] = posed.position
        own["position"][:, 3] = np.cos(posed.yaw)
        own["turn"][:, 0] = np.sin(posed.yaw)
        own["turn"][:, 1] = phases(len(own), number)
        own["rows"][:, 0] = number
        own["rows"][:, 1] = looks_of(posed, number, len(plants))
        rows.append(own)
    return np.concatenate(rows)


def kind_rows(kinds: tuple[Kind, ...]) -> tuple[Rows, NDArray[np.uint32]]:
    """(K,) ``DRAWN_KIND``, and ``prefixes``: of each kind its pieces in drawing order, then its leaves.

    A row of ``prefixes`` has the bits of a piece's size, and the link poses and shifted stems that are needed up to
    it; before the first piece and the first leaf of a kind stands a row of none, and leaves take whole runs.
    """
    rows = np.zeros(len(kinds), DRAWN_KIND)
    prefixes: list[NDArray[np.uint32]] = []
    first = 0
    for row, kind in zip(rows, kinds, strict=True):
        pieces = np.zeros((len(kind.pose.piece_reach), 4), np.uint32)
        pieces[1:, 0] = kind.order.piece_size.astype(np.float32).view(np.uint32)
        pieces[:, 1:3] = kind.pose.piece_reach
        leaves = np.zeros((len(kind.pose.leaf_reach), 4), np.uint32)
        leaves[:, 1:3] = kind.pose.leaf_reach
        row["ball"] = *kind.centre, kind.radius
        row["leaf"][0] = kind.order.leaf_length
        row["first"] = kind.stem_first, kind.piece_first, kind.leaf_first, first + len(pieces)
        row["counts"] = len(pieces) - 1, len(kind.order.leaf_order), first, 0
        prefixes += [pieces, leaves]
        first += len(pieces) + len(leaves)
    return rows, np.concatenate([np.zeros((0, 4), np.uint32), *prefixes])


def rank_rows(kinds: tuple[Kind, ...]) -> NDArray[np.uint32]:
    """(L, 2) link of each rank and rank of each link, kind after kind: ``Seating.ranks``."""
    ranks = [np.column_stack([kind.pose.link_order, kind.pose.link_rank]) for kind in kinds]
    return np.concatenate([np.zeros((0, 2)), *ranks]).astype(np.uint32)


def shortening(plants: tuple[PosedPlants, ...], kinds: tuple[Kind, ...]) -> int:
    """Bits by which the card shortens needs before it adds them up in 32 bits."""
    most = [
        max(len(k.pose.link_order), len(k.pose.stem_order), len(k.order.piece_order), len(k.pose.leaf_reach))
        for k in kinds
    ]
    total = sum(len(posed.position) * (count + 1) for posed, count in zip(plants, most, strict=True))
    return max(0, int(total).bit_length() - layouts.WORD.itemsize * 8)
