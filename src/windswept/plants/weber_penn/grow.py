"""grow: from a species to a plant."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.plants.check_seed import check_seed
from windswept.plants.depth_first import depth_first
from windswept.plants.plant import Plant
from windswept.plants.species import Species, load_species
from windswept.plants.thicken import thicken
from windswept.plants.weber_penn.axes import grow_axes
from windswept.plants.weber_penn.leaves import Leaves, grow_leaves
from windswept.plants.weber_penn.sprout import sprout, trunk_shoot
from windswept.plants.weber_penn.stems import Shoots, Wood
from windswept.plants.weber_penn.tree import Tree, plant_tree
from windswept.plants.weber_penn.wood import make_wood


def grow(
    species: Species | str | Path, seed: int = 0, link_budget: int = 300_000, leaf_budget: int = 3_000_000
) -> Plant:
    """Grow a tree after Weber and Penn (1995).

    Args:
        species: a species, the name of a built-in one, or the path of a species file.
        seed: 0 or more; the same species and seed give the same bytes.
        link_budget: most links the plant may have.
        leaf_budget: most leaves the plant may have.

    Raises:
        InputError: the species or the seed is wrong.
        BudgetError: the plant would be larger than a budget; raised before the memory is taken.
    """
    form = species if isinstance(species, Species) else load_species(species)
    check_seed(seed)
    tree = plant_tree(form, seed, link_budget, leaf_budget)
    orders = [_grow_order(tree, 0, trunk_shoot(tree), 0, 0)]
    for order in range(1, form.growth.levels):
        stems = orders[-1].first_stem + len(orders[-1].stem_parent)
        links = orders[-1].first_link + len(orders[-1].link_parent)
        orders.append(_grow_order(tree, order, sprout(tree, orders[-1], links), stems, links))
    return thicken(depth_first(_assembled(tree, orders, grow_leaves(tree, orders[-1]))))


def _grow_order(tree: Tree, order: int, shoots: Shoots, first_stem: int, first_link: int) -> Wood:
    """Grow all stems of one order."""
    axes = grow_axes(tree, order, shoots.frame, first_link)
    return make_wood(tree, order, shoots, axes, first_stem, first_link)


def _assembled(tree: Tree, orders: list[Wood], leaves: Leaves) -> Plant:
    """The plant with its stems in the order of growth."""
    growth = tree.growth

    def joined(name: str) -> NDArray[Any]:
        whole = np.concatenate([getattr(wood, name) for wood in orders])
        return whole.astype(np.float32 if whole.dtype.kind == "f" else np.int32)

    stem_order = np.repeat([wood.order for wood in orders], [len(wood.stem_parent) for wood in orders])
    is_trunk = stem_order == 0
    taper = np.array([growth.at(wood.order).taper for wood in orders])
    link_start = np.concatenate(([0], np.cumsum(joined("stem_link_count"))))
    leaf_count = len(leaves.link)
    return Plant(
        species=tree.species.name,
        seed=tree.seed,
        material=tree.species.plant_material(),
        look=tree.species.plant_look(),
        stem_parent=joined("stem_parent"),
        stem_order=stem_order.astype(np.int32),
        stem_link_start=link_start.astype(np.int32),
        stem_radius=joined("stem_radius"),
        stem_taper=taper[stem_order].astype(np.float32),
        stem_flare=np.where(is_trunk, growth.flare, 0.0).astype(np.float32),
        stem_lobes=np.where(is_trunk, growth.lobes, 0).astype(np.float32),
        stem_lobe_depth=np.where(is_trunk, growth.lobe_depth, 0.0).astype(np.float32),
        stem_full_length=joined("stem_length"),
        stem_taper_start=joined("stem_start"),
        link_parent=joined("link_parent"),
        link_stem=np.repeat(np.arange(len(stem_order)), np.diff(link_start)).astype(np.int32),
        link_base=joined("link_base"),
        link_tip=joined("link_tip"),
        link_attach=joined("link_attach"),
        link_radius_base=joined("link_radius_base"),
        link_radius_tip=joined("link_radius_tip"),
        leaf_link=leaves.link.astype(np.int32),
        leaf_position=leaves.position.astype(np.float32),
        leaf_axis=leaves.axis.astype(np.float32),
        leaf_normal=leaves.normal.astype(np.float32),
        leaf_length=np.full(leaf_count, leaves.length, np.float32),
        leaf_width=np.full(leaf_count, leaves.width, np.float32),
    )
