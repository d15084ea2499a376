"""Geometries as the card holds them: the stems, pieces and leaves of every kind of plant, one after another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from windswept.geometry.detail import DetailOrder, DetailRules, detail_order, in_runs, stem_size
from windswept.geometry.geometry import Geometry
from windswept.geometry.leaves import LEAF_SHAPES
from windswept.gpu import layouts
from windswept.gpu.buffers import check_count, table
from windswept.gpu.pose_order import PoseOrder, pose_order
from windswept.plants.plant import Floats, Look, Plant


@dataclass(frozen=True, slots=True)
class Kind:
    """Where one kind of plant lies in the common buffers, and what detail needs of it."""

    order: DetailOrder
    pose: PoseOrder
    stem_first: int
    piece_first: int
    leaf_first: int
    centre: NDArray[np.float64]
    """(3,) middle of the plant at rest, m."""
    radius: float
    """Of a ball round the plant at rest, m."""


@dataclass(frozen=True, slots=True)
class PlantArrays:
    """Rest data of all kinds in the layouts of ``types.wgsl``."""

    kinds: tuple[Kind, ...]
    stems: NDArray[np.void]
    pieces: NDArray[np.void]
    leaves: NDArray[np.void]
    looks: NDArray[np.void]


def plant_arrays(
    plants: list[Plant], geometries: list[Geometry], looks: list[Look], rules: DetailRules
) -> PlantArrays:
    """Bring all kinds into the card's layouts.

    Args:
        plants: one of each kind.
        geometries: the drawn form of each.
        looks: one for each kind and then others, at most ``LOOK_LIMIT``.
        rules: what may be spent: decides which poses come first.

    Raises:
        GraphicsError: there are more kinds or looks than the shaders' tables hold.
    """
    check_count(len(plants), layouts.KIND_LIMIT, "kinds of plants")
    kinds: list[Kind] = []
    stems = [np.zeros(0, layouts.STEM)]
    pieces = [np.zeros(0, layouts.PIECE)]
    leaves = [np.zeros(0, layouts.LEAF)]
    stem_first = piece_first = leaf_first = 0
    for plant, geometry in zip(plants, geometries, strict=True):
        order = detail_order(geometry)
        pose = pose_order(geometry, plant.link_parent, order, rules)
        stems.append(_stems(geometry, order, pose))
        pieces.append(_pieces(geometry, order, pose, plant.link_base))
        leaves.append(_leaves(geometry, order, pose, plant.link_base))
        centre, radius = _ball(geometry)
        kinds.append(Kind(order, pose, stem_first, piece_first, leaf_first, centre, radius))
        stem_first += geometry.stem_count
        piece_first += geometry.piece_count
        leaf_first += in_runs(geometry.leaf_count)
    return PlantArrays(
        tuple(kinds),
        np.concatenate(stems),
        np.concatenate(pieces),
        np.concatenate(leaves),
        _looks(looks),
    )


def _stems(geometry: Geometry, order: DetailOrder, pose: PoseOrder) -> NDArray[np.void]:
    """Stems by rank; links and parents are named by rank, the piece they grow out of by its place in drawing order."""
    rank = np.empty(geometry.piece_count, np.int64)
    rank[order.piece_order] = np.arange(geometry.piece_count)
    rows = np.zeros(geometry.stem_count, layouts.STEM)
    rows["profile"] = _columns(
        geometry.stem_radius, geometry.stem_taper, geometry.stem_flare, geometry.stem_lobes
    )
    rows["extent"] = _columns(
        geometry.stem_lobe_depth, *geometry.stem_taper_span.T, geometry.stem_taper_length
    )
    depth = geometry.bulge_depth
    rows["attach"] = _columns(geometry.stem_attach_t, stem_size(geometry), geometry.stem_reach, depth)
    is_trunk = geometry.stem_parent < 0
    parent = np.where(is_trunk, layouts.NONE, pose.stem_rank[geometry.stem_parent])
    piece = np.where(is_trunk, 0, rank[geometry.stem_attach_piece])
    rows["rows"] = _columns(parent, pose.link_rank[geometry.stem_link], piece, geometry.bulges)
    return rows[pose.stem_order]


def _pieces(geometry: Geometry, order: DetailOrder, pose: PoseOrder, link_base: Floats) -> NDArray[np.void]:
    """Pieces in drawing order, control points relative to the joints of their links."""
    rows = np.zeros(geometry.piece_count, layouts.PIECE)
    points = geometry.piece_points - link_base[np.repeat(geometry.piece_link, 2, axis=1)]
    extra = [*geometry.piece_span.T, *geometry.piece_openness.T]
    for k, name in enumerate(("p0", "p1", "p2", "p3")):
        rows[name] = _columns(*points[:, k].T, extra[k])
    rows["side0"] = _columns(*geometry.piece_side[:, 0].T, 0.0)
    rows["side1"] = _columns(*geometry.piece_side[:, 1].T, 0.0)
    rows["rows"] = _columns(pose.stem_rank[geometry.piece_stem], *pose.link_rank[geometry.piece_link].T, 0)
    return rows[order.piece_order]


def _leaves(geometry: Geometry, order: DetailOrder, pose: PoseOrder, link_base: Floats) -> NDArray[np.void]:
    """Leaves by rank in whole runs, attachments relative to the joints of their links."""
    rows = np.zeros(geometry.leaf_count, layouts.LEAF)
    offset = geometry.leaf_position - link_base[geometry.leaf_link]
    chance = (geometry.leaf_rank * 0.6180339887) % 1.0
    rows["position"] = _columns(*offset.T, geometry.leaf_size[:, 0])
    rows["axis"] = _columns(*geometry.leaf_axis.T, geometry.leaf_size[:, 1])
    rows["normal"] = _columns(*geometry.leaf_normal.T, geometry.leaf_openness)
    rows["outward"] = _columns(*geometry.leaf_outward.T, chance)
    rows["rows"] = _columns(pose.link_rank[geometry.leaf_link], pose.stem_rank[geometry.leaf_stem], 0, 0)
    filling = in_runs(len(rows)) - len(rows)
    in_order = rows[np.pad(order.leaf_order, (0, filling), mode="edge")]
    for name in ("position", "axis"):
        in_order[name][len(rows) :, 3] = 0.0
    return in_order


def _looks(looks: list[Look]) -> NDArray[np.void]:
    rows = np.zeros(len(looks), layouts.LOOK)
    for row, look in zip(rows, looks, strict=True):
        row["bark"] = (*look.bark_colour, look.bark_relief)
        row["leaf"] = (*look.leaf_colour, LEAF_SHAPES.index(look.leaf_shape))
        row["back"] = (*look.leaf_back_colour, look.leaf_flutter)
    return table(rows, layouts.LOOK_LIMIT, "looks of plants")


def _ball(geometry: Geometry) -> tuple[NDArray[np.float64], float]:
    points = np.concatenate([geometry.piece_points.reshape(-1, 3), geometry.leaf_position]).astype(np.float64)
    low, high = points.min(axis=0), points.max(axis=0)
    return 0.5 * (low + high), 0.5 * float(np.linalg.norm(high - low))


def _columns(*columns: ArrayLike) -> NDArray[Any]:
    """(n, 4) array out of four columns or numbers."""
    return np.stack(np.broadcast_arrays(*columns), axis=-1)
