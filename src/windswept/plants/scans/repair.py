"""repair: mends what real scans hold, and says so."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from windswept.errors import InputError
from windswept.plants.importers.report import ImportReport
from windswept.plants.scans.cylinders import Cylinders, Indices, Reals

UNIT_SLACK = 1e-3
"""Axes that are longer or shorter than 1 by more than this are reported; all are normalised."""
GAP = 0.02
"""Cylinders that start further from their parent than its radius and this are reported, m."""
GROUND = 0.5
"""Further roots that start less than this above the lowest one are trunks of their own, m."""
REACH = 1.0
"""Further roots in the air are joined to the tree if it comes as near as this, else left out, m."""


def repair(source: str, cylinders: Cylinders, report: ImportReport, clamp_radii: bool = False) -> Cylinders:
    """Cylinders with unit axes, parents before children, standing on the origin.

    Args:
        source: the file, for errors.
        cylinders: as read.
        report: gets a line for everything that was mended.
        clamp_radii: let no cylinder be thicker than its parent; scans hold such, and by default they stay.

    Raises:
        InputError: the parents form a cycle.
    """
    axis_length = np.linalg.norm(cylinders.axis, axis=1)
    _note(report, np.abs(axis_length - 1.0) > UNIT_SLACK, "axes normalised")
    mended = replace(cylinders, axis=cylinders.axis / axis_length[:, None])
    late = mended.parent >= np.arange(mended.count)
    _note(report, late, "parents stood after their children")
    order = _parents_first(source, mended.parent)
    mended = _join_roots(mended.rows(order) if late.any() else mended, report)
    _note(report, _gaps(mended) > GAP, "gaps closed")
    has_parent = mended.parent >= 0
    thicker = has_parent & (mended.radius > 1.0001 * mended.radius[mended.parent])
    _note(
        report, thicker, "thicker than their parents, " + ("clamped" if clamp_radii else "left as they are")
    )
    if clamp_radii:
        mended = replace(mended, radius=_clamped(mended))
    root = mended.start[mended.parent < 0]
    return replace(mended, start=mended.start - root[np.argmin(root[:, 2])])


def _note(report: ImportReport, mask: np.ndarray, what: str) -> None:
    """Report how many cylinders something was true of."""
    count = int(mask.sum())
    if count:
        report.repaired.append(f"{what} ({count})")


def _parents_first(source: str, parent: Indices) -> Indices:
    """Order in which parents come before children, breadth first from the roots."""
    by_parent = np.argsort(parent, kind="stable")
    first_child = np.searchsorted(parent[by_parent], np.arange(len(parent) + 1))
    order = list(np.flatnonzero(parent < 0))
    for cylinder in order:
        order.extend(by_parent[first_child[cylinder] : first_child[cylinder + 1]])
    if len(order) < len(parent):
        row = int(np.setdiff1d(np.arange(len(parent)), order)[0])
        raise InputError(
            source, f"cylinder {row + 1}, parent", int(parent[row]) + 1, "parents without a cycle"
        )
    return np.array(order)


def _join_roots(cylinders: Cylinders, report: ImportReport) -> Cylinders:
    """Join further roots in the air to the nearest wood; what is too far away is left out."""
    roots = np.flatnonzero(cylinders.parent < 0)
    if len(roots) == 1:
        return cylinders
    tree = _root_of(cylinders.parent)
    volume = np.bincount(tree, cylinders.radius**2 * cylinders.length, cylinders.count)
    main = roots[np.argmax(volume[roots])]
    parent, kept = cylinders.parent.copy(), tree == main
    own, joined = 0, 0
    for root in roots[np.argsort(-volume[roots], kind="stable")][1:]:
        if cylinders.start[root, 2] - cylinders.start[main, 2] <= GROUND:
            own, kept = own + 1, kept | (tree == root)
            continue
        candidate = np.flatnonzero(kept)
        distance = _distance(cylinders, candidate, cylinders.start[root])
        if distance.min() <= REACH:
            parent[root] = candidate[np.argmin(distance)]
            joined, kept = joined + 1, kept | (tree == root)
    for count, what in (
        (own, "further roots on the ground kept as trunks"),
        (joined, "further roots joined"),
    ):
        if count:
            report.repaired.append(f"{what} ({count})")
    _note(report, ~kept, "far from the tree, left out")
    whole = cylinders.with_parents(parent)
    wanted = np.flatnonzero(kept)
    order = _parents_first("", parent)
    return whole.rows(order[np.isin(order, wanted)])


def _root_of(parent: Indices) -> Indices:
    """(C,) root of each cylinder's tree."""
    root = np.where(parent < 0, np.arange(len(parent)), parent)
    while (parent[root] >= 0).any():
        root = np.where(parent[root] < 0, root, root[root])
    return root


def _distance(cylinders: Cylinders, which: Indices, point: Reals) -> Reals:
    """Distance of a point from the axes of some cylinders, m."""
    axis, offset = cylinders.axis[which], point - cylinders.start[which]
    along = np.clip(np.einsum("ij,ij->i", offset, axis), 0.0, cylinders.length[which])
    return np.linalg.norm(offset - along[:, None] * axis, axis=1)


def _gaps(cylinders: Cylinders) -> Reals:
    """(C,) by how much a cylinder starts outside its parent's surface, m."""
    child = np.flatnonzero(cylinders.parent >= 0)
    gap = np.zeros(cylinders.count)
    up = cylinders.parent[child]
    axis, offset = cylinders.axis[up], cylinders.start[child] - cylinders.start[up]
    along = np.clip(np.einsum("ij,ij->i", offset, axis), 0.0, cylinders.length[up])
    gap[child] = np.linalg.norm(offset - along[:, None] * axis, axis=1) - cylinders.radius[up]
    return gap


def _clamped(cylinders: Cylinders) -> Reals:
    """(C,) radii that do not grow outward."""
    radius = cylinders.radius.copy()
    for child in np.flatnonzero(cylinders.parent >= 0):
        radius[child] = min(radius[child], radius[cylinders.parent[child]])
    return radius
