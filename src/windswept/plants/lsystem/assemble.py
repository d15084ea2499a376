"""assemble: from a tidy sketch to a Plant, in the order of growth."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from windswept.plants.lsystem.form import GrammarForm
from windswept.plants.lsystem.sketch import Sketch
from windswept.plants.lsystem.wood import node_radii
from windswept.plants.plant import Plant

MOST_TAPER = 0.95
"""A stem's drawn taper: less than a cone, so that the tip has a radius."""


def assemble(sketch: Sketch, form: GrammarForm, species: str, seed: int) -> Plant:
    """The plant of a sketch.

    Args:
        sketch: tidied, in metres.
        form: material, look and radius of the tips.
        species: the plant's name.
        seed: it was grown with.
    """
    stems = sketch.stems
    radii = node_radii(sketch, form.tip_radius)
    counts = np.array([len(stem.nodes) - 1 for stem in stems])
    start = np.concatenate(([0], np.cumsum(counts)))
    nodes = np.array([node for stem in stems for node in stem.nodes], np.float32)
    radius = np.array([value for row in radii for value in row])
    is_tip = np.zeros(len(nodes), bool)
    is_tip[np.cumsum(counts + 1) - 1] = True
    is_base = np.roll(is_tip, 1)
    parent, attach = _link_seats(sketch, start)
    strength = np.array([value for stem in stems for value in stem.strength])
    base_radius, tip_radius = (np.array([row[i] for row in radii]) for i in (0, -1))
    first = start[:-1]
    length = np.add.reduceat(np.linalg.norm(nodes[~is_base] - nodes[~is_tip], axis=1), first)
    return Plant(
        species=species,
        seed=seed,
        material=form.plant_material(),
        look=form.plant_look(),
        stem_parent=_ints([-1 if stem.seat is None else stem.seat[0] for stem in stems]),
        stem_order=_ints([stem.order for stem in stems]),
        stem_link_start=_ints(start),
        stem_radius=_floats(base_radius),
        stem_taper=_floats(np.clip(1.0 - tip_radius / base_radius, 0.0, MOST_TAPER)),
        stem_flare=_floats(np.zeros(len(stems))),
        stem_lobes=_floats(np.zeros(len(stems))),
        stem_lobe_depth=_floats(np.zeros(len(stems))),
        stem_full_length=_floats(length),
        stem_taper_start=_floats(np.zeros(len(stems))),
        link_parent=_ints(parent),
        link_stem=_ints(np.repeat(np.arange(len(stems)), counts)),
        link_base=nodes[~is_tip],
        link_tip=nodes[~is_base],
        link_attach=_floats(attach),
        link_radius_base=_floats(radius[~is_tip]),
        link_radius_tip=_floats(radius[~is_base]),
        joint_scale=None if (strength == 1.0).all() else _floats(np.column_stack((strength, strength))),
        **_leaves(sketch, start),
    )


def _link_seats(sketch: Sketch, start: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """(L,) parent link and place on it: a node is the tip of the link before it, but a first node a base."""
    parent = np.arange(start[-1]) - 1
    attach = np.ones(start[-1])
    for number, stem in enumerate(sketch.stems):
        first = start[number]
        if stem.seat is None:
            parent[first] = -1
        else:
            mother, node = stem.seat
            parent[first] = start[mother] + max(node - 1, 0)
            attach[first] = float(node > 0)
    return parent, attach


def _leaves(sketch: Sketch, start: NDArray[np.int64]) -> dict[str, Any]:
    """The leaf arrays; leaves that came before all wood stand at the root."""
    seats = [(0, 0) if leaf.seat is None else leaf.seat for leaf in sketch.leaves]
    places = [sketch.stems[stem].nodes[node] for stem, node in seats]
    return {
        "leaf_link": _ints([start[stem] + max(node - 1, 0) for stem, node in seats]),
        "leaf_position": _floats(places).reshape(-1, 3),
        "leaf_axis": _floats([leaf.axis for leaf in sketch.leaves]).reshape(-1, 3),
        "leaf_normal": _floats([leaf.normal for leaf in sketch.leaves]).reshape(-1, 3),
        "leaf_length": _floats([leaf.length for leaf in sketch.leaves]),
        "leaf_width": _floats([leaf.width for leaf in sketch.leaves]),
    }


def _ints(values: ArrayLike) -> NDArray[np.int32]:
    return np.asarray(values, np.int64).astype(np.int32)


def _floats(values: ArrayLike) -> NDArray[np.float32]:
    return np.asarray(values, np.float64).astype(np.float32)
