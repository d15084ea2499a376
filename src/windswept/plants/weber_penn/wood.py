"""Turns centre lines into stems and links with lengths and radii."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.plants.radius import flare_factor, taper_radius
from windswept.plants.weber_penn import frames
from windswept.plants.weber_penn.axes import Axes
from windswept.plants.weber_penn.formulas import child_radius
from windswept.plants.weber_penn.pruning import fit_lengths
from windswept.plants.weber_penn.shoots import Shoots
from windswept.plants.weber_penn.tree import SHORTEST_SEGMENT, THINNEST, Tree

Reals = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Wood:
    """The S stems and L links of one order; parents are numbered through all orders, in the order of growth."""

    order: int
    first_stem: int
    """Number of this order's first stem among those of all orders."""
    first_link: int
    """Number of this order's first link among those of all orders."""
    stem_parent: Indices
    stem_length: Reals
    """(S,) full length, for a clone that of the stem it continues, m."""
    stem_start: Reals
    """(S,) Z at which a clone begins, else 0."""
    stem_radius: Reals
    """(S,) base radius before flare, m."""
    stem_offset_ratio: Reals
    """(S,) where the stem stands along its parent, 0..1; 1 for trunks, which so bear leaves to the full."""
    stem_length_ratio: Reals
    """(S,) length over the parent's length."""
    stem_link_count: Indices
    link_parent: Indices
    link_attach: Reals
    link_stem: Indices
    """(L,) stem, counted from this order's first."""
    link_base: Reals
    link_tip: Reals
    link_frame: Reals
    """(L, 3, 3) frame whose z is the link's axis."""
    link_density: Reals
    """(L,) child stems per metre against an unsplit stem."""
    link_z_base: Reals
    """(L,) distance of the link's base from the stem's base, along the unsplit stem, m."""
    link_z_tip: Reals
    link_radius_base: Reals
    link_radius_tip: Reals


def make_wood(tree: Tree, order: int, shoots: Shoots, axes: Axes, first_stem: int, first_link: int) -> Wood:
    """Give one order's centre lines their lengths, links and radii; stems pruned to nothing are left out.

    Args:
        tree: what is grown.
        order: branching order.
        shoots: (F,) where its stems stand.
        axes: (S,) their centre lines.
        first_stem: number of stems of the orders before.
        first_link: number of links of the orders before.
    """
    per_segment = tree.links_per_segment(order)
    point, frame = _links_of_segments(axes, per_segment)
    length = shoots.length
    if order > 0:
        length = fit_lengths(tree, shoots.base, length, axes.family, point, axes.start * per_segment)
    kept = (length >= SHORTEST_SEGMENT * tree.growth.at(order).curve_res)[axes.family]
    family, start = axes.family[kept], axes.start[kept] * per_segment
    mother = np.where(axes.mother < 0, -1, (np.cumsum(kept) - 1)[axes.mother])[kept]
    point, frame = point[kept], frame[kept]
    stem_length, link_count = length[family], frame.shape[1]
    own = np.arange(link_count) >= start[:, None]
    number = np.full(own.shape, -1)
    number[own] = first_link + np.arange(np.count_nonzero(own))
    parent, attach = _link_parents(number, start, mother, shoots.parent_link[family], shoots.attach[family])
    place = shoots.base[family][:, None, :] + stem_length[:, None, None] * point
    ratio = stem_length / shoots.parent_length[family]
    radius = _base_radius(tree, order, shoots, family, ratio, stem_length)
    z = np.arange(link_count + 1) / link_count
    end_radius = _end_radius(tree, order, radius, z, stem_length)
    stem, link = np.nonzero(own)
    return Wood(
        order=order,
        first_stem=first_stem,
        first_link=first_link,
        stem_parent=np.where(mother < 0, shoots.parent_stem[family], first_stem + mother),
        stem_length=stem_length,
        stem_start=start / link_count,
        stem_radius=radius,
        stem_offset_ratio=shoots.offset_ratio[family],
        stem_length_ratio=ratio,
        stem_link_count=link_count - start,
        link_parent=parent[own],
        link_attach=attach[own],
        link_stem=stem,
        link_base=place[:, :-1][own],
        link_tip=place[:, 1:][own],
        link_frame=frame[own],
        link_density=np.repeat(axes.density[kept], per_segment, axis=1)[own],
        link_z_base=z[link] * stem_length[stem],
        link_z_tip=z[link + 1] * stem_length[stem],
        link_radius_base=end_radius[:, :-1][own],
        link_radius_tip=end_radius[:, 1:][own],
    )


def _links_of_segments(axes: Axes, per_segment: int) -> tuple[Reals, Reals]:
    """Link ends (S, K+1, 3) for a length of 1, and frames (S, K, 3, 3), with ``per_segment`` links a segment.

    The links' ends lie on the Catmull-Rom curve through the segments' ends.
    """
    stems, segments = axes.frame.shape[:2]
    if per_segment == 1:
        return axes.point / segments, axes.frame
    chord = axes.frame[:, :, frames.Z]
    tangent = np.zeros_like(axes.point)
    tangent[:, 1:-1] = 0.5 * (chord[:, 1:] + chord[:, :-1])
    tangent[:, -1] = chord[:, -1]
    stem = np.arange(stems)
    tangent[stem, axes.start] = chord[stem, axes.start]
    u = (np.arange(per_segment) / per_segment)[:, None]
    inner = (
        axes.point[:, :-1, None] * (1 + u * u * (2 * u - 3))
        + axes.point[:, 1:, None] * (u * u * (3 - 2 * u))
        + tangent[:, :-1, None] * (u * (1 - u) ** 2)
        + tangent[:, 1:, None] * (u * u * (u - 1))
    )
    point = np.concatenate((inner.reshape(stems, -1, 3), axes.point[:, -1:]), axis=1)
    along = np.diff(point, axis=1)
    along /= np.maximum(np.linalg.norm(along, axis=2, keepdims=True), 1e-12)
    frame = np.repeat(axes.frame, per_segment, axis=1)
    turned = frames.turn_to(frame.reshape(-1, 3, 3), along.reshape(-1, 3)).reshape(frame.shape)
    return point / segments, turned


def _link_parents(
    number: Indices, start: Indices, mother: Indices, seat: Indices, attach: Reals
) -> tuple[Indices, Reals]:
    """(S, K) parent link and place on it, for every link.

    Args:
        number: (S, K) number of every link.
        start: (S,) first link of each stem.
        mother: (S,) stem that a clone continues, else -1.
        seat: (S,) link that the stem's shoot stands on.
        attach: (S,) where on it.
    """
    parent, place = np.full(number.shape, -1), np.ones(number.shape)
    parent[:, 1:] = number[:, :-1]
    stem, clone = np.arange(len(start)), np.flatnonzero(mother >= 0)
    parent[stem, start], place[stem, start] = seat, attach
    parent[clone, start[clone]] = number[mother[clone], start[clone] - 1]
    place[clone, start[clone]] = 1.0
    return parent, place


def _base_radius(
    tree: Tree, order: int, shoots: Shoots, family: Indices, length_ratio: Reals, length: Reals
) -> Reals:
    """(S,) base radius of every stem, m: never thicker than its parent where it stands."""
    growth = tree.growth
    if order == 0:
        factor = growth.scale_0 + float(tree.streams.vary("scale 0", 0, growth.scale_v_0, 1)[0])
        return np.maximum(length * growth.ratio * max(factor, 0.1 * growth.scale_0), THINNEST)
    radius = child_radius(shoots.parent_radius[family], length_ratio, growth.ratio_power)
    return np.clip(radius, THINNEST, np.maximum(shoots.radius_limit[family], THINNEST))


def _end_radius(tree: Tree, order: int, radius: Reals, z: Reals, length: Reals) -> Reals:
    """(S, K+1) radius at every link end, m."""
    thickness = taper_radius(radius[:, None], tree.growth.at(order).taper, z, length[:, None])
    if order == 0:
        thickness = thickness * flare_factor(tree.growth.flare, z)
    return np.maximum(thickness, THINNEST)
