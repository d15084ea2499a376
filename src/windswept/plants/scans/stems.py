"""build_stems: chains of joined cylinders as the stems and links of a plant.

**Links.** Our links are rigid and bend at their joints only, where half of the compliance of either neighbour is
gathered. That is as exact as beam elements between the joints of one stem, but a stem that leaves a link between
its ends feels none of the wood between that link's joint and the fork: the joint above, which stands for it, is
not on its way to the root. Cylinders of a scan are long (T14: up to 2 m, 0.3 m on average), so they are cut into
links of at most `LONGEST_LINK`; docs/decisions/scanned-trees.md has the figures.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.plants.depth_first import depth_first
from windswept.plants.plant import Look, Material, Plant
from windswept.plants.scans.cylinders import Cylinders, Indices, Reals
from windswept.plants.scans.join import Joined

LONGEST_LINK = 0.25
"""m."""


@dataclass(frozen=True, slots=True)
class _Chains:
    """Which cylinders follow each other in one stem."""

    stem: Indices
    """(C,) stem of each cylinder, numbered as they begin."""
    follows: np.ndarray
    """(C,) whether a cylinder continues its parent's stem."""


def build_stems(cylinders: Cylinders, joined: Joined, name: str, seed: int, material: Material) -> Plant:
    """A plant without leaves.

    Args:
        cylinders: repaired.
        joined: the rods that they became.
        name: what the plant is called.
        seed: kept in the plant.
        material: what its wood is made of.
    """
    chains = _chains(cylinders, joined)
    pieces = np.ceil(np.linalg.norm(joined.tip - joined.base, axis=1) / LONGEST_LINK).astype(np.int64)
    # Rods stem after stem, base to tip: parents have smaller numbers, so the order within a stem is right.
    order = np.argsort(chains.stem, kind="stable")
    count = pieces[order]
    first = np.empty(cylinders.count, np.int64)
    first[order] = np.cumsum(count) - count
    rod = np.repeat(order, count)
    piece = np.arange(len(rod)) - first[rod]
    way = (joined.tip - joined.base)[rod] / pieces[rod][:, None]
    base, tip = joined.base[rod] + piece[:, None] * way, joined.base[rod] + (piece + 1)[:, None] * way
    parent, attach = _link_parents(cylinders, joined, chains, pieces, first, rod, piece)
    link_stem = chains.stem[rod]
    tip32, base32 = tip.astype(np.float32), base.astype(np.float32)
    inner = np.flatnonzero(np.diff(link_stem, prepend=-1) == 0)
    base32[inner] = tip32[inner - 1]
    radius = cylinders.radius[rod].astype(np.float32)
    stems = _stem_arrays(cylinders, chains, base, tip, link_stem, rod)
    none = np.zeros(0, np.float32)
    vectors = np.zeros((0, 3), np.float32)
    return depth_first(
        Plant(
            species=name,
            seed=seed,
            material=material,
            look=Look(),
            **stems,
            link_parent=parent.astype(np.int32),
            link_stem=link_stem.astype(np.int32),
            link_base=base32,
            link_tip=tip32,
            link_attach=attach.astype(np.float32),
            link_radius_base=radius,
            link_radius_tip=radius,
            leaf_link=np.zeros(0, np.int32),
            leaf_position=vectors,
            leaf_axis=vectors,
            leaf_normal=vectors,
            leaf_length=none,
            leaf_width=none,
        )
    )


def _chains(cylinders: Cylinders, joined: Joined) -> _Chains:
    """Let the thickest child at the end of a cylinder continue its stem; all others begin stems of their own."""
    child = np.flatnonzero((cylinders.parent >= 0) & (joined.attach == 1.0))
    thickest_last = child[np.argsort(cylinders.radius[child], kind="stable")]
    heir = np.full(cylinders.count, -1)
    heir[cylinders.parent[thickest_last]] = thickest_last
    follows = np.zeros(cylinders.count, bool)
    follows[heir[heir >= 0]] = True
    stem = np.cumsum(~follows) - 1
    for cylinder in np.flatnonzero(follows):
        stem[cylinder] = stem[cylinders.parent[cylinder]]
    return _Chains(stem, follows)


def _link_parents(
    cylinders: Cylinders,
    joined: Joined,
    chains: _Chains,
    pieces: Indices,
    first: Indices,
    rod: Indices,
    piece: Indices,
) -> tuple[Indices, Reals]:
    """(L,) parent link, and place on it, of every link."""
    parent, attach = np.arange(len(rod)) - 1, np.ones(len(rod))
    start = first[np.flatnonzero(~chains.follows)]
    cylinder = rod[start]
    up = cylinders.parent[cylinder]
    along = joined.attach[cylinder] * pieces[up]
    step = np.clip(np.ceil(along).astype(np.int64) - 1, 0, pieces[up] - 1)
    parent[start] = np.where(up < 0, -1, first[up] + step)
    attach[start] = np.where(up < 0, 1.0, along - step)
    return parent, attach


def _stem_arrays(
    cylinders: Cylinders, chains: _Chains, base: Reals, tip: Reals, link_stem: Indices, rod: Indices
) -> dict[str, np.ndarray]:
    """The fields of stems: radius and taper are those of the cone between a stem's first and last cylinder."""
    count = int(chains.stem.max()) + 1
    begins = np.flatnonzero(~chains.follows)
    up = cylinders.parent[begins]
    parent = np.where(up < 0, -1, chains.stem[up])
    order = np.zeros(count, np.int64)
    for stem in range(count):
        order[stem] = 0 if parent[stem] < 0 else order[parent[stem]] + 1
    length = np.bincount(link_stem, np.linalg.norm(tip - base, axis=1), count)
    link_count = np.bincount(link_stem, minlength=count)
    last = np.cumsum(link_count) - 1
    narrowing = 1.0 - cylinders.radius[rod[last]] / cylinders.radius[begins]
    zero = np.zeros(count, np.float32)
    return {
        "stem_parent": parent.astype(np.int32),
        "stem_order": order.astype(np.int32),
        "stem_link_start": np.concatenate(([0], np.cumsum(link_count))).astype(np.int32),
        "stem_radius": cylinders.radius[begins].astype(np.float32),
        "stem_taper": np.clip(narrowing, 0.0, 0.95).astype(np.float32),
        "stem_flare": zero,
        "stem_lobes": zero,
        "stem_lobe_depth": zero,
        "stem_full_length": length.astype(np.float32),
        "stem_taper_start": zero,
    }
