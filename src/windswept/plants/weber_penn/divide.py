"""Divides the segments of centre lines into links, on a smooth curve."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.plants.weber_penn import frames
from windswept.plants.weber_penn.axes import Axes

Reals = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Lines:
    """L links of one order, stem after stem, base to tip, for stems of length 1 that stand at the origin."""

    stem: Indices
    """(L,)"""
    z_base: Reals
    """(L,) fraction of the full stem's length at the link's base."""
    z_tip: Reals
    base: Reals
    """(L, 3)"""
    tip: Reals
    frame: Reals
    """(L, 3, 3) z is the link's axis."""
    density: Reals
    """(L,) child stems per length against an unsplit stem."""

    def of_stems(self, wanted: NDArray[np.bool_]) -> Lines:
        """The links of the stems that are wanted (S,), which are numbered anew."""
        kept = wanted[self.stem]
        stem = (np.cumsum(wanted) - 1)[self.stem[kept]]
        ends = self.z_base[kept], self.z_tip[kept], self.base[kept], self.tip[kept]
        return Lines(stem, *ends, self.frame[kept], self.density[kept])


def divided(axes: Axes, per_segment: int, curve_res: int) -> Lines:
    """Links of centre lines.

    Args:
        axes: T segments.
        per_segment: links per segment; where more than 1, the ends of the links lie on the Catmull-Rom curve
            through the ends of the segments.
        curve_res: segments of a whole stem.
    """
    link_count = curve_res * per_segment
    index = (axes.segment_index[:, None] * per_segment + np.arange(per_segment)).ravel()
    point = _curve_points(axes, per_segment) / curve_res
    base, tip = point[:, :-1].reshape(-1, 3), point[:, 1:].reshape(-1, 3)
    frame = np.repeat(axes.segment_frame, per_segment, axis=0)
    if per_segment > 1:
        along = tip - base
        frame = frames.turn_to(frame, along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12))
    return Lines(
        stem=np.repeat(axes.segment_stem, per_segment),
        z_base=index / link_count,
        z_tip=(index + 1) / link_count,
        base=base,
        tip=tip,
        frame=frame,
        density=np.repeat(axes.segment_density, per_segment),
    )


def _curve_points(axes: Axes, per_segment: int) -> Reals:
    """(T, per_segment + 1, 3) points along every segment, with both its ends, in segments."""
    start, chord = axes.segment_base, axes.segment_frame[:, frames.Z]
    follows = (axes.segment_stem[1:] == axes.segment_stem[:-1])[:, None]
    smooth = 0.5 * (chord[1:] + chord[:-1])
    leaving, arriving = chord.copy(), chord.copy()
    leaving[1:] = np.where(follows, smooth, chord[1:])
    arriving[:-1] = np.where(follows, smooth, chord[:-1])
    u = (np.arange(per_segment + 1) / per_segment)[:, None]
    return np.asarray(
        start[:, None] * (1.0 + u * u * (2.0 * u - 3.0))
        + (start + chord)[:, None] * (u * u * (3.0 - 2.0 * u))
        + leaving[:, None] * (u * (1.0 - u) ** 2)
        + arriving[:, None] * (u * u * (u - 1.0))
    )
