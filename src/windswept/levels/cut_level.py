"""cut_level: from the hierarchy of a plant to one simulation level, as compact arrays of what is stepped."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from windswept.levels.hierarchy import Hierarchy
from windswept.motion.exact_step import exact_step
from windswept.motion.level import (
    CENTRE,
    COUPLE,
    FORCE_LEAF,
    FORCE_WOOD,
    GROUP_CONSTANT_COUNT,
    GROUP_MOBILITY,
    GROUP_STEP,
    LEAF_FACTOR,
    SWAY,
    WOOD_FACTOR,
    Level,
)
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats, Ints


def cut_level(hierarchy: Hierarchy, tolerance: float | Doubles) -> Level:
    """The coarsest level whose error is nowhere above a tolerance.

    Args:
        hierarchy: of the plant.
        tolerance: greatest ``hierarchy.error``, one number for the whole plant or (K,) for each node.
    """
    merged = hierarchy.error <= tolerance
    opened, groups = walk_cut(hierarchy.child, hierarchy.root, merged, hierarchy.model.link_count)
    return compact_level(hierarchy, np.sort(opened), groups)


@njit(cache=True)
def walk_cut(child: Ints, root: int, merged: NDArray[np.bool_], limbs: int) -> tuple[Ints, Ints]:
    """Opened links and nodes of the cut: from the root down, a node that may be merged ends the walk.

    Args:
        child: (K, 2) nodes within each node.
        root: where the walk begins.
        merged: (K,) whether a node's error is small enough.
        limbs: nodes below this number are limbs, which open to a link.
    """
    opened, groups, stack = [np.int32(0) for _ in range(0)], [np.int32(0) for _ in range(0)], [root]
    while len(stack) > 0:
        node = stack.pop()
        if merged[node]:
            groups.append(np.int32(node))
            continue
        if node < limbs:
            opened.append(np.int32(node))
        for k in range(2):
            if child[node, k] >= 0:
                stack.append(child[node, k])
    return np.array(opened, np.int32), np.array(groups, np.int32)


def compact_level(hierarchy: Hierarchy, links: Ints, nodes: Ints) -> Level:
    """Level with given active links (ascending) and groups.

    Args:
        hierarchy: of the plant.
        links: (A,) active links; the parent of every one is among them.
        nodes: (G,) nodes of the cut, in any order.
    """
    model = hierarchy.model
    place = np.full(model.link_count + 1, -1, np.int32)
    place[links] = np.arange(len(links), dtype=np.int32)
    carrier = place[hierarchy.hangs_on[nodes]]
    nodes = nodes[np.argsort(carrier, kind="stable")]
    carrier = np.sort(carrier)
    constants, group_probe = group_constants(hierarchy, nodes)
    probes = np.concatenate([model.link_probe[links], group_probe])
    used, probe = np.unique(probes, return_inverse=True)
    return Level(
        material=model.material,
        time_step=model.time_step,
        link=links,
        parent=place[model.skeleton.parent[links]],
        depth=model.skeleton.depth[links],
        constants=model.constants[links],
        probe=probe[: len(links)].astype(np.int32),
        probe_position=model.probe_position[used],
        group_start=np.searchsorted(carrier, np.arange(-1, len(links) + 1)).astype(np.int32),
        group_constants=constants,
        group_frequency=hierarchy.frequency[nodes],
        group_probe=probe[len(links) :].astype(np.int32),
        group_first=hierarchy.first[nodes],
        group_stop=hierarchy.stop[nodes],
        shapes=hierarchy.shapes,
        shape_limit=hierarchy.pressure,
        modes=model.modes.among(links),
    )


def group_constants(hierarchy: Hierarchy, nodes: Ints) -> tuple[Floats, Ints]:
    """Constants of nodes as the kernel reads them, and the probe nearest to each node's centre of pressure."""
    model, influence = hierarchy.model, hierarchy.influence
    skeleton, carrier = model.skeleton, hierarchy.hangs_on[nodes]
    sizes = hierarchy.stop[nodes] - hierarchy.first[nodes]
    starts = np.cumsum(sizes) - sizes
    group = np.repeat(np.arange(len(nodes), dtype=np.int32), sizes)
    member = np.arange(len(group)) + np.repeat(hierarchy.first[nodes] - starts, sizes)

    def total(per_member: Doubles) -> Doubles:
        """Sum over each node's links."""
        return np.add.reduceat(per_member, starts, axis=0) if len(nodes) else per_member

    at = skeleton.base[member] + model.drag.centre[member, None] * skeleton.vector[member]
    drag, leaf_drag = influence.drag[member], influence.leaf_drag[member]
    weight = np.maximum(np.trace(drag, axis1=1, axis2=2), 1e-30)
    whole = total(weight)
    centre = total(at * weight[:, None]) / whole[:, None]
    moment = total(np.cross(at[:, :, None], drag, axis=1))
    couple = moment - np.cross(centre[:, :, None], total(drag), axis=1)
    own = influence.displacement[member] - _carried_displacement(hierarchy, carrier[group], at)
    sway = _damped_sway(own, drag, weight, group, total)

    joint = np.where((carrier >= 0)[:, None], skeleton.base[carrier], 0.0)
    leaf = total(np.trace(leaf_drag, axis1=1, axis2=2)) / whole
    frequency = hierarchy.frequency[nodes]
    damping = np.full(len(nodes), model.damping_ratio.mean())
    packed = np.zeros((len(nodes), GROUP_CONSTANT_COUNT), np.float32)
    packed[:, CENTRE : CENTRE + 3] = centre - joint
    packed[:, FORCE_LEAF : FORCE_LEAF + 6] = _six(total(leaf_drag))
    packed[:, FORCE_WOOD : FORCE_WOOD + 6] = _six(total(influence.wood_drag[member]))
    packed[:, COUPLE : COUPLE + 9] = couple.reshape(-1, 9)
    packed[:, SWAY : SWAY + 9] = sway.reshape(-1, 9)
    packed[:, LEAF_FACTOR] = leaf
    packed[:, WOOD_FACTOR] = 1.0 - influence.folded * leaf
    packed[:, GROUP_MOBILITY] = model.time_step * frequency**2 * np.linalg.norm(sway, ord=2, axis=(1, 2))
    packed[:, GROUP_STEP : GROUP_STEP + 4] = exact_step(frequency, damping, model.time_step)
    return packed, _nearest_probe(model.probe_position, centre)


def _damped_sway(
    own: Doubles, drag: Doubles, weight: Doubles, group: Ints, total: Callable[[Doubles], Doubles]
) -> Doubles:
    """(G, 3, 3) displacement per pressure whose rate damps a group as the rates of all its links do.

    The mean displacement of the group's drag, made larger by virtual work: a link that moves much takes much work
    from the wind by its displacement, and loses much of it by its speed.

    Args:
        own: (n, 3, 3) displacement of each member's drag per pressure, relative to the carrier.
        drag: (n, 3, 3) drag tensors.
        weight: (n,) their traces.
        group: (n,) which group each member is in.
        total: sums over the members of each group.
    """
    mean = total(own * weight[:, None, None]) / total(weight)[:, None, None]
    work = np.einsum("nji,njk->nik", own, drag)
    lost = total(np.einsum("nik,nki->n", work, own))
    by_mean = total(np.einsum("nik,nki->n", work, mean[group]))
    return mean * (lost / np.maximum(by_mean, 1e-30))[:, None, None]


def _carried_displacement(hierarchy: Hierarchy, carrier: Ints, at: Doubles) -> Doubles:
    """(n, 3, 3) displacement of each point per pressure if it moved rigidly with the link that carries it."""
    skeleton, influence = hierarchy.model.skeleton, hierarchy.influence
    d = skeleton.vector[carrier]
    lever = hierarchy.model.drag.centre[carrier, None] * d
    turn = influence.turn[carrier]
    base = influence.displacement[carrier] - np.cross(turn, lever[:, :, None], axis=1)
    carried = base + np.cross(turn, (at - skeleton.base[carrier])[:, :, None], axis=1)
    return np.where((carrier >= 0)[:, None, None], carried, 0.0)


def _six(tensor: Doubles) -> Doubles:
    """(G, 6) xx, yy, zz, xy, xz, yz of (G, 3, 3) symmetric tensors."""
    return tensor[:, (0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)]


def _nearest_probe(probes: Floats, points: Doubles) -> Ints:
    """(G,) index of the probe nearest to each point."""
    return cKDTree(probes).query(points)[1].astype(np.int32)
