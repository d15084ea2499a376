"""Plant -> Geometry: the drawn form of a plant, fitted once and carried by its links ever after."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.geometry.fit import fit_stems
from windswept.geometry.geometry import Geometry
from windswept.geometry.openness import CrownLight, crown_light
from windswept.plants.plant import Floats, Ints, Plant

Doubles = NDArray[np.float64]

FIT_TOLERANCE = 0.006
"""Largest distance between a stem's drawn and grown curve, over the stem's length."""
TRUNK_REFERENCE = (1.0, 0.0, 0.0)
"""Skjermo's O for trunks: horizontal, so that L0 x O never vanishes for an upright trunk."""


def build_geometry(plant: Plant, tolerance: float = FIT_TOLERANCE) -> Geometry:
    """Fit Bezier pieces to every stem of a plant and work out how light falls into its crown.

    The grown curve is the smooth curve through a stem's link ends (Catmull-Rom with chord-length knots).

    Args:
        plant: what was grown.
        tolerance: largest distance between drawn and grown curve over the stem's length. A piece never ends
            within a link, so one piece a link is the finest fit.
    """
    fractions, lengths = _fractions(plant)
    pieces, sides, ends, counts = _fit(plant, lengths, tolerance)
    piece_stem = np.repeat(np.arange(plant.stem_count, dtype=np.int32), counts)
    piece_start = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
    starts = np.where(_is_first(piece_stem), 0, np.roll(ends, 1))
    node_row = plant.stem_link_start[piece_stem] + piece_stem
    span = np.stack([fractions[node_row + starts], fractions[node_row + ends]], axis=1)
    first_link = plant.stem_link_start[piece_stem]
    carriers = np.stack([first_link + np.maximum(starts - 1, 0), first_link + ends - 1], axis=1)
    attach_piece, attach_t = _attach(plant, fractions, pieces, piece_start, span)
    base_link = plant.stem_link_start[:-1]
    light = crown_light(plant)
    return Geometry(
        stem_piece_start=piece_start,
        stem_parent=plant.stem_parent,
        stem_depth=_depths(plant.stem_parent),
        stem_attach_piece=attach_piece,
        stem_attach_t=attach_t,
        stem_link=base_link.astype(np.int32),
        stem_parent_link=plant.link_parent[base_link],
        stem_reach=lengths.astype(np.float32),
        piece_stem=piece_stem,
        piece_link=carriers.astype(np.int32),
        piece_points=pieces.astype(np.float32),
        piece_side=sides.astype(np.float32),
        piece_span=span.astype(np.float32),
        stem_radius=plant.stem_radius,
        stem_taper=plant.stem_taper,
        stem_flare=plant.stem_flare,
        stem_lobes=plant.stem_lobes,
        stem_lobe_depth=plant.stem_lobe_depth,
        bulges=plant.look.bark_bulges,
        bulge_depth=plant.look.bark_bulge_depth,
        stem_taper_span=_taper_span(plant, lengths),
        stem_taper_length=plant.stem_full_length,
        piece_openness=light.openness(pieces[:, [0, 3]]),
        **_leaves(plant, light),
    )


def _leaves(plant: Plant, light: CrownLight) -> dict[str, Any]:
    return {
        "leaf_link": plant.leaf_link,
        "leaf_stem": plant.link_stem[plant.leaf_link],
        "leaf_rank": np.random.default_rng(plant.seed).permutation(plant.leaf_count).astype(np.int32),
        "leaf_position": plant.leaf_position,
        "leaf_axis": plant.leaf_axis,
        "leaf_normal": plant.leaf_normal,
        "leaf_size": np.stack([plant.leaf_length, plant.leaf_width], axis=1),
        "leaf_openness": light.openness(plant.leaf_position),
        "leaf_outward": light.outward(plant.leaf_position),
    }


def _fractions(plant: Plant) -> tuple[Doubles, Doubles]:
    """(L+S,) share of its stem's length at every link end, nodes of a stem together; (S,) lengths, m."""
    step = np.linalg.norm(plant.link_tip.astype(np.float64) - plant.link_base, axis=1)
    run = np.concatenate([[0.0], np.cumsum(step)])
    first, end = plant.stem_link_start[:-1], plant.stem_link_start[1:]
    lengths = run[end] - run[first]
    nodes = np.zeros(plant.link_count + plant.stem_count)
    rows = np.arange(plant.link_count) + plant.link_stem + 1
    nodes[rows] = (run[1:] - run[first][plant.link_stem]) / lengths[plant.link_stem]
    return nodes, lengths


def _fit(plant: Plant, lengths: Doubles, tolerance: float) -> tuple[Doubles, Doubles, Ints, Ints]:
    """Pieces (Q, 4, 3), their side vectors (Q, 2, 3), the node each ends at (Q,), pieces per stem (S,)."""
    links, stems = plant.link_count, plant.stem_count
    nodes = np.empty((links + stems, 3))
    nodes[np.arange(links) + plant.link_stem + 1] = plant.link_tip
    nodes[plant.stem_link_start[:-1] + np.arange(stems)] = plant.link_base[plant.stem_link_start[:-1]]
    pieces, sides = np.empty((links, 4, 3)), np.empty((links, 2, 3))
    ends, counts = np.empty(links, np.int32), np.empty(stems, np.int32)
    node_start = plant.stem_link_start + np.arange(stems + 1, dtype=np.int32)
    fit_stems(nodes, node_start, tolerance * lengths, _references(plant), pieces, sides, ends, counts)
    piece_rank = np.arange(links) - plant.stem_link_start[:-1][plant.link_stem]
    kept = piece_rank < counts[plant.link_stem]
    return pieces[kept], sides[kept], ends[kept], counts


def _references(plant: Plant) -> Doubles:
    """(S, 3) unit direction of the parent link where each stem grows out; horizontal for trunks."""
    parent = plant.link_parent[plant.stem_link_start[:-1]]
    direction = (plant.link_tip - plant.link_base)[parent].astype(np.float64)
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return np.where(parent[:, None] < 0, TRUNK_REFERENCE, direction)


def _is_first(stem: Ints) -> NDArray[np.bool_]:
    return np.concatenate([[True], stem[1:] != stem[:-1]])


def _depths(parent: Ints) -> Ints:
    """(S,) number of ancestors; one sweep per depth."""
    depth = np.zeros(len(parent), np.int32)
    ancestor = parent.copy()
    while (ancestor >= 0).any():
        depth += ancestor >= 0
        ancestor = np.where(ancestor >= 0, parent[ancestor], -1)
    return depth


def _attach(
    plant: Plant, fractions: Doubles, pieces: Doubles, piece_start: Ints, span: Doubles
) -> tuple[Ints, Floats]:
    """Piece (S,) and parameter (S,) of the parent's drawn curve that lies nearest to each stem's base."""
    base_link = plant.stem_link_start[:-1]
    link = plant.link_parent[base_link]
    is_trunk = link < 0
    stem = np.where(is_trunk, 0, plant.link_stem[link])
    below, above = fractions[link + stem], fractions[link + stem + 1]
    fraction = below + plant.link_attach[base_link] * (above - below)
    # Spans lie in 0..1, so twice the stem's number keeps the keys of different stems apart.
    piece_key = 2.0 * np.repeat(np.arange(plant.stem_count), np.diff(piece_start)) + span[:, 0]
    piece = np.searchsorted(piece_key, 2.0 * stem + fraction, side="right") - 1
    piece = np.clip(piece, piece_start[stem], piece_start[stem + 1] - 1)
    t = np.clip((fraction - span[piece, 0]) / (span[piece, 1] - span[piece, 0]), 0.0, 1.0)
    t = _nearest(pieces[piece], plant.link_base[base_link], t)
    return np.where(is_trunk, -1, piece).astype(np.int32), np.where(is_trunk, 0.0, t).astype(np.float32)


def _nearest(pieces: Doubles, points: Floats, t: Doubles) -> Doubles:
    """Parameter (n,) of the point nearest to each of ``points`` (n, 3) on its piece (n, 4, 3), Gauss-Newton."""
    for _ in range(5):
        s = 1.0 - t
        weights = np.stack([s**3, 3 * s * s * t, 3 * s * t * t, t**3], axis=1)
        slopes = np.stack([s * s, 2 * s * t, t * t], axis=1)
        gap = np.einsum("ni,nik->nk", weights, pieces) - points
        heading = 3.0 * np.einsum("ni,nik->nk", slopes, np.diff(pieces, axis=1))
        t = np.clip(t - np.sum(gap * heading, axis=1) / np.sum(heading**2, axis=1), 0.0, 1.0)
    return t


def _taper_span(plant: Plant, lengths: Doubles) -> Floats:
    start = plant.stem_taper_start.astype(np.float64)
    end = np.minimum(start + lengths / plant.stem_full_length, 1.0)
    return np.stack([start, end], axis=1).astype(np.float32)
