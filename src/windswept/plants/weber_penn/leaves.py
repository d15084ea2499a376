"""Leaves: the stems of the order after the last, each a blade with an axis and a normal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.plants.weber_penn import frames
from windswept.plants.weber_penn.budget import check_leaves
from windswept.plants.weber_penn.formulas import shape_ratio
from windswept.plants.weber_penn.sprout import Seats, expected_on_links, leaving_frames, take_seats
from windswept.plants.weber_penn.stems import Wood
from windswept.plants.weber_penn.tree import Tree

Reals = NDArray[np.float64]
Indices = NDArray[np.int64]

TAPERED_CYLINDER = 4
"""The shape by which leaves grow denser towards the tip of the stem that bears their stem."""


@dataclass(frozen=True, slots=True)
class Leaves:
    """N leaves of one plant."""

    link: Indices
    """(N,) link, numbered through all orders in the order of growth."""
    position: Reals
    axis: Reals
    normal: Reals
    length: float
    width: float


def grow_leaves(tree: Tree, wood: Wood) -> Leaves:
    """Grow the leaves on the last order of stems.

    Args:
        tree: what is grown.
        wood: the last order.

    Raises:
        BudgetError: there would be more leaves than the budget allows.
    """
    seats, frame = _fans(tree, wood) if tree.growth.leaves < 0 else _rows(tree, wood)
    base = wood.link_base[seats.link]
    position = base + seats.attach[:, None] * (wood.link_tip[seats.link] - base)
    frame = _bent_to_light(frame, position, tree.growth.leaf_bend)
    length = tree.growth.leaf_scale / np.sqrt(tree.growth.leaf_quality)
    width = length * tree.growth.leaf_scale_x
    axis, normal = frame[:, frames.Z], frame[:, frames.Y]
    return Leaves(wood.first_link + seats.link, position, axis, normal, length, width)


def _rows(tree: Tree, wood: Wood) -> tuple[Seats, Reals]:
    """Seats and frames of leaves that stand along their stems."""
    growth = tree.growth
    count = growth.leaves * growth.leaf_quality * shape_ratio(TAPERED_CYLINDER, wood.stem_offset_ratio)
    expected = expected_on_links(tree, wood, count)
    check_leaves(tree, round(float(expected.sum())))
    seats = take_seats(tree, wood, expected)
    return seats, leaving_frames(tree, wood, seats)


def _fans(tree: Tree, wood: Wood) -> tuple[Seats, Reals]:
    """Seats and frames of leaves (Leaves < 0) that spread as a fan of nRotate at the tip of each stem."""
    growth, level = tree.growth, tree.growth.at(wood.order + 1)
    blades = max(1, round(-growth.leaves * growth.leaf_quality))
    stems = len(wood.stem_length)
    check_leaves(tree, stems * blades)
    last_link = np.cumsum(wood.stem_link_count) - 1
    stem = np.repeat(np.arange(stems), blades)
    seats = Seats(last_link[stem], stem, np.ones(len(stem)), wood.stem_length[stem])
    rank = np.tile(np.arange(blades), stems) - 0.5 * (blades - 1)
    sway = tree.streams.vary("rotate", wood.order + 1, level.rotate_v / blades, len(stem))
    down_v = tree.streams.vary("down angle", wood.order + 1, abs(level.down_angle_v), len(stem))
    frame = frames.turn_about_y(wood.link_frame[seats.link], np.radians(rank * level.rotate / blades + sway))
    return seats, frames.turn_about_x(frame, np.radians(level.down_angle + down_v))


def _bent_to_light(frame: Reals, position: Reals, bend: float) -> Reals:
    """Frames whose normals (y) are turned outwards from the trunk and then upwards (Weber and Penn 4.9).

    Args:
        frame: (N, 3, 3) of the leaves.
        position: (N, 3) m.
        bend: LeafBend, 0 as grown to 1 facing the light.
    """
    if bend == 0 or not len(frame):
        return frame
    normal = frame[:, frames.Y]
    outward = np.arctan2(position[:, 1], position[:, 0])
    astray = outward - np.arctan2(normal[:, 1], normal[:, 0])
    astray = np.mod(astray + np.pi, 2.0 * np.pi) - np.pi
    frame = frames.turn_about_axis(frame, np.array([0.0, 0.0, 1.0]), bend * astray)
    normal = frame[:, frames.Y]
    level = np.hypot(normal[:, 0], normal[:, 1])
    across = np.stack((normal[:, 1], -normal[:, 0], np.zeros(len(level))), axis=1)
    axis = np.where(
        (level > 1e-9)[:, None], across / np.maximum(level, 1e-9)[:, None], np.array([1.0, 0.0, 0.0])
    )
    return frames.turn_about_axis(frame, axis, bend * np.arctan2(level, normal[:, 2]))
