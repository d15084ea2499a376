"""Centre lines of all stems of one order, grown together segment by segment: curving and splitting.

Lengths are counted in segments here: a stem's shape does not depend on its length, which pruning settles later.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.plants.species_form import Level
from windswept.plants.weber_penn import frames
from windswept.plants.weber_penn.budget import check_links
from windswept.plants.weber_penn.streams import Streams, vary
from windswept.plants.weber_penn.tree import Tree

Reals = NDArray[np.float64]
Indices = NDArray[np.int64]

HELIX_SEGMENTS = 8
"""A helix (negative nCurveV) makes one turn in this many segments, or over the stem where it has fewer."""
GOLDEN = 0.6180339887498949
"""Steps of the golden ratio spread the phases of the stems' split errors as evenly as can be."""
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, slots=True)
class Axes:
    """Centre lines of S stems of one order in T segments, stem after stem, base to tip; F are not clones."""

    family: Indices
    """(S,) which shoot the stem grew from; clones belong to the shoot of the stem they continue."""
    mother: Indices
    """(S,) stem that a clone continues, -1 for stems that are not clones."""
    start: Indices
    """(S,) first segment the stem has of its own: 0 but for clones."""
    segment_stem: Indices
    """(T,)"""
    segment_index: Indices
    """(T,) 0..nCurveRes-1."""
    segment_base: Reals
    """(T, 3) from the shoot's base, in segments."""
    segment_frame: Reals
    """(T, 3, 3) z is the segment's direction."""
    segment_density: Reals
    """(T,) child stems per segment against an unsplit stem."""


def grow_axes(tree: Tree, order: int, frame: Reals, links_so_far: int) -> Axes:
    """Grow the centre lines of one order.

    Args:
        tree: what is grown.
        order: branching order.
        frame: (F, 3, 3) frames in which the stems leave their parents.
        links_so_far: links of the orders before, which count towards the budget.

    Raises:
        BudgetError: splitting would make more links than the budget allows.
    """
    level = tree.growth.at(order)
    front = _Front(tree, order, frame, links_so_far)
    for segment in range(level.curve_res):
        if segment:
            front.curve(segment)
        front.advance(segment)
        if segment < level.curve_res - 1:
            front.split(segment)
    return front.axes()


class _Front:
    """The growing ends of all stems of one order, in step."""

    def __init__(self, tree: Tree, order: int, frame: Reals, links_so_far: int) -> None:
        count = len(frame)
        self._tree, self._order, self._level = tree, order, tree.growth.at(order)
        self._links_so_far = links_so_far
        self._frame, self._tip = frame, np.zeros((count, 3))
        self._family, self._mother = np.arange(count), np.full(count, -1)
        self._start, self._density = np.zeros(count, np.int64), np.ones(count)
        self._correction = np.zeros(count)
        self._records: list[tuple[Reals, Reals, Reals]] = []
        self._random = _generators(tree.streams, order)
        self._split_phase = self._random["split phase"].random()

    def curve(self, segment: int) -> None:
        """Turn every growing end by its curve, a random part, and the pull upwards."""
        level, count = self._level, len(self._frame)
        turn = np.radians(_curve_step(level, segment)) - self._correction
        frame = frames.turn_about_x(self._frame, turn)
        if level.curve_v > 0:
            wobble = vary(self._random["curve"], np.radians(level.curve_v) / level.curve_res, count)
            heading = vary(self._random["curve heading"], np.pi, count)
            frame = frames.tip_towards(frame, heading, wobble)
        attraction = self._tree.growth.attraction_up
        if self._order >= 2 and attraction:
            frame = _pulled_up(frame, attraction / level.curve_res)
        self._frame = frame

    def advance(self, segment: int) -> None:
        """Add a segment to every stem."""
        frame = self._frame
        if self._level.curve_v < 0:
            frame = _on_helix(frame, self._level, segment)
        self._records.append((self._tip, frame, self._density))
        self._tip = self._tip + frame[:, frames.Z]

    def split(self, segment: int) -> None:
        """Let the stems whose turn it is fork; a clone is a stem of its own.

        The next curve already takes back a share of the tilt, so the fork is opened by as much more: its first
        segments stand at the tilt, whatever remains.
        """
        clone_count = self._clone_count(segment)
        if not clone_count.any():
            return
        remaining = self._level.curve_res - segment - 1
        self._check_budget(int(clone_count.sum()), segment, remaining)
        mother = np.repeat(np.arange(len(clone_count)), clone_count)
        forked = clone_count > 0
        tilt = np.where(forked, self._tilt("split angle", self._frame), 0.0)
        clone_tilt = self._tilt("clone split angle", self._frame[mother])
        clone = frames.turn_about_x(self._frame[mother], clone_tilt * (1.0 + 1.0 / remaining))
        clone = frames.turn_about_axis(clone, _UP, self._spread(segment, clone_count, mother))
        forked_frame = frames.turn_about_x(self._frame, tilt * (1.0 + 1.0 / remaining))
        density = self._density / (clone_count + 1)
        self._frame = np.concatenate((forked_frame, clone))
        self._tip = np.concatenate((self._tip, self._tip[mother]))
        self._density = np.concatenate((density, density[mother]))
        correction = np.concatenate((self._correction, self._correction[mother]))
        self._correction = correction + np.concatenate((tilt, clone_tilt)) / remaining
        self._family = np.concatenate((self._family, self._family[mother]))
        self._mother = np.concatenate((self._mother, mother))
        self._start = np.concatenate((self._start, np.full(len(mother), segment + 1)))

    def _clone_count(self, segment: int) -> Indices:
        """(S,) clones of every stem at the end of a segment; each stem carries its own fraction onwards."""
        count, splits = len(self._frame), self._level.seg_splits
        if self._order == 0 and segment == 0 and self._tree.growth.base_splits:
            return np.full(count, self._tree.growth.base_splits)
        phase = np.mod(self._split_phase + GOLDEN * np.arange(count), 1.0)
        after, before = (np.floor((segment + step) * splits + phase) for step in (1, 0))
        return (after - before).astype(np.int64)

    def _tilt(self, name: str, frame: Reals) -> Reals:
        """(n,) angle by which a fork opens; stems that lean already open less, rad."""
        level = self._level
        angle = np.radians(level.split_angle + vary(self._random[name], level.split_angle_v, len(frame)))
        return np.maximum(0.0, angle - frames.declination(frame))

    def _spread(self, segment: int, clone_count: Indices, mother: Indices) -> Reals:
        """(n,) turn of every clone about the vertical, rad; the clones of a trunk's foot stand all round."""
        wobble = vary(self._random["spread"], 1.0, len(mother))
        chance = self._random["spread size"].random(len(mother))
        if self._order == 0 and segment == 0 and self._tree.growth.base_splits:
            rank = np.arange(len(mother)) - np.repeat(np.cumsum(clone_count) - clone_count, clone_count)
            sector = (rank + 1) * 360.0 / (clone_count[mother] + 1)
            return np.radians(sector + wobble * self._level.split_angle_v)
        lean = np.degrees(frames.declination(self._frame[mother]))
        size = 20.0 + 0.75 * (30.0 + np.abs(lean - 90.0)) * chance**2
        return np.radians(np.where(wobble < 0.0, -size, size))

    def _check_budget(self, clones: int, segment: int, remaining: int) -> None:
        """Count the links that forking here makes before anything is allocated for them."""
        own = [len(record[2]) for record in self._records]
        segments = sum(own) + (len(self._frame) + clones) * remaining
        links = self._links_so_far + segments * self._tree.links_per_segment(self._order)
        is_base = self._order == 0 and segment == 0 and self._tree.growth.base_splits > 0
        key = "base_splits" if is_base else self._tree.key(self._order, "seg_splits")
        check_links(self._tree, links, self._order, key)

    def axes(self) -> Axes:
        """The finished centre lines."""
        base, frame, density = (np.concatenate(column) for column in zip(*self._records, strict=True))
        counts = [len(record[2]) for record in self._records]
        stem = np.concatenate([np.arange(count) for count in counts])
        stem_after_stem = np.argsort(stem, kind="stable")
        return Axes(
            family=self._family,
            mother=self._mother,
            start=self._start,
            segment_stem=stem[stem_after_stem],
            segment_index=np.repeat(np.arange(len(counts)), counts)[stem_after_stem],
            segment_base=base[stem_after_stem],
            segment_frame=frame[stem_after_stem],
            segment_density=density[stem_after_stem],
        )


def _generators(streams: Streams, order: int) -> dict[str, np.random.Generator]:
    """The streams that are drawn from segment by segment."""
    names = (
        "curve",
        "curve heading",
        "split phase",
        "split angle",
        "clone split angle",
        "spread",
        "spread size",
    )
    return {name: streams.generator(name, order) for name in names}


def _curve_step(level: Level, segment: int) -> float:
    """Turn from the segment before to this one, degrees."""
    if level.curve_back == 0:
        return level.curve / level.curve_res
    half = level.curve if 2 * segment < level.curve_res else level.curve_back
    return half / (level.curve_res / 2)


def _pulled_up(frame: Reals, strength: float) -> Reals:
    """Frames turned towards the vertical by strength x declination x sin(declination), or down where negative.

    Weber and Penn write cos(orientation), the vertical part of the stem's y axis, for the sine; that is the
    same in a stem which bends in a vertical plane, and this also pulls the ones that bend out of it.
    """
    lean = frames.declination(frame)
    wanted = strength * lean * np.sin(lean)
    turn = np.clip(wanted, lean - np.pi, lean)
    z = frame[:, frames.Z]
    across = np.stack((z[:, 1], -z[:, 0], np.zeros(len(z))), axis=1)
    length = np.linalg.norm(across, axis=1, keepdims=True)
    axis = np.where(length > 1e-9, across / np.maximum(length, 1e-9), np.array([1.0, 0.0, 0.0]))
    return frames.turn_about_axis(frame, axis, turn)


def _on_helix(frame: Reals, level: Level, segment: int) -> Reals:
    """Frames of a segment that winds round the stem's own axis at the angle -nCurveV."""
    heading = 2.0 * np.pi * segment / min(HELIX_SEGMENTS, level.curve_res)
    return frames.tip_towards(frame, np.full(len(frame), heading), np.radians(-level.curve_v))
