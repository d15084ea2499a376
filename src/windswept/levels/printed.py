"""Beaudoin's merges, as the thesis prints them: merged branches share one averaged angle.

    parent/child   one link in place of a chain of two: fixed length, the stiffness and the inertia that give the
                   chain's static deflection and lowest frequency (closed form; PHYSICS B3 and C3.4)
    child/child    one link in place of all children of a branch: averaged leaf area, length and direction, stiffness
                   averaged by length; the passed-on force is made up to that of all children (C3.2)

The same merge tree and the same kernel serve both kinds of merge: here a group's members all turn by the merged
link's one rotation, and what lies beyond them is carried along rigidly.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numba import njit

from windswept.levels.cut_level import compact_level, walk_cut
from windswept.levels.hierarchy import Hierarchy, preorder
from windswept.motion import Level
from windswept.motion.level import CENTRE, COUPLE, GROUP_MOBILITY, GROUP_STEP, SWAY
from windswept.motion.model import exact_step
from windswept.motion.rods import Doubles

SHORTEST_MEAN = 0.2
"""Opposed children average to a stub: below this share of their mean length the parent's axis is taken (C3.5)."""


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
    model = hierarchy.model
    skeleton, rods = model.skeleton, model.rods
    drag = np.trace(hierarchy.influence.drag, axis1=1, axis2=2) / 3.0
    return PrintedMerges(
        *_merge_all(
            preorder(hierarchy.child, hierarchy.root),
            hierarchy.child,
            skeleton.vector,
            skeleton.attach,
            model.drag.centre,
            drag,
            1.0 / rods.compliance.mean(axis=1),
            rods.mass,
            rods.moment,
            rods.inertia,
            model.joint_inertia.mean(axis=1),
        )
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
    carrier, first = hierarchy.hangs_on[nodes], hierarchy.first[nodes]
    joint = np.where((carrier >= 0)[:, None], skeleton.base[carrier], 0.0)
    frequency = merges.frequency[nodes]
    damping = np.full(len(nodes), hierarchy.model.damping_ratio.mean())
    constants = level.group_constants.copy()
    constants[:, CENTRE : CENTRE + 3] = skeleton.base[first] - joint + arm
    constants[:, COUPLE : COUPLE + 9] = 0.0
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


@njit(cache=True)
def parent_child(k_p, k_c, length_p, length, inertia_p, mass_c, moment_c, inertia_c):  # type: ignore[no-untyped-def]
    """Stiffness and inertia of one link in place of a parent and its only child, in line (PHYSICS B3).

    Args:
        k_p: stiffness of the parent's joint, N m/rad.
        k_c: of the child's.
        length_p: from the parent's joint to the child's, m.
        length: from the parent's joint to the child's tip, m.
        inertia_p: of the parent alone about its joint, kg m^2.
        mass_c: of the child, kg.
        moment_c: first moment of the child about its joint, kg m.
        inertia_c: of the child about its joint, kg m^2.

    Returns:
        Stiffness with the pair's static tip deflection, inertia with its lowest frequency.
    """
    share = (length - length_p) / length
    stiffness = 1.0 / (1.0 / k_p + share * share / k_c)
    # Generalised eigenproblem K x = omega^2 M x in relative angles; 1 / omega^2 is the larger root.
    m12 = length_p * moment_c + inertia_c
    m11 = inertia_p + mass_c * length_p**2 + 2.0 * length_p * moment_c + inertia_c
    a, b, c = m11 / k_p, inertia_c / k_c, m12 / np.sqrt(k_p * k_c)
    slowest = 0.5 * (a + b) + np.sqrt((0.5 * (a - b)) ** 2 + c * c)
    return stiffness, stiffness * slowest


@njit(cache=True)
def _merge_all(  # type: ignore[no-untyped-def]
    order,
    child,
    vector,
    attach,
    drag_centre,
    own_drag,
    own_stiffness,
    own_mass,
    own_moment,
    own_inertia,
    joint_inertia,
):
    """Arm, stiffness, inertia and drag of every node's simplified link, children before parents."""
    count = len(child)
    arm = np.zeros((count, 3))
    stiffness, inertia, drag = np.zeros(count), np.zeros(count), np.zeros(count)
    mass, moment, whole = np.zeros(count), np.zeros(count), np.zeros(count)
    # What the children pass on to the parent together, beside what one averaged child moves by.
    all_stiffness, all_drag = np.zeros(count), np.zeros(count)
    base, number = np.zeros(count), np.ones(count)
    for node in order[::-1]:
        one, other = child[node, 0], child[node, 1]
        if one >= 0 and other >= 0:
            a, b = one, other
        else:
            a = b = max(one, other)
        limb = node < len(attach)
        if a >= 0:
            # Child/child: averages over all the children that the two stand for.
            n = number[a] + (number[b] if b != a else 0.0)
            s = number[a] / n
            la, lb = np.sqrt(np.sum(arm[a] ** 2)), np.sqrt(np.sum(arm[b] ** 2))
            length = s * la + (1.0 - s) * lb
            weight = s * drag[a] * arm[a] / la + (1.0 - s) * drag[b] * arm[b] / lb
            size = np.sqrt(np.sum(weight**2))
            c_drag = s * drag[a] + (1.0 - s) * drag[b]
            if size < SHORTEST_MEAN * c_drag:
                axis = vector[node] if limb else arm[a]
                weight, size = axis, np.sqrt(np.sum(axis**2))
            c_arm = weight / size * length
            wa = s * la / max(length, 1e-12)
            c_stiffness = wa * stiffness[a] + (1.0 - wa) * stiffness[b]
            c_inertia = wa * inertia[a] + (1.0 - wa) * inertia[b]
            c_mass = mass[a] + (mass[b] if b != a else 0.0)
            c_moment = moment[a] + (moment[b] if b != a else 0.0)
            c_whole = whole[a] + (whole[b] if b != a else 0.0)
            k_all = all_stiffness[a] + (all_stiffness[b] if b != a else 0.0)
            drag_all = all_drag[a] + (all_drag[b] if b != a else 0.0)
            c_base = s * base[a] + (1.0 - s) * base[b]
        if not limb:
            arm[node], stiffness[node], inertia[node], drag[node] = c_arm, c_stiffness, c_inertia, c_drag
            mass[node], moment[node], whole[node] = c_mass, c_moment, c_whole
            base[node], number[node], all_stiffness[node], all_drag[node] = c_base, n, k_all, drag_all
            continue
        base[node] = attach[node]
        d = vector[node]
        length_p = np.sqrt(np.sum(d**2))
        if a < 0:
            arm[node], stiffness[node] = drag_centre[node] * d, own_stiffness[node]
            inertia[node], drag[node] = joint_inertia[node], own_drag[node]
            mass[node], moment[node], whole[node] = (
                own_mass[node],
                own_moment[node] * length_p,
                own_inertia[node],
            )
        else:
            arm[node] = c_base * d + c_arm
            length = np.sqrt(np.sum(arm[node] ** 2))
            at = min(c_base * length_p, 0.999 * length)
            stiffness[node], inertia[node] = parent_child(
                own_stiffness[node], k_all, at, length, own_inertia[node], c_mass, c_moment, c_whole
            )
            drag[node] = own_drag[node] + drag_all
            mass[node] = own_mass[node] + c_mass
            moment[node] = own_moment[node] * length_p + c_mass * at + c_moment
            whole[node] = own_inertia[node] + c_mass * at * at + 2.0 * at * c_moment + c_whole
        all_stiffness[node], all_drag[node] = stiffness[node], drag[node]
    return arm, stiffness, inertia, drag
