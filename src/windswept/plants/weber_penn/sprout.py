"""Where the stems of the next order stand on those of the order before, and how they leave them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.plants.weber_penn import frames
from windswept.plants.weber_penn.budget import check_links
from windswept.plants.weber_penn.formulas import child_count, child_length, shape_ratio
from windswept.plants.weber_penn.stems import Shoots, Wood
from windswept.plants.weber_penn.tree import SHORTEST_SEGMENT, Tree

Reals = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Seats:
    """M places along stems, stem after stem, from base to tip."""

    link: Indices
    """(M,) link, counted from its order's first."""
    stem: Indices
    """(M,) stem, counted from its order's first."""
    attach: Reals
    """(M,) where along the link, 0..1."""
    offset: Reals
    """(M,) where along the stem, m."""


def trunk_shoot(tree: Tree) -> Shoots:
    """The one shoot from which the trunk grows, turned by chance about the vertical; BudgetError as in `sprout`."""
    level = tree.growth.at(0)
    check_links(tree, level.curve_res * tree.links_per_segment(0), 0, tree.key(0, "curve_res"))
    heading = tree.streams.vary("trunk heading", 0, np.pi, 1)
    lean = np.radians(level.down_angle + tree.streams.vary("down angle", 0, abs(level.down_angle_v), 1))
    frame = frames.turn_about_x(frames.turn_about_z(frames.upright(1), heading), lean)
    drawn = level.length + tree.streams.vary("length", 0, level.length_v, 1)
    length = np.maximum(drawn, 0.1 * level.length) * tree.scale
    length = np.maximum(length, SHORTEST_SEGMENT * level.curve_res)
    none, one = np.array([-1]), np.ones(1)
    zero = np.zeros(1)
    return Shoots(none, none, zero, np.zeros((1, 3)), frame, length, one, one, zero, zero)


def sprout(tree: Tree, wood: Wood, links_so_far: int) -> Shoots:
    """Place the stems of the next order.

    Args:
        tree: what is grown.
        wood: the order before.
        links_so_far: links of the plant up to now.

    Raises:
        BudgetError: the new stems would make more links than the budget allows.
    """
    order = wood.order + 1
    level = tree.growth.at(order)
    relative_length = wood.stem_length_ratio / max(tree.growth.at(wood.order).length, 1e-9)
    count = child_count(order, level.branches, relative_length, wood.stem_offset_ratio)
    expected = expected_on_links(tree, wood, count)
    links = round(float(expected.sum())) * level.curve_res * tree.links_per_segment(order)
    check_links(tree, links_so_far + links, order, tree.key(order, "branches"))
    seats = take_seats(tree, wood, expected)
    length = _lengths(tree, wood, seats)
    long_enough = length >= SHORTEST_SEGMENT * level.curve_res
    frame = leaving_frames(tree, wood, seats)[long_enough]
    attach, link, stem = seats.attach[long_enough], seats.link[long_enough], seats.stem[long_enough]
    base, thick = wood.link_base[link], wood.link_radius_base[link]
    trunk_scale = wood.stem_length * tree.growth.ratio if wood.order == 0 else wood.stem_radius
    return Shoots(
        parent_stem=wood.first_stem + stem,
        parent_link=wood.first_link + link,
        attach=attach,
        base=base + attach[:, None] * (wood.link_tip[link] - base),
        frame=frame,
        length=length[long_enough],
        offset_ratio=seats.offset[long_enough] / wood.stem_length[stem],
        parent_length=wood.stem_length[stem],
        parent_radius=trunk_scale[stem],
        radius_limit=thick + attach * (wood.link_radius_tip[link] - thick),
    )


def expected_on_links(tree: Tree, wood: Wood, count: Reals) -> Reals:
    """(L,) mean number of children on each link; none on the bare part of the trunk.

    Args:
        tree: what is grown.
        wood: the stems that bear them.
        count: (S,) mean number on a whole, unsplit stem.
    """
    bare = bare_length(tree, wood)
    free = np.maximum(wood.link_z_tip - np.maximum(wood.link_z_base, bare), 0.0)
    usable = np.maximum(wood.stem_length - bare, 1e-9)
    return (count / usable)[wood.link_stem] * wood.link_density * free


def take_seats(tree: Tree, wood: Wood, expected: Reals) -> Seats:
    """Spread children evenly along the links; what is left of a child on one stem is carried to the next.

    Args:
        tree: what is grown.
        wood: the stems that bear them.
        expected: (L,) mean number on each link.
    """
    running = np.cumsum(expected)
    last = float(running[-1]) if len(running) else 0.0
    wanted = np.minimum(np.arange(int(last + 0.5)) + 0.5, last)
    link = np.searchsorted(running, wanted)
    share = 1.0 - (running[link] - wanted) / np.maximum(expected[link], 1e-300)
    z_base, z_tip = wood.link_z_base[link], wood.link_z_tip[link]
    free_from = np.maximum(z_base, bare_length(tree, wood))
    offset = free_from + np.clip(share, 0.0, 1.0) * (z_tip - free_from)
    attach = np.clip((offset - z_base) / (z_tip - z_base), 0.0, 1.0)
    return Seats(link, wood.link_stem[link], attach, offset)


def leaving_frames(tree: Tree, wood: Wood, seats: Seats) -> Reals:
    """(M, 3, 3) frames of stems or leaves that leave their parents at the seats, by rotate and down angle."""
    order = wood.order + 1
    frame = frames.turn_about_z(
        wood.link_frame[seats.link], _turns(tree, order, seats, len(wood.stem_length))
    )
    return frames.turn_about_x(frame, _down_angles(tree, order, wood, seats))


def _turns(tree: Tree, order: int, seats: Seats, stem_count: int) -> Reals:
    """(M,) turn round the parent: on from the child before, or to alternate sides where nRotate < 0, rad."""
    level, count = tree.growth.at(order), len(seats.stem)
    step = np.radians(level.rotate + tree.streams.vary("rotate", order, level.rotate_v, count))
    if level.rotate < 0:
        side = np.where(np.arange(count) % 2 == 0, 1.0, -1.0)
        return side * (np.pi + step)
    first_turn = tree.streams.vary("first rotate", order, np.pi, stem_count)
    so_far = np.cumsum(step)
    first_child = np.searchsorted(seats.stem, seats.stem)
    return first_turn[seats.stem] + so_far - so_far[first_child]


def _down_angles(tree: Tree, order: int, wood: Wood, seats: Seats) -> Reals:
    """(M,) angle to the parent's axis, rad."""
    level = tree.growth.at(order)
    if level.down_angle_v >= 0:
        spread = tree.streams.vary("down angle", order, level.down_angle_v, len(seats.stem))
    else:
        spread = level.down_angle_v * (1.0 - 2.0 * shape_ratio(0, _height_ratio(tree, wood, seats)))
    return np.radians(level.down_angle + spread)


def _lengths(tree: Tree, wood: Wood, seats: Seats) -> Reals:
    """(M,) lengths of the next order's stems, before pruning, m."""
    order = wood.order + 1
    level, parent_length = tree.growth.at(order), wood.stem_length[seats.stem]
    drawn = level.length + tree.streams.vary("length", order, level.length_v, len(seats.stem))
    longest = np.maximum(drawn, 0.0)
    if order > 1:
        return child_length(parent_length, seats.offset, longest)
    return (
        parent_length
        * longest
        * shape_ratio(tree.growth.shape, _height_ratio(tree, wood, seats), tree.growth)
    )


def _height_ratio(tree: Tree, wood: Wood, seats: Seats) -> Reals:
    """(M,) 1 at the foot of the part that bears children, 0 at the parent's tip."""
    length = wood.stem_length[seats.stem]
    return np.clip((length - seats.offset) / np.maximum(length - bare_length(tree, wood), 1e-9), 0.0, 1.0)


def bare_length(tree: Tree, wood: Wood) -> float:
    """Length at the base of the stems that bears no children, m."""
    return tree.bare_length if wood.order == 0 else 0.0
