"""simplify: from a plant's model to its hierarchy of merged branches.

A *node* stands for a range of links that may move together, by one oscillator, hanging on one parent link:

    limb k   link k and everything beyond it; opened, it becomes link k itself with, beyond it, the limb of the
             stem's next link and the tuft of the side stems that grow out of link k
    tuft     side stems that grow out of one link, next to each other; opened, it becomes its two halves

So the nodes are a binary tree over the plant, from one node for all of it to single links, and a *cut* through
that tree is a simulation level: opened limbs are simulated as links, the nodes of the cut as oscillators.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from windswept.levels.influence import Influence, static_influence
from windswept.levels.mismatch import look_up, mismatch_table
from windswept.levels.static_shapes import stated_pressure, static_shapes
from windswept.motion import Model
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats, Ints


@dataclass(frozen=True, slots=True)
class Hierarchy:
    """The merge tree of a plant with L links: K nodes, node k < L is limb k, tufts come after."""

    model: Model
    influence: Influence
    shapes: Floats
    """(L, 2, 9) static shapes of the joints: one array that all levels share."""
    pressure: float
    """The wind's pressure at the stated speed, up to which the shapes hold, (m/s)^2."""
    root: int
    """Node that stands for the whole plant."""
    first: Ints
    """(K,) first link of the node's range."""
    stop: Ints
    """(K,) end of the node's range."""
    hangs_on: Ints
    """(K,) link that carries the node, -1 for the ground."""
    child: Ints
    """(K, 2) nodes beyond the opened node, -1 where there is none."""
    lever: Doubles
    """(L,) how far each joint's static turn moves the farthest point beyond it, per pressure, s^2/m."""
    frequency: Doubles
    """(K,) angular frequency of the node's oscillator, rad/s."""
    error: Doubles
    """(K,) reckoned displacement error of the node's worst tip, standard deviation in gusts of unit pressure, s^2/m;
    never smaller than that of a node within it."""


def simplify(model: Model) -> Hierarchy:
    """Hierarchy of a plant.

    Args:
        model: the plant at its finest level.
    """
    influence = static_influence(model)
    skeleton = model.skeleton
    first, stop, hangs_on, child, root = _merge_tree(skeleton.parent, skeleton.stem, skeleton.subtree_end)
    link_frequency = model.stem_frequency[skeleton.stem]
    frequency = node_frequency(model, influence, link_frequency, first, stop)
    lever = joint_lever(model, influence)
    table = mismatch_table(float(model.damping_ratio.mean()))
    error = _node_errors(
        skeleton.parent, first, stop, np.log(link_frequency), np.log(frequency), lever, table
    )
    _raise_to_children(child, root, error)
    return Hierarchy(
        model=model,
        influence=influence,
        shapes=static_shapes(model, influence),
        pressure=stated_pressure(model, influence),
        root=root,
        first=first,
        stop=stop,
        hangs_on=hangs_on,
        child=child,
        lever=lever,
        frequency=frequency,
        error=error,
    )


def node_frequency(
    model: Model, influence: Influence, link_frequency: Doubles, first: Ints, stop: Ints
) -> Doubles:
    """(K,) frequency of each node: the mean of its joints' 1/omega^2, weighted by their elastic energy, rad/s."""
    energy = np.sum(influence.angle**2 / model.rods.compliance[:, :, None], axis=(1, 2)) + 1e-30
    softness = np.concatenate([[0.0], np.cumsum(energy / link_frequency**2)])
    total = np.concatenate([[0.0], np.cumsum(energy)])
    return np.sqrt((total[stop] - total[first]) / (softness[stop] - softness[first]))


def joint_lever(model: Model, influence: Influence) -> Doubles:
    """(L,) how far the joint's static turn moves the farthest point beyond it, per pressure, s^2/m."""
    skeleton = model.skeleton
    turn = np.sqrt(np.linalg.eigvalsh(np.einsum("lki,lkj->lij", influence.angle, influence.angle))[:, -1])
    reach = _reach(skeleton.parent, skeleton.base, skeleton.base + skeleton.vector)
    return turn * reach


@njit(cache=True)
def _reach(parent: Ints, base: Doubles, tip: Doubles) -> Doubles:
    """(L,) distance from each joint to the farthest link end beyond it, m."""
    count = len(parent)
    reach = np.zeros(count)
    for link in range(count):
        up = link
        while up >= 0:
            d = tip[link] - base[up]
            reach[up] = max(reach[up], np.sqrt(np.sum(d * d)))
            up = parent[up]
    return reach


@njit(cache=True)
def _merge_tree(parent: Ints, stem: Ints, end: Ints):  # type: ignore[no-untyped-def]
    """Ranges, carriers and children of all nodes, and the root."""
    count = len(parent)
    first, stop = np.empty(2 * count + 1, np.int32), np.empty(2 * count + 1, np.int32)
    hangs_on = np.empty(2 * count + 1, np.int32)
    child = np.full((2 * count + 1, 2), -1, np.int32)
    first[:count], stop[:count] = np.arange(count), end
    hangs_on[:count] = parent
    nodes = count
    sides = np.empty(count, np.int32)
    for link in range(-1, count):
        # The side stems of a link, in depth-first order: each begins where the one before ends.
        at = link + 1
        limit = count if link < 0 else end[link]
        if link >= 0 and at < limit and stem[at] == stem[link]:
            child[link, 0] = at
            at = end[at]
        found = 0
        while at < limit:
            sides[found] = at
            found += 1
            at = end[at]
        while found > 1:
            # Pair neighbours, over and over: a balanced tree of contiguous ranges.
            paired = 0
            for i in range(0, found, 2):
                if i + 1 == found:
                    sides[paired] = sides[i]
                else:
                    first[nodes], stop[nodes] = first[sides[i]], stop[sides[i + 1]]
                    hangs_on[nodes] = link
                    child[nodes, 0], child[nodes, 1] = sides[i], sides[i + 1]
                    sides[paired] = nodes
                    nodes += 1
                paired += 1
            found = paired
        if link < 0:
            root = sides[0]
        elif found == 1:
            child[link, 1] = sides[0]
    return first[:nodes], stop[:nodes], hangs_on[:nodes], child[:nodes], root


@njit(cache=True)
def _node_errors(  # type: ignore[no-untyped-def]
    parent, first, stop, log_link, log_node, lever, table
):
    """(K,) error of each node's worst tip: its joints' levers times their mismatch, added in squares on the way."""
    count = len(parent)
    error, way = np.zeros(len(first)), np.empty(count)
    for node in range(len(first)):
        a = first[node]
        for link in range(a, stop[node]):
            before = way[parent[link]] if parent[link] >= a else 0.0
            way[link] = np.hypot(before, lever[link] * look_up(table, log_link[link], log_node[node]))
            error[node] = max(error[node], way[link])
    return error


@njit(cache=True)
def way_errors(  # type: ignore[no-untyped-def]
    parent, listens, log_link, log_group, lever, table
):
    """(L,) error of every link within its group of a level, added in squares on the way from the group's carrier."""
    way = np.zeros(len(parent))
    for link in range(len(parent)):
        if listens[link] < 0:
            up = parent[link]
            before = way[up] if up >= 0 and listens[up] == listens[link] else 0.0
            apart = look_up(table, log_link[link], log_group[-1 - listens[link]])
            way[link] = np.hypot(before, lever[link] * apart)
    return way


@njit(cache=True)
def _raise_to_children(child: Ints, root: int, error: Doubles) -> None:
    """No node's error may be smaller than that of a node within it, or a cut by error would not be a cut."""
    order = preorder(child, root)
    for node in order[::-1]:
        for k in range(2):
            if child[node, k] >= 0:
                error[node] = max(error[node], error[child[node, k]])


@njit(cache=True)
def preorder(child: Ints, root: int) -> Ints:
    """(K,) all nodes from the root down, every node before those within it."""
    order, stack = np.empty(len(child), np.int32), [root]
    count = 0
    while len(stack) > 0:
        node = stack.pop()
        order[count] = node
        count += 1
        for k in range(1, -1, -1):
            if child[node, k] >= 0:
                stack.append(child[node, k])
    return order[:count]
