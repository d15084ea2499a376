"""Geometric level of detail: how much of a plant is drawn, from its size on the screen alone.

Stems and leaves stand in a fixed order of importance and a placement draws a prefix of it. So a picture
depends only on the distance, without memory, and nothing flickers: the stems near the end of the prefix are
drawn ever thinner, the leaves near its end ever smaller, and what is left is enlarged so that the leaf area of
the crown stays the same.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.geometry.geometry import Geometry
from windswept.plants.plant import Floats, Ints

Doubles = NDArray[np.float64]

LEAF_MESHES = 3
"""Leaf meshes of falling fineness."""
SLENDER = 40.0
"""Length over width of a stem whose size for detail is its width."""
FADE = 0.25
"""Share of the full leaves over which the last ones shrink to nothing."""
LEAF_RUN = 2
"""Leaves are drawn in whole runs: which of a plant's leaves throw shadows is nobody else's affair."""


@dataclass(frozen=True, slots=True)
class DetailRules:
    """What is spent on a picture. The defaults suit a graphics card."""

    stem_pixels: tuple[float, float, float, float] = (24.0, 7.0, 2.0, 0.3)
    """Least width of the stems in each bucket, pixels; below the last nothing is drawn."""
    leaf_pixels: float = 3.0
    """Leaves shorter than this on the screen are drawn fewer and larger, pixels."""
    leaf_scale_limit: float = 5.0
    """Most that a leaf is enlarged."""
    leaf_mesh_pixels: tuple[float, float] = (60.0, 18.0)
    """Least length of leaves drawn with the finest and the middle mesh, pixels."""


SOFTWARE_RULES = DetailRules((24.0, 7.0, 2.2, 0.7), 7.5, 6.0, (70.0, 24.0))
"""For a machine that draws triangles on the CPU."""


@dataclass(frozen=True, slots=True)
class DetailOrder:
    """One plant in the order in which it is drawn."""

    piece_order: Ints
    """(Q,) pieces, those of the largest stems first."""
    piece_size: Floats
    """(Q,) size for detail of each in that order, falling, m."""
    leaf_order: Ints
    """(N,) leaves by rank."""
    leaf_length: float
    """Mean length of a leaf, m."""


@dataclass(frozen=True, slots=True)
class Detail:
    """What P placements of one plant draw."""

    piece_limit: Ints
    """(P, 4) pieces up to the end of each bucket."""
    size_cut: Floats
    """(P,) stem size at which stems have shrunk to nothing, m."""
    leaf_count: Ints
    """(P,) leaves drawn, whole runs; the last may have shrunk to nothing."""
    leaf_cut: Floats
    """(P,) rank at which leaves have shrunk to nothing."""
    leaf_fade: Floats
    """(P,) ranks over which they shrink."""
    leaf_scale: Floats
    """(P,) factor on the size of leaves, so that the area stays."""
    leaf_mesh: Ints
    """(P,) mesh the leaves are drawn with, 0 the finest."""


def stem_size(geometry: Geometry) -> Floats:
    """(S,) size for detail, m: the width, a little more for stems that are long for their width."""
    width = 2.0 * geometry.stem_radius.astype(np.float64)
    return (width**0.75 * (geometry.stem_reach / SLENDER) ** 0.25).astype(np.float32)


def detail_order(geometry: Geometry) -> DetailOrder:
    """Sort a plant by importance."""
    size = stem_size(geometry)[geometry.piece_stem]
    order = np.argsort(-size, kind="stable").astype(np.int32)
    leaf_order = np.argsort(geometry.leaf_rank, kind="stable").astype(np.int32)
    length = float(geometry.leaf_size[:, 0].mean()) if geometry.leaf_count else 0.0
    return DetailOrder(order, size[order], leaf_order, length)


def in_runs(leaves: int) -> int:
    """Rows that so many leaves take: the last run is filled up with leaves of no size."""
    return -(-leaves // LEAF_RUN) * LEAF_RUN


def choose_detail(order: DetailOrder, pixels: Doubles, rules: DetailRules) -> Detail:
    """Detail of every placement.

    Args:
        order: the plant in drawing order.
        pixels: (P,) pixels that a metre takes where the placement stands.
        rules: what may be spent.
    """
    cuts = np.asarray(rules.stem_pixels) / pixels[:, None]
    limit = np.searchsorted(-order.piece_size, -cuts, side="left")
    on_screen = order.leaf_length * pixels
    total = len(order.leaf_order)
    least = 1.0 / rules.leaf_scale_limit**2
    full = np.clip((on_screen / rules.leaf_pixels) ** 2, least, 1.0) * total
    fade = np.maximum(FADE * full, 1.0)
    runs = np.ceil((full + fade) / LEAF_RUN)
    drawn_length = on_screen * np.sqrt(total / np.maximum(full, 1.0))
    return Detail(
        piece_limit=limit.astype(np.int32),
        size_cut=cuts[:, -1].astype(np.float32),
        leaf_count=np.minimum(LEAF_RUN * runs, in_runs(total)).astype(np.int32),
        leaf_cut=(full + fade).astype(np.float32),
        leaf_fade=fade.astype(np.float32),
        leaf_scale=_area_scale(full, fade, total).astype(np.float32),
        leaf_mesh=np.searchsorted(-np.asarray(rules.leaf_mesh_pixels), -drawn_length).astype(np.int32),
    )


def _area_scale(full: Doubles, fade: Doubles, total: int) -> Doubles:
    """(P,) scale at which ``full`` leaves and the shrinking ones after them have the area of ``total``."""
    room = np.clip((total - full) / fade, 0.0, 1.0)
    area = full + fade / 3.0 * (1.0 - (1.0 - room) ** 3)
    return np.sqrt(total / np.maximum(area, 1e-9))
