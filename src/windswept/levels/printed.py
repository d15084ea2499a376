"""Beaudoin's merges, as the thesis prints them: merged branches share one averaged angle.

    parent/child   one link in place of a chain of two: fixed length, the stiffness and the inertia that give the
                   chain's static deflection and lowest frequency, from the tables of simulated pairs (pair_table.py)
    child/child    one link in place of all children of a branch: averaged leaf area, length and direction, stiffness
                   averaged by length

The same merge tree and the same kernel serve both kinds of merge: here a group's members all turn by the merged
link's one rotation, and what lies beyond them is carried along rigidly. What a group passes on is the drag of all its
leaves and wood where they are, not that of the averaged leaf: the propagation factors of the thesis, corrected so that
the trunk feels the same static force and moment at every level (C3.1, C3.2).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numba import njit

from windswept.levels.cut_level import compact_level, walk_cut
from windswept.levels.hierarchy import Hierarchy, preorder
from windswept.levels.pair_table import equal_rods, look_up_rate, look_up_stiffness, pair_table
from windswept.motion import Level
from windswept.motion.exact_step import exact_step
from windswept.motion.level import GROUP_MOBILITY, GROUP_STEP, SWAY
from windswept.motion.rods import Doubles
from windswept.plants.plant import Ints

SHORTEST_MEAN = 0.2
"""Opposed children average to a stub: below this share of their mean length the parent's axis is taken (C3.5)."""

SUM_COUNT = 13
"""Columns of the sums over the children of one link, by the numbers below; a child/child merge adds two rows up."""
NUMBER, LENGTH, DIRECTION, BASE = 0, 1, 2, 5
"""Of children; of their lengths, m; of drag x unit vector, kg/m; of the fraction along the parent."""
STIFFNESS, MASS, MOMENT, INERTIA, DRAG = 6, 7, 8, 9, 10
"""N m/rad; kg; kg m and kg m^2 about their own joints, as if they were rigid; kg/m."""
STRENGTH, SLOWNESS = 11, 12
"""Of length x stiffness; of length x the inertia with which a child swings at its own frequency."""


@dataclass(frozen=True, slots=True)
class PrintedMerges:
    """The simplified link of each of the K nodes of a hierarchy."""

    arm: Doubles
    """(K, 3) from the simplified link's joint to where its leaf is, m."""
    stiffness: Doubles
    """(K,) N m/rad."""
    inertia: Doubles
    """(K,) about its joint, kg m^2."""
    drag: Doubles
    """(K,) its averaged leaf's drag per pressure, kg/m."""

    @property
    def frequency(self) -> Doubles:
        """(K,) angular frequency, rad/s."""
        return np.sqrt(self.stiffness / self.inertia)


def printed_merges(hierarchy: Hierarchy) -> PrintedMerges:
    """Simplified links, from the tips to the trunk."""
    model, table = hierarchy.model, pair_table()
    vector, carrier = model.skeleton.vector, hierarchy.hangs_on
    sums = np.zeros((len(hierarchy.child), SUM_COUNT))
    sums[: model.link_count] = _single_links(hierarchy)
    order = preorder(hierarchy.child, hierarchy.root)
    _merge_all(order, hierarchy.child, vector, sums, table.displacement, table.rate, table.single)
    axis = np.where((carrier >= 0)[:, None], vector[carrier], np.array([0.0, 0.0, 1.0]))
    direction = np.array([_mean_direction(row, along) for row, along in zip(sums, axis, strict=True)])
    inertia = sums[:, SLOWNESS] / sums[:, LENGTH]
    # A link that nothing grows from keeps its own oscillator, whose frequency is that of its stem.
    bare = np.flatnonzero((hierarchy.child[: model.link_count] < 0).all(axis=1))
    inertia[bare] = model.joint_inertia[bare].mean(axis=1)
    number = sums[:, NUMBER]
    return PrintedMerges(
        arm=direction * (sums[:, LENGTH] / number)[:, None],
        stiffness=sums[:, STRENGTH] / sums[:, LENGTH],
        inertia=inertia,
        drag=sums[:, DRAG] / number,
    )


def printed_level(hierarchy: Hierarchy, merges: PrintedMerges, tolerance: float) -> Level:
    """The level that cuts where our own merges would, moved by the printed ones.

    Args:
        hierarchy: of the plant.
        merges: its simplified links.
        tolerance: as for `cut_level`.
    """
    merged = hierarchy.error <= tolerance
    limbs = hierarchy.model.link_count
    links, nodes = walk_cut(hierarchy.child, hierarchy.root, merged, limbs)
    nodes = nodes[np.argsort(hierarchy.hangs_on[nodes], kind="stable")]
    level = compact_level(hierarchy, np.sort(links), nodes)
    skeleton, arm = hierarchy.model.skeleton, merges.arm[nodes]
    rotation = (merges.drag[nodes] / merges.stiffness[nodes])[:, None, None] * _cross_matrix(arm)
    sway = -np.einsum("gij,gjk->gik", _cross_matrix(arm), rotation)
    carrier = hierarchy.hangs_on[nodes]
    frequency = merges.frequency[nodes]
    damping = np.full(len(nodes), hierarchy.model.damping_ratio.mean())
    constants = level.group_constants.copy()
    constants[:, SWAY : SWAY + 9] = sway.reshape(-1, 9)
    constants[:, GROUP_MOBILITY] = level.time_step * frequency**2 * np.linalg.norm(sway, ord=2, axis=(1, 2))
    constants[:, GROUP_STEP : GROUP_STEP + 4] = exact_step(frequency, damping, level.time_step)
    shapes = np.zeros_like(level.shapes)
    # Only the joints at which the group's members hang on the carrier turn.
    listens = level.listens
    group = -1 - listens
    own = (listens < 0) & (skeleton.parent == np.where(listens < 0, carrier[np.maximum(group, 0)], -2))
    shapes[own, :, :3] = np.einsum("lki,lij->lkj", skeleton.axes[own], rotation[group[own]])
    return replace(level, group_constants=constants, group_frequency=frequency, shapes=shapes)


def _cross_matrix(vectors: Doubles) -> Doubles:
    """(n, 3, 3) matrices whose product with a vector is the cross product of (n, 3) vectors with it."""
    x, y, z = vectors.T
    zero = np.zeros_like(x)
    rows = [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
    return np.array(rows).transpose(2, 0, 1)


def _single_links(hierarchy: Hierarchy) -> Doubles:
    """(L, SUM_COUNT) every link as an only child of which nothing grows."""
    model = hierarchy.model
    skeleton, rods = model.skeleton, model.rods
    unit = skeleton.vector / skeleton.length[:, None]
    sums = np.empty((model.link_count, SUM_COUNT))
    sums[:, NUMBER] = 1.0
    sums[:, LENGTH] = model.drag.centre * skeleton.length
    sums[:, DRAG] = np.trace(hierarchy.influence.drag, axis1=1, axis2=2) / 3.0
    sums[:, DIRECTION : DIRECTION + 3] = sums[:, DRAG, None] * unit
    sums[:, BASE] = skeleton.attach
    sums[:, STIFFNESS] = 1.0 / rods.compliance.mean(axis=1)
    sums[:, MASS], sums[:, MOMENT], sums[:, INERTIA] = rods.mass, rods.moment * skeleton.length, rods.inertia
    sums[:, STRENGTH] = sums[:, LENGTH] * sums[:, STIFFNESS]
    sums[:, SLOWNESS] = sums[:, LENGTH] * sums[:, INERTIA]
    return sums


@njit(cache=True)
def _merge_all(  # type: ignore[no-untyped-def]
    order: Ints, child: Ints, vector: Doubles, sums: Doubles, displacement, rate, single
) -> None:
    """Sums of every node, children before parents; those of single links come in and are replaced."""
    for node in order[::-1]:
        beyond = np.zeros(SUM_COUNT)
        for k in range(2):
            if child[node, k] >= 0:
                beyond += sums[child[node, k]]
        if node >= len(vector):
            sums[node] = beyond
        elif beyond[NUMBER] > 0.0:
            merge_parent_child(sums[node], vector[node], beyond, displacement, rate, single)


@njit(cache=True)
def merge_parent_child(parent, vector, beyond, displacement, rate, single):  # type: ignore[no-untyped-def]
    """One link in place of a link and the averaged child that grows from it.

    The child turns about its joint with all its children's stiffness, mass and drag, and swings at its own frequency
    while the parent is still.

    Args:
        parent: (SUM_COUNT,) the parent as an only child; overwritten with the merged link.
        vector: (3,) the parent from base to tip, m.
        beyond: (SUM_COUNT,) sums over its children.
        displacement: of the table of pairs.
        rate: of the table of pairs.
        single: of the table of pairs.
    """
    k_p, size = parent[STIFFNESS], np.sqrt(np.sum(vector**2))
    unit, direction = vector / size, _mean_direction(beyond, vector)
    length_p = beyond[BASE] / beyond[NUMBER] * size
    length_c = beyond[LENGTH] / beyond[NUMBER]
    cosine = min(max(np.sum(unit * direction), -1.0), 1.0)
    angle = min(np.arccos(cosine), 0.5 * np.pi)
    ratio = length_c / max(length_p, 1e-9 * length_c)
    stiffness = k_p * look_up_stiffness(displacement, single, beyond[STIFFNESS] / k_p, ratio, angle)

    mass, moment_c = beyond[MASS] * length_p, beyond[MOMENT]
    inertia = parent[INERTIA] + mass * length_p + 2.0 * length_p * moment_c * cosine + beyond[INERTIA]
    rods, density, share = equal_rods(length_p, angle, inertia, moment_c, beyond[INERTIA])
    spring = share * beyond[STRENGTH] / beyond[SLOWNESS] * inertia / k_p
    pace = look_up_rate(rate, single, spring, rods, angle, density)

    arm = length_p * unit + length_c * direction
    length = np.sqrt(np.sum(arm**2))
    parent[MOMENT] = np.sum(arm * ((parent[MOMENT] + mass) * unit + moment_c * direction)) / length
    parent[MASS] += beyond[MASS]
    parent[DRAG] += beyond[DRAG]
    parent[DIRECTION : DIRECTION + 3] = parent[DRAG] * arm / length
    parent[LENGTH], parent[STIFFNESS], parent[INERTIA] = length, stiffness, inertia
    parent[STRENGTH] = length * stiffness
    parent[SLOWNESS] = length * stiffness * inertia / (k_p * pace**2)


@njit(cache=True)
def _mean_direction(sums, axis):  # type: ignore[no-untyped-def]
    """Unit vector of the averaged child, or of the axis that carries the children where they point apart."""
    mean = sums[DIRECTION : DIRECTION + 3]
    if np.sqrt(np.sum(mean**2)) < SHORTEST_MEAN * sums[DRAG]:
        mean = axis
    return mean / np.sqrt(np.sum(mean**2))
