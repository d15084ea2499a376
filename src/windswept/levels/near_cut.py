"""near_cut: a level for one large plant near the camera, finer in its near branches than in its far ones."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numba import njit

from windswept.levels.choose import NEAREST, Eye
from windswept.levels.cut_level import cut_level
from windswept.levels.hierarchy import Hierarchy, preorder
from windswept.levels.ladder import Ladder
from windswept.motion import Level
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats


@dataclass(frozen=True, slots=True)
class NodeBalls:
    """Balls that hold what each of K nodes moves, at rest."""

    centre: Doubles
    """(K, 3) m."""
    radius: Doubles
    """(K,) m."""


def node_balls(hierarchy: Hierarchy) -> NodeBalls:
    """Balls round the boxes of all nodes.

    Args:
        hierarchy: of the plant.
    """
    skeleton = hierarchy.model.skeleton
    tip = skeleton.base + skeleton.vector
    low, high = _boxes(
        preorder(hierarchy.child, hierarchy.root),
        hierarchy.child,
        np.minimum(skeleton.base, tip),
        np.maximum(skeleton.base, tip),
    )
    return NodeBalls(0.5 * (low + high), 0.5 * np.linalg.norm(high - low, axis=1))


def near_cut(ladder: Ladder, balls: NodeBalls, eye: Eye, position: Floats, coupled: bool = False) -> Level:
    """The coarsest level whose error is nowhere seen, branch by branch.

    Args:
        ladder: of the plant.
        balls: of its nodes.
        eye: who looks.
        position: (3,) of the eye in the plant's frame, m.
        coupled: whether by `multibody`.
    """
    away = np.linalg.norm(balls.centre - position, axis=1) - balls.radius
    tolerance = node_tolerance(ladder, eye.metres(np.maximum(away, NEAREST)), coupled)
    return replace(cut_level(ladder.hierarchy, tolerance), coupled=coupled)


def node_tolerance(ladder: Ladder, metres: Doubles, coupled: bool = False) -> Doubles:
    """(K,) reckoned error at which a node may be merged so that its error comes out below so many metres."""
    cuts = ladder.merged(coupled)
    if len(cuts) == 0:
        return np.full(len(metres), -1.0)
    error, tolerance = np.log(ladder.error[cuts] + 1e-30), np.log(ladder.tolerance[cuts] + 1e-30)
    between = np.exp(np.interp(np.log(metres), error, tolerance))
    return np.where(metres < np.exp(error[0]), -1.0, between)


@njit(cache=True)
def _boxes(order, child, link_low, link_high):  # type: ignore[no-untyped-def]
    """(K, 3) lowest and highest corner of every node's links; a limb has a link of its own beside its children."""
    low, high = np.full((len(child), 3), np.inf), np.full((len(child), 3), -np.inf)
    low[: len(link_low)], high[: len(link_high)] = link_low, link_high
    for node in order[::-1]:
        for k in range(2):
            if child[node, k] >= 0:
                low[node] = np.minimum(low[node], low[child[node, k]])
                high[node] = np.maximum(high[node], high[child[node, k]])
    return low, high
