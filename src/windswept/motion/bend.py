"""`bend`: no state but the pose; the wind at a branch's tip bends its Bezier curve (Skjermo), eight branches at a time.

The cheapest motion there is: every branch follows the wind at once, without inertia or frequency of its own (C1.15).
`bend_plain.py` is the same in NumPy, with the formulas in readable form; the tests hold the two together.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numba import njit, prange

from windswept.motion.bend_branches import Branches, BranchPose
from windswept.motion.bend_plain import FOLD, WEIGHTS
from windswept.motion.gather import gather
from windswept.motion.lanes import FAST_MATH, WIDTH, at_least, load, sqrt
from windswept.motion.registers import load3, store3
from windswept.motion.rotation import add_scaled, cross, dot
from windswept.plants.plant import Floats, Ints
from windswept.wind.mean import Profile, profile_factor
from windswept.wind.velocity import air_at_reference, wave_rows
from windswept.wind.wind import Wind

CONSTANT_COUNT = 15
"""Numbers of a branch: t (1), leg 1 (3), unit leg 2 and its length (4), unit leg 3 and its length (4), S0 (3)."""
POSE_COUNT = 15
"""Numbers of a posed branch: four control points (12), S0 (3)."""
BLOCK = 64
"""Tiles that a thread takes at a time; the wind at their tips stays in its nearest cache."""

ALONE = 8 * BLOCK
"""Up to so many tiles, some 70 microseconds, waiting for other threads costs more than they save."""

_F = np.float32
_W = np.uintp(WIDTH)
_POSE = np.uintp(POSE_COUNT * WIDTH)
_ONE: Any = _F(1.0)
_TINY: Any = _F(1e-30)
_ZERO: Any = _F(0.0)
_FOLD: Any = _F(FOLD)
_OPPOSITE: Any = _F(1e-6)
"""Least 1 + cosine between two legs that a frame is carried over."""


@dataclass(slots=True)
class BendState:
    """Posed branches in tiles of WIDTH; the first tile is the ground that roots stand on."""

    now: Floats
    """(T, POSE_COUNT, WIDTH) m, relative to each trunk's base."""
    spare: Floats
    """(T, POSE_COUNT, WIDTH) the other of the two buffers, into which the lagged step writes."""


@njit(fastmath=FAST_MATH, forceinline=True)
def unit(v):  # type: ignore[no-untyped-def]
    """``v`` at length 1."""
    s = _ONE / sqrt(dot(v, v) + _TINY)
    return v[0] * s, v[1] * s, v[2] * s


@njit(fastmath=FAST_MATH, forceinline=True)
def carried(side, before, after):  # type: ignore[no-untyped-def]
    """A handle carried from one unit leg to the next by the least rotation."""
    share = dot(side, after) / at_least(dot(before, after) + _ONE, _OPPOSITE)
    return add_scaled(add_scaled(side, before, -share), after, -share)


@njit(fastmath=FAST_MATH, forceinline=True)
def frame_at(d0, d1, d2, side, t):  # type: ignore[no-untyped-def]
    """The frame U, S, T at parameter t of the curve with legs d0, d1, d2."""
    l0, l1, l2 = unit(d0), unit(d1), unit(d2)
    s1 = carried(side, l0, l1)
    s2 = carried(s1, l1, l2)
    s = _ONE - t
    w0, w1, w2 = s * s, s * t * _F(2.0), t * t
    along = unit((
        d0[0] * w0 + d1[0] * w1 + d2[0] * w2,
        d0[1] * w0 + d1[1] * w1 + d2[1] * w2,
        d0[2] * w0 + d1[2] * w1 + d2[2] * w2,
    ))  # fmt: skip
    across = (
        side[0] * w0 + s1[0] * w1 + s2[0] * w2,
        side[1] * w0 + s1[1] * w1 + s2[1] * w2,
        side[2] * w0 + s1[2] * w1 + s2[2] * w2,
    )
    across = unit(add_scaled(across, along, -dot(across, along)))
    return along, across, cross(across, along)


@njit(fastmath=FAST_MATH, forceinline=True)
def out_of(frame, v):  # type: ignore[no-untyped-def]
    """``v`` in the frame's coordinates -> in the world's directions."""
    u, s, t = frame
    return (
        u[0] * v[0] + s[0] * v[1] + t[0] * v[2],
        u[1] * v[0] + s[1] * v[1] + t[1] * v[2],
        u[2] * v[0] + s[2] * v[1] + t[2] * v[2],
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def turned_by(a, b):  # type: ignore[no-untyped-def]
    """normalize(a + b) - a of a unit vector, with b along a above FOLD; exactly 0 where b is.

    With p = max(a.b, FOLD) the turned vector is (b + a (1 + p - a.b)) / r, where r^2 = 1 + q. Less a, that is
    (b + a (p - a.b - q / (1 + r))) / r, since 1 - r = -q / (1 + r): no difference of nearly equal numbers.
    """
    along = dot(a, b)
    p = at_least(along, _FOLD)
    q = p + p + p * p + at_least(dot(b, b) - along * along, _ZERO)
    r = sqrt(q + _ONE)
    s = _ONE / r
    return add_scaled((b[0] * s, b[1] * s, b[2] * s), a, (p - along - q / (r + _ONE)) * s)


@njit(fastmath=FAST_MATH, forceinline=True)
def rotated_by(v, a, e):  # type: ignore[no-untyped-def]
    """What the least rotation from unit a to unit a + e adds to v; exactly 0 where e is."""
    axis = cross(a, e)
    once = cross(axis, v)
    return add_scaled(once, cross(axis, once), _ONE / at_least(dot(a, e) + _F(2.0), _OPPOSITE))


@njit(fastmath=FAST_MATH, forceinline=True)
def bend_legs(second, third, b, weights):  # type: ignore[no-untyped-def]
    """What bending by b adds to the unit second and third legs."""
    w, more = weights
    e2 = turned_by(second, (b[0] * w, b[1] * w, b[2] * w))
    e3 = rotated_by(third, second, e2)
    e4 = turned_by(add_scaled(third, e3, _ONE), (b[0] * more, b[1] * more, b[2] * more))
    return e2, add_scaled(e3, e4, _ONE)


@njit(fastmath=FAST_MATH, forceinline=True)
def _gather3(pose, place, i, shift):  # type: ignore[no-untyped-def]
    """A vector of the parents of the eight branches from i on."""
    return (
        gather(pose, place, i, shift),
        gather(pose, place, i, shift + _W),
        gather(pose, place, i, shift + _W + _W),
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def _bend_tile(c, place, i, before, u, v, weights, after, out):  # type: ignore[no-untyped-def]
    """Attaches and bends eight branches with constants c, parents at ``place[i:]`` and bend factors u, v."""
    three = _W * np.uintp(3)
    p0, p1 = _gather3(before, place, i, np.uintp(0)), _gather3(before, place, i, three)
    p2, p3 = _gather3(before, place, i, three + three), _gather3(before, place, i, three * np.uintp(3))
    side = _gather3(before, place, i, three * np.uintp(4))
    d0, d1, d2 = add_scaled(p1, p0, -_ONE), add_scaled(p2, p1, -_ONE), add_scaled(p3, p2, -_ONE)
    t = load(c, np.uintp(0))
    frame = frame_at(d0, d1, d2, side, t)
    base = add_scaled(p0, d0, t * (t * (t - _F(3.0)) + _F(3.0)))
    base = add_scaled(add_scaled(base, d1, t * t * (_F(3.0) - t - t)), d2, t * t * t)
    second, third = out_of(frame, load3(c, _W * np.uintp(4))), out_of(frame, load3(c, _W * np.uintp(8)))
    long_second, long_third = load(c, _W * np.uintp(7)), load(c, _W * np.uintp(11))
    e2, e3 = bend_legs(second, third, (u, v, u * _F(0.0)), weights)
    first = add_scaled(base, out_of(frame, load3(c, _W)), _ONE)
    store3(after, out, base)
    store3(after, out + three, first)
    rest = add_scaled(first, second, long_second)
    bent = add_scaled(rest, e2, long_second)
    store3(after, out + three + three, bent)
    store3(after, out + three * np.uintp(3), add_scaled(add_scaled(bent, third, long_third), e3, long_third))
    store3(after, out + three * np.uintp(4), out_of(frame, load3(c, _W * np.uintp(12))))


@njit(cache=True, fastmath=FAST_MATH)
def _bend_block(block, start, end, scene):  # type: ignore[no-untyped-def]
    """A block of the tiles start..end: the wind at all their tips, then one tile after the other."""
    constants, place, tip_x, tip_y, scale, mean, waves, gusts, time, weights, before, after = scene
    first = start + block * BLOCK
    last = min(first + BLOCK, end)
    rows = slice(first * WIDTH, last * WIDTH)
    u, v = air_at_reference(tip_x[rows], tip_y[rows], mean, waves, gusts, time)
    shares = weights[0], weights[1]
    for tile in range(first, last):
        in_block, i = np.uintp(tile - first) * _W, np.uintp(tile) * _W
        air_u, air_v = load(u, in_block), load(v, in_block)
        push = sqrt(air_u * air_u + air_v * air_v + _TINY) * load(scale, i)
        b_u, b_v = air_u * push, air_v * push
        _bend_tile(constants[tile], place, i, before, b_u, b_v, shares, after, np.uintp(tile) * _POSE)


@njit(parallel=True, cache=True, fastmath=FAST_MATH)
def _bend_tiles(start, end, scene):  # type: ignore[no-untyped-def]
    """Blocks of tiles over the threads."""
    for block in prange((end - start + BLOCK - 1) // BLOCK):
        _bend_block(block, start, end, scene)


@njit(cache=True, fastmath=FAST_MATH)
def _bend_tiles_alone(start, end, scene):  # type: ignore[no-untyped-def]
    """Blocks of tiles on this thread."""
    for block in range((end - start + BLOCK - 1) // BLOCK):
        _bend_block(block, start, end, scene)


class Bender:
    """Bends the branches of a scene; owns their constants as the kernel reads them.

    Args:
        branches: what is bent.
        weights: name of the shares of b that turn the second and the third leg, see ``WEIGHTS``.
    """

    def __init__(self, branches: Branches, weights: str = "beam") -> None:
        self.branches = branches
        first, second = WEIGHTS[weights]
        self._weights = np.array([first, second - first], np.float32)
        self._row, self._level_tile = _rows(branches)
        self._constants, self._place = _pack(branches, self._row, int(self._level_tile[-1]))
        self._tip = np.zeros((3, len(self._place)), np.float32)
        self._tip[:, self._row] = branches.tip.T
        self._profile: Profile | None = None
        self._scale = np.zeros(len(self._place), np.float32)

    def rest(self) -> BendState:
        """The state in still air."""
        ground = np.zeros((int(self._level_tile[-1]), POSE_COUNT, WIDTH), np.float32)
        ground[0] = _GROUND[:, None]
        return self.step_ordered(BendState(ground, ground.copy()), Wind(), 0.0)

    def step_lagged(self, state: BendState, wind: Wind, time: float) -> BendState:
        """One pass over all branches: each follows its parent as it was before this step (Skjermo section 4.2).

        Args:
            state: stepped in place and returned; its two buffers swap.
            wind: sampled at the tips of the branches at rest.
            time: s.
        """
        all_at_once = self._level_tile[[0, -1]]
        self._pass(all_at_once, wind, time, state.now, state.spare)
        state.now, state.spare = state.spare, state.now
        return state

    def step_ordered(self, state: BendState, wind: Wind, time: float) -> BendState:
        """One pass a level: each follows its parent as it is now (PHYSICS C1.13). Arguments as ``step_lagged``."""
        self._pass(self._level_tile, wind, time, state.now, state.now)
        return state

    def pose(self, state: BendState) -> BranchPose:
        """Where the branches are, in the order of ``Branches``."""
        rows = state.now.transpose(0, 2, 1).reshape(-1, POSE_COUNT)[self._row]
        return BranchPose(rows[:, :12].reshape(-1, 4, 3), rows[:, 12:])

    def _pass(self, level_tile: Ints, wind: Wind, time: float, before: Floats, after: Floats) -> None:
        if wind.profile != self._profile:
            height = profile_factor(wind.profile, self.branches.tip[:, 2])
            self._scale[self._row] = self.branches.flexibility * height * height
            self._profile = wind.profile
        scene = (
            self._constants,
            self._place,
            self._tip[0],
            self._tip[1],
            self._scale,
            np.array(wind.mean.vector),
            wave_rows(wind, time),
            wind.gust_rows,
            time,
            self._weights,
            before.reshape(-1),
            after.reshape(-1),
        )
        for start, end in pairwise(level_tile.tolist()):
            bend_tiles = _bend_tiles if end - start > ALONE else _bend_tiles_alone
            bend_tiles(start, end, scene)


_GROUND = np.concatenate([np.outer([0.0, 1.0, 2.0, 3.0], [1.0, 0.0, 0.0]).ravel(), [0.0, 1.0, 0.0]])
"""(POSE_COUNT,) a straight branch along x whose frame is ROOT_FRAME: the parent of roots."""


def _rows(branches: Branches) -> tuple[Ints, Ints]:
    """(R,) row of every branch among tiles of WIDTH that no two levels share, and (D+1,) the tile each level starts at.

    Tile 0 is the ground.
    """
    counts = np.diff(branches.level_start)
    level_tile = 1 + np.concatenate([[0], np.cumsum(-(-counts // WIDTH))])
    shift = level_tile[:-1] * WIDTH - branches.level_start[:-1]
    rows = np.arange(branches.branch_count) + np.repeat(shift, counts)
    return rows.astype(np.int32), level_tile.astype(np.int64)


def _pack(branches: Branches, row: Ints, tiles: int) -> tuple[Floats, Ints]:
    """(T, CONSTANT_COUNT * WIDTH) constants, lanes fastest, and (T * WIDTH,) where each row's parent begins in a pose.

    Rows that no branch fills stay harmless: branches without length at the ground.
    """
    packed = np.zeros((tiles * WIDTH, CONSTANT_COUNT), np.float32)
    packed[:, [4, 8, 13]] = 1.0
    length = np.linalg.norm(branches.legs.astype(np.float64), axis=2)
    packed[row, 0] = branches.attach
    packed[row, 1:4] = branches.legs[:, 0]
    packed[row, 4:7] = branches.legs[:, 1] / length[:, 1, None]
    packed[row, 7] = length[:, 1]
    packed[row, 8:11] = branches.legs[:, 2] / length[:, 2, None]
    packed[row, 11] = length[:, 2]
    packed[row, 12:15] = branches.side
    place = np.zeros(tiles * WIDTH, np.int32)
    above = np.where(branches.parent < 0, 0, row[branches.parent])
    place[row] = above // WIDTH * int(_POSE) + above % WIDTH
    lanes_last = packed.reshape(tiles, WIDTH, CONSTANT_COUNT).transpose(0, 2, 1)
    return np.ascontiguousarray(lanes_last).reshape(tiles, -1), place
