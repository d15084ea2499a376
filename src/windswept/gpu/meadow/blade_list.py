"""Eye -> which blades are posed and drawn, and with how many sections: the plain formula of ``BladeChoice``.

A picture depends only on where the eye is, without memory. Blades that are finer than a pixel allows are left out by
their chance, the others are drawn as much wider and the last of them thin (``widening`` in ``blades_pose.wgsl``), so
nothing pops. Fewer sections have the same tip (``simplify_table``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.gpu.layouts import NONE
from windswept.gpu.meadow.meadow_rows import LEVELS, MeadowRows

Doubles = NDArray[np.float64]

NEAREST = 0.3
"""Distance at which detail stops growing, m."""


@dataclass(frozen=True, slots=True)
class BladeRules:
    """What is spent on a picture. The defaults suit a graphics card."""

    width_pixels: float = 0.7
    """Blades are left out until those that are drawn are so wide."""
    section_pixels: tuple[float, float] = (7.0, 2.5)
    """Least length of a section of a whole blade, pixels, at which it is drawn with all and with three sections."""
    reach: float = 220.0
    """Where the last blades end and the ground's own colour takes over, m."""


SOFTWARE_BLADES = BladeRules(1.6, (16.0, 6.0), 90.0)
"""For a machine that draws triangles on the CPU."""


@dataclass(frozen=True, slots=True)
class Sharpness:
    """Who looks at blades."""

    eye: Doubles
    """(3,) m."""
    planes: Doubles
    """(5, 4) planes of the frustum, positive inside."""
    pixels: float
    """Of 1 m at a distance of 1 m."""

    def same_as(self, other: Sharpness) -> bool:
        """Whether both see the same."""
        return self.pixels == other.pixels and np.array_equal(self.planes, other.planes)


@dataclass(frozen=True, slots=True)
class BladeList:
    """What one frame poses and draws."""

    items: NDArray[np.uint32]
    """(n, 4) blade, its first posed joint, its run, its carrier (``blades_pose.wgsl``); parents come first."""
    depth_counts: tuple[int, ...]
    """Items on the ground, on those, and so on."""
    draws: tuple[tuple[int, int, int], ...]
    """First posed joint, number of blades and their sections, for every number of sections."""
    joint_count: int


def blade_list(rows: MeadowRows, sharpness: Sharpness, rules: BladeRules, room: float = np.inf) -> BladeList:
    """Choose blades and lay out their posed joints.

    Args:
        rows: what the card holds.
        sharpness: who looks.
        rules: what may be spent.
        room: posed joints that there is room for; where they are too many, all chunks go to the next coarser level.
    """
    level = _chosen_levels(rows, sharpness, rules)
    chosen = np.flatnonzero(_chosen(rows, sharpness, rules))
    chosen = chosen[np.argsort(rows.depth[chosen], kind="stable")]
    chunk = rows.chunk[chosen]
    sections = rows.sections[rows.chunk_set[chunk], level[chunk]]
    while (sections + 1).sum() > room and level.min() < LEVELS - 1:
        level = np.minimum(level + 1, LEVELS - 1)
        sections = rows.sections[rows.chunk_set[chunk], level[chunk]]
    order = np.argsort(sections, kind="stable")
    joints = sections[order] + 1
    first = np.empty(len(chosen), np.int64)
    first[order] = np.cumsum(joints) - joints
    carrier = np.full(len(rows.parent), NONE, np.uint32)
    carrier[chosen] = 16 * first + sections - 1
    parent = rows.parent[chosen]
    items = np.empty((len(chosen), 4), np.uint32)
    items[:, 0], items[:, 1] = chosen, first
    items[:, 2] = rows.chunk_set[chunk] * LEVELS + level[chunk]
    items[:, 3] = np.where(parent < 0, NONE, carrier[parent])
    kinds, starts, counts = np.unique(sections[order], return_index=True, return_counts=True)
    firsts = first[order][starts] if len(chosen) else first
    return BladeList(
        items=items,
        depth_counts=tuple(np.bincount(rows.depth[chosen], minlength=1).tolist()),
        draws=tuple(zip(firsts.tolist(), counts.tolist(), kinds.tolist(), strict=True)),
        joint_count=int(joints.sum()),
    )


def _away(rows: MeadowRows, sharpness: Sharpness) -> Doubles:
    """(C,) distance of every chunk's nearest blades, m."""
    ball = rows.chunk_ball.astype(np.float64)
    return np.maximum(np.linalg.norm(ball[:, :3] - sharpness.eye, axis=1) - ball[:, 3], NEAREST)


def _chosen_levels(rows: MeadowRows, sharpness: Sharpness, rules: BladeRules) -> NDArray[np.int64]:
    """(C,) level of every chunk: the same for what hangs on others as the sections' lengths ask for."""
    pixels = rows.set_size[rows.chunk_set, 1] * sharpness.pixels / _away(rows, sharpness)
    whole, three = rules.section_pixels
    return (pixels < whole).astype(np.int64) + (pixels < three)


def _chosen(rows: MeadowRows, sharpness: Sharpness, rules: BladeRules) -> NDArray[np.bool_]:
    """(N,) blades that are drawn, and those on which they hang."""
    ball, away = rows.chunk_ball.astype(np.float64), _away(rows, sharpness)
    inside = ball[:, :3] @ sharpness.planes[:, :3].T + sharpness.planes[:, 3] > -ball[:, 3:]
    share = rows.set_size[rows.chunk_set, 0] * sharpness.pixels / (away * rules.width_pixels)
    seen = np.flatnonzero(inside.all(axis=1) & (away < rules.reach))
    first, counts = rows.chunk_first[seen], np.diff(rows.chunk_first)[seen]
    blades = np.repeat(first - np.cumsum(counts) + counts, counts) + np.arange(counts.sum())
    # Sizes differ from blade to blade: those of twice the mean width must not be missed.
    near = blades[rows.chance[blades] < np.repeat(share[seen], counts)]
    chosen = np.zeros(len(rows.parent), np.bool_)
    chosen[near] = True
    for _ in range(int(rows.depth.max(initial=0))):
        near = rows.parent[near]
        near = np.unique(near[near >= 0])
        chosen[near] = True
    return chosen
