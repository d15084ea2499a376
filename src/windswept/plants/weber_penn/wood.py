"""Turns centre lines into stems and links with lengths and radii."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.plants.radius import flare_factor, taper_radius
from windswept.plants.weber_penn.axes import Axes
from windswept.plants.weber_penn.divide import divided
from windswept.plants.weber_penn.formulas import child_radius
from windswept.plants.weber_penn.pruning import fit_lengths
from windswept.plants.weber_penn.stems import Shoots, Wood
from windswept.plants.weber_penn.tree import SHORTEST_SEGMENT, THINNEST, Tree

Reals = NDArray[np.float64]
Indices = NDArray[np.int64]


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
    lines = divided(axes, tree.links_per_segment(order), tree.growth.at(order).curve_res)
    length = shoots.length
    if order > 0:
        link_family = axes.family[lines.stem]
        length = fit_lengths(tree, shoots.base, length, link_family, lines.z_tip, lines.tip)
    grows = (length >= SHORTEST_SEGMENT * tree.growth.at(order).curve_res)[axes.family]
    lines = lines.of_stems(grows)
    family = axes.family[grows]
    mother = np.where(axes.mother < 0, -1, (np.cumsum(grows) - 1)[axes.mother])[grows]
    stem_length = length[family]
    ratio = stem_length / shoots.parent_length[family]
    radius = _base_radius(tree, order, shoots, family, ratio, stem_length)
    link_count = np.bincount(lines.stem, minlength=len(family))
    parent, attach = _link_parents(shoots, family, mother, link_count, first_link)
    link_length, base = stem_length[lines.stem], shoots.base[family[lines.stem]]
    return Wood(
        order=order,
        first_stem=first_stem,
        first_link=first_link,
        stem_parent=np.where(mother < 0, shoots.parent_stem[family], first_stem + mother),
        stem_length=stem_length,
        stem_start=axes.start[grows] / tree.growth.at(order).curve_res,
        stem_radius=radius,
        stem_offset_ratio=shoots.offset_ratio[family],
        stem_length_ratio=ratio,
        stem_link_count=link_count,
        link_parent=parent,
        link_attach=attach,
        link_stem=lines.stem,
        link_base=base + link_length[:, None] * lines.base,
        link_tip=base + link_length[:, None] * lines.tip,
        link_frame=lines.frame,
        link_density=lines.density,
        link_z_base=lines.z_base * link_length,
        link_z_tip=lines.z_tip * link_length,
        link_radius_base=_radius_at(tree, order, radius[lines.stem], lines.z_base, link_length),
        link_radius_tip=_radius_at(tree, order, radius[lines.stem], lines.z_tip, link_length),
    )


def _link_parents(
    shoots: Shoots, family: Indices, mother: Indices, link_count: Indices, first_link: int
) -> tuple[Indices, Reals]:
    """(L,) parent link, and place on it, of every link.

    Args:
        shoots: where the stems stand.
        family: (S,) shoot of each stem.
        mother: (S,) stem that a clone continues, else -1.
        link_count: (S,) links of each stem; all stems of an order end together, so a clone's own links
            are as many as the last ones of its mother.
        first_link: number of links of the orders before.
    """
    end = np.cumsum(link_count)
    parent = first_link + np.arange(end[-1] if len(end) else 0) - 1
    attach = np.ones(len(parent))
    first = end - link_count
    continued = first_link + end[mother] - link_count - 1
    parent[first] = np.where(mother < 0, shoots.parent_link[family], continued)
    attach[first] = np.where(mother < 0, shoots.attach[family], 1.0)
    return parent, attach


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


def _radius_at(tree: Tree, order: int, radius: Reals, z: Reals, length: Reals) -> Reals:
    """(L,) radius at link ends, m.

    Args:
        tree: what is grown.
        order: branching order.
        radius: (L,) base radius of the link's stem, m.
        z: (L,) fraction of the stem's full length.
        length: (L,) full length of the stem, m.
    """
    thickness = taper_radius(radius, tree.growth.at(order).taper, z, length)
    if order == 0:
        thickness = thickness * flare_factor(tree.growth.flare, z)
    return np.maximum(thickness, THINNEST)
