"""Plant -> Branches: one cubic Bezier a stem, how it sits on its parent, and how far the wind bends it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from windswept.motion.bend_branches import ROOT_FRAME, Branches
from windswept.motion.bend_plain import curve_frame
from windswept.motion.drag import Drag, build_drag
from windswept.motion.rods import build_rods, link_length
from windswept.motion.skeleton import build_skeleton
from windswept.plants.air import reconfiguration
from windswept.plants.plant import Floats, Ints, Plant
from windswept.wind.mean import Profile, profile_factor

Doubles = NDArray[np.float64]

LEAF_SPEED = 8.0
"""Wind at which leaves are as folded as ``bend`` takes them to be at any wind, m/s: a fresh breeze."""
PROFILE = Profile()
"""How the wind falls off from a branch's tip to what else grows on it: much the same in any open land."""
STIFFENING = 1e-3
"""How strongly a curve with too few points to fit holds to its chord, over the weight of one point."""


def plant_branches(plant: Plant) -> Branches:
    """Branches of one plant that stands at the origin.

    Args:
        plant: what was grown. Stems whose curves one cubic does not meet are drawn smoother than they grew.
    """
    fraction, curves = _node_fraction(plant), fit_curves(plant)
    parent, attach = _attach(plant, fraction)
    order, level_start = _level_order(parent)
    points, side = np.zeros_like(curves), np.zeros((plant.stem_count, 3))
    legs_in_frame, side_in_frame, origin = np.zeros((plant.stem_count, 3, 3)), side.copy(), side.copy()
    for first, end in pairwise(level_start):
        stem = order[first:end]
        if first == 0:
            base, frame = np.zeros((end, 3)), np.broadcast_to(ROOT_FRAME, (end, 3, 3))
            origin[stem] = curves[stem, 0]
        else:
            above = parent[stem]
            base, frame = curve_frame(points[above], side[above], attach[stem])
            origin[stem] = origin[above]
        points[stem] = curves[stem] + (base - curves[stem, 0])[:, None]
        legs = np.diff(points[stem], axis=1)
        side[stem] = _first_side(legs[:, 0], frame)
        legs_in_frame[stem] = np.einsum("nik,njk->nij", legs, frame)
        side_in_frame[stem] = np.einsum("nk,njk->nj", side[stem], frame)
    row = np.empty(plant.stem_count, np.int64)
    row[order] = np.arange(plant.stem_count)
    return Branches(
        parent=np.where(parent < 0, -1, row[parent])[order].astype(np.int32),
        level_start=level_start,
        attach=attach[order].astype(np.float32),
        legs=legs_in_frame[order].astype(np.float32),
        side=side_in_frame[order].astype(np.float32),
        flexibility=stem_flexibility(plant)[order].astype(np.float32),
        tip=(origin + points[:, 3])[order].astype(np.float32),
        origin=origin[order].astype(np.float32),
        stem=order.astype(np.int32),
        placement=np.zeros(plant.stem_count, np.int32),
    )


def fit_curves(plant: Plant) -> Doubles:
    """(S, 4, 3) one cubic Bezier a stem: from its base to its tip, nearest to its nodes in between.

    Least squares for the two inner control points at chord-length parameters; a stem of one link is straight.
    """
    stems, stem, t = plant.stem_count, plant.link_stem, _node_fraction(plant)
    start = plant.link_base[plant.stem_link_start[:-1]].astype(np.float64)
    end = plant.link_tip[plant.stem_link_start[1:] - 1].astype(np.float64)
    s = 1.0 - t
    first, second = 3.0 * s * s * t, 3.0 * s * t * t
    straight = start[stem] + t[:, None] * (end - start)[stem]
    aside = plant.link_tip - straight
    a11 = np.bincount(stem, first * first, stems) + STIFFENING
    a12 = np.bincount(stem, first * second, stems)
    a22 = np.bincount(stem, second * second, stems) + STIFFENING
    right = np.stack(
        [
            [np.bincount(stem, weight * aside[:, k], stems) for k in range(3)] for weight in (first, second)
        ]  # (2, 3, S)
    )
    scale = 1.0 / (a11 * a22 - a12 * a12)
    lift_first = (scale * (a22 * right[0] - a12 * right[1])).T
    lift_second = (scale * (a11 * right[1] - a12 * right[0])).T
    chord = (end - start) / 3.0
    return np.stack([start, start + chord + lift_first, end - chord + lift_second, end], axis=1)


def stem_flexibility(plant: Plant) -> Doubles:
    """(S,) bend factor per squared wind at its tip of every stem clamped at its base, 1/(m/s)^2.

    The static deflection of the tip, d = sum over joints of compliance x moment x distance to the tip, with all
    that grows on the stem pushed by the same wind. A beam bends by d = 2/3 L b (C1.11), so b = 3 d / (2 L).
    """
    skeleton, drag = build_skeleton(plant), build_drag(plant)
    centre = skeleton.base + drag.centre[:, None] * skeleton.vector
    push = _push(plant, drag, skeleton.vector) * profile_factor(PROFILE, centre[:, 2]) ** 2
    beyond = _subtree_sum(push, skeleton.subtree_end)
    middle = _subtree_sum(push[:, None] * centre, skeleton.subtree_end) / beyond[:, None]
    moment = beyond * np.linalg.norm(middle - skeleton.base, axis=1)
    tip = plant.link_tip[plant.stem_link_start[1:] - 1].astype(np.float64)
    reach = np.linalg.norm(tip[plant.link_stem] - skeleton.base, axis=1)
    compliance = build_rods(plant).compliance.mean(axis=1)
    deflection = np.bincount(plant.link_stem, compliance * moment * reach, plant.stem_count)
    length = np.bincount(plant.link_stem, link_length(plant), plant.stem_count)
    return np.asarray(1.5 * deflection / length / profile_factor(PROFILE, tip[:, 2]) ** 2, np.float64)


def _push(plant: Plant, drag: Drag, vector: Doubles) -> Doubles:
    """(L,) force on each link per squared wind, kg/m: the mean over all horizontal winds."""
    fold = float(reconfiguration(plant.material, np.array(LEAF_SPEED)))
    level_share = np.sum(vector[:, :2] ** 2, axis=1) / np.sum(vector**2, axis=1)
    leaf, wood = 0.5 * (drag.leaf[:, 0] + drag.leaf[:, 1]), drag.wood * (1.0 - 0.5 * level_share)
    return np.asarray(fold * leaf + wood + 1e-30, np.float64)


def _subtree_sum(per_link: Doubles, subtree_end: Ints) -> Doubles:
    """Sum over each link's subtree, of any trailing shape."""
    summed = np.concatenate([np.zeros((1, *per_link.shape[1:])), np.cumsum(per_link, axis=0)])
    return np.asarray(summed[subtree_end] - summed[:-1], np.float64)


def _node_fraction(plant: Plant) -> Doubles:
    """(L,) share of its stem's length that lies before each link's tip."""
    length = link_length(plant)
    total = np.cumsum(length)
    before = (total - length)[plant.stem_link_start[:-1]]
    whole = np.bincount(plant.link_stem, length, plant.stem_count)
    return np.asarray((total - before[plant.link_stem]) / whole[plant.link_stem], np.float64)


def _attach(plant: Plant, fraction: Doubles) -> tuple[Ints, Doubles]:
    """(S,) parent stem or -1, and the parameter on its curve: the share of its length, as in the fit."""
    first = plant.stem_link_start[:-1]
    link = plant.link_parent[first]
    parent = np.where(link < 0, -1, plant.link_stem[link])
    is_first = plant.stem_link_start[plant.link_stem] == np.arange(plant.link_count)
    before = np.where(is_first, 0.0, np.roll(fraction, 1))
    within = plant.link_attach[first] * (fraction - before)[link]
    return parent.astype(np.int32), np.where(link < 0, 0.0, before[link] + within)


def _level_order(parent: Ints) -> tuple[Ints, Ints]:
    """Stems by level and then by their parent's place, and where each level starts (D+1,)."""
    levels, stems = [np.flatnonzero(parent < 0)], np.arange(len(parent))
    while True:
        place = np.full(len(parent), -1)
        place[levels[-1]] = np.arange(len(levels[-1]))
        rank = np.where(parent < 0, -1, place[parent])
        below = stems[rank >= 0]
        if len(below) == 0:
            break
        levels.append(below[np.argsort(rank[below], kind="stable")])
    sizes = [len(level) for level in levels]
    return np.concatenate(levels).astype(np.int32), np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32)


def _first_side(leg: Doubles, frame: Doubles) -> Floats | Doubles:
    """(n, 3) Skjermo's S0 = L0 x O, normalised, with O the parent's direction; its S where the two are parallel."""
    heading = leg / np.linalg.norm(leg, axis=1, keepdims=True)
    side = np.cross(heading, frame[:, 0])
    spare = frame[:, 1] - np.sum(frame[:, 1] * heading, axis=1, keepdims=True) * heading
    side = np.where(np.linalg.norm(side, axis=1, keepdims=True) > 1e-3, side, spare)
    return side / np.linalg.norm(side, axis=1, keepdims=True)
