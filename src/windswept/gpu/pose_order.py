"""pose_order: which links and stems a plant needs posed when only its first pieces and leaves are drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.geometry.detail import FADE, LEAF_RUN, DetailOrder, DetailRules, in_runs
from windswept.geometry.geometry import Geometry
from windswept.plants.plant import Ints

Doubles = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PoseOrder:
    """Links and stems of one plant, those first that are needed from farthest away; parents before their children."""

    link_order: Ints
    """(L,) link of each rank."""
    link_rank: Ints
    """(L,) rank of each link."""
    stem_order: Ints
    """(S,) stem of each rank."""
    stem_rank: Ints
    """(S,) rank of each stem."""
    piece_reach: Ints
    """(Q + 1, 2) links and stems, counted from rank 0, that the first 0, 1, ... pieces in drawing order need."""
    leaf_reach: Ints
    """(N + 1, 2) the same of the first leaves; one row more for each leaf that fills up the last run."""

    def reach(self, pieces: Ints, leaves: Ints) -> Ints:
        """(P, 2) links and stems that placements need which draw so many pieces and leaves, (P,) each."""
        return np.maximum(self.piece_reach[pieces], self.leaf_reach[leaves])


def pose_order(geometry: Geometry, link_parent: Ints, order: DetailOrder, rules: DetailRules) -> PoseOrder:
    """Sorts links and stems by how many pixels a metre must take before something needs them.

    The order decides only how few poses are enough: the reaches hold for it whatever the rules.

    Args:
        geometry: what is drawn.
        link_parent: (L,) of the plant, -1 at the root.
        order: in which it is drawn.
        rules: what may be spent.
    """
    piece_pixels, leaf_pixels = _first_drawn(order, rules)
    pieces, leaves = order.piece_order, order.leaf_order
    stem_pixels = np.full(geometry.stem_count, np.inf)
    np.minimum.at(stem_pixels, geometry.piece_stem[pieces], piece_pixels)
    np.minimum.at(stem_pixels, geometry.leaf_stem[leaves], leaf_pixels)
    _pass_to_parents(stem_pixels, geometry.stem_parent)
    link_pixels = np.full(len(link_parent), np.inf)
    for links, pixels in (
        (geometry.piece_link[pieces], piece_pixels[:, None]),
        (geometry.leaf_link[leaves], leaf_pixels),
        (_links_of_stems(geometry), stem_pixels[:, None]),
    ):
        np.minimum.at(link_pixels, links, pixels)
    _pass_to_parents(link_pixels, link_parent)

    stem_order, stem_rank = _ranks(stem_pixels)
    link_order, link_rank = _ranks(link_pixels)
    by_stems = _prefix_most(link_rank[_links_of_stems(geometry)[stem_order]].max(axis=1, initial=-1))

    def reach(links: Ints, stems: Ints) -> Ints:
        posed_stems = _prefix_most(stem_rank[stems])
        posed_links = np.maximum(
            _prefix_most(link_rank[links].max(axis=1, initial=-1)), by_stems[posed_stems]
        )
        return np.stack([posed_links, posed_stems], axis=1)

    of_leaves = reach(geometry.leaf_link[leaves][:, None], geometry.leaf_stem[leaves])
    filling = in_runs(len(leaves)) - len(leaves)
    return PoseOrder(
        link_order,
        link_rank,
        stem_order,
        stem_rank,
        reach(geometry.piece_link[pieces], geometry.piece_stem[pieces]),
        np.pad(of_leaves, [(0, filling), (0, 0)], mode="edge"),
    )


def _first_drawn(order: DetailOrder, rules: DetailRules) -> tuple[Doubles, Doubles]:
    """(Q,) and (N,) pixels a metre from which each piece and each leaf is drawn: ``choose_detail`` backwards."""
    pieces = rules.stem_pixels[-1] / np.maximum(order.piece_size.astype(np.float64), 1e-9)
    total = len(order.leaf_order)
    run_first = np.arange(total) // LEAF_RUN * LEAF_RUN
    share = run_first / (max(total, 1) * (1.0 + FADE))
    leaves = rules.leaf_pixels / max(order.leaf_length, 1e-9) * np.sqrt(share)
    return pieces, np.where(share < 1.0 / rules.leaf_scale_limit**2, 0.0, leaves)


def _links_of_stems(geometry: Geometry) -> Ints:
    """(S, 3) links by which a stem is shifted: its first one, and those of the piece that it grows out of."""
    is_trunk = geometry.stem_parent < 0
    piece = np.where(is_trunk, geometry.stem_piece_start[:-1], geometry.stem_attach_piece)
    return np.column_stack([geometry.stem_link, geometry.piece_link[piece]])


def _pass_to_parents(pixels: Doubles, parent: Ints) -> None:
    """Lowers what parents need to what their children need, in place; parents come before their children."""
    for child in range(len(parent) - 1, 0, -1):
        above = parent[child]
        if above >= 0 and pixels[child] < pixels[above]:
            pixels[above] = pixels[child]


def _ranks(pixels: Doubles) -> tuple[Ints, Ints]:
    """Who has each rank, and the rank of each: equal ones in their own order."""
    order = np.argsort(pixels, kind="stable").astype(np.int32)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order), dtype=np.int32)
    return order, rank


def _prefix_most(ranks: Ints) -> Ints:
    """(n + 1,) how many ranks, from 0 on, hold the first 0, 1, ... of some."""
    return np.concatenate([[0], np.maximum.accumulate(ranks + 1)]).astype(np.int32)
