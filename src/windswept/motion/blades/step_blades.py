"""step_blades: the motion of many blades, eight in a register.

One step of one blade::

    air      velocity and contact pressure at its force point, from the field's grid
    force    drag of the air relative to the blade's own motion, and the pressure's push, in force scales
    lean     of weight and force together, less that of the weight alone: the equilibrium, seen from rest
    motion   towards it by the exact step of the constraint law

The equilibrium pose needs no look-up here, since lean and load say the same (lean.py); it is looked up when the blade
is drawn. `step_plain.py` is the same in NumPy, and the tests hold the two together.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit, prange

from windswept.motion.blades.blades import (
    AXIS,
    BROKEN,
    DRAG,
    FLAT_STEP,
    LEAN,
    NORMAL,
    PLACE,
    RATE,
    REACH,
    SIDE_STEP,
    Blades,
    BladeState,
    to_tiles,
)
from windswept.motion.blades.field import PackedField, sample
from windswept.motion.blades.kind import BladeKind
from windswept.motion.blades.registers import all_set, at_most, choose, extract, power, within
from windswept.motion.lanes import FAST_MATH, WIDTH, load, settled, sqrt, store
from windswept.motion.registers import load3, load4, store3
from windswept.motion.rotation import add_scaled, cross, dot
from windswept.plants.plant import Floats

LARGEST_FORCE = 1e4
"""Larger forces, in force scales, are shortened and counted: a blade of grass under a car's weight."""
REST_THRESHOLD = 1e-9
"""Leans and rates (1/s) below this are put to rest: dying motion must not end in denormals."""
KIND_COUNT = 10
WEIGHT, PUSH, SHARE, HALF_EXPONENT, ONSET, SIDE_REACH, SOFTER, BREAKING = 0, 1, 2, 5, 6, 7, 8, 9
"""Numbers of ``kind_numbers``."""

_F = np.float32
_W = np.uintp(WIDTH)
_ONE = _F(1.0)
_TINY = _F(1e-30)
_LARGEST_SQUARE = _F(LARGEST_FORCE**2)
_INFINITE = _F(1e30)
_THRESHOLD: Any = _F(REST_THRESHOLD)
_NEVER = 1e9
_CHUNK = 64
"""Tiles that one thread takes at a time."""
ALONE = 8 * _CHUNK
"""Up to so many tiles, some 60 microseconds, waiting for other threads costs more than they save."""


def kind_numbers(kind: BladeKind) -> Floats:
    """(KIND_COUNT,) constants of a kind as the kernel reads them."""
    material = kind.blade.component
    numbers = np.zeros(KIND_COUNT, np.float32)
    numbers[WEIGHT] = kind.weight
    numbers[PUSH] = kind.push / kind.drag
    numbers[SHARE : SHARE + 3] = kind.drag_share
    numbers[HALF_EXPONENT] = 0.5 * material.reconfiguration
    numbers[ONSET] = 1.0 / material.reconfiguration_speed**2
    numbers[SIDE_REACH] = kind.reach[1] / kind.reach[0]
    numbers[SOFTER] = 1.0 / kind.broken_scale - 1.0
    numbers[BREAKING] = min(kind.breaking_lean, _NEVER) ** 2
    return numbers


@njit(fastmath=FAST_MATH, forceinline=True)
def _force(k, drag, damping, wind, push, frame, moving):  # type: ignore[no-untyped-def]
    """Force in the base frame and force scales: drag coefficient x |u| u with reconfiguration (PHYSICS B4), and push.

    ``damping`` bounds what the blade's own velocity can do in one step, at any wind speed, and leaves the force on a
    blade at rest untouched.
    """
    u = add_scaled(wind, moving, _F(-1.0))
    speed = sqrt(dot(u, u) + _TINY)
    u = add_scaled(wind, moving, _F(-1.0) / (speed * damping + _ONE))
    square = dot(u, u)
    folded = power(square * k[ONSET] + _ONE, k[HALF_EXPONENT])
    pressed = drag * k[PUSH]
    drag = drag * folded * sqrt(square + _TINY)
    return (
        dot(u, frame[0]) * drag * k[SHARE] + dot(push, frame[0]) * pressed,
        dot(u, frame[1]) * drag * k[SHARE + 1] + dot(push, frame[1]) * pressed,
        dot(u, frame[2]) * drag * k[SHARE + 2] + dot(push, frame[2]) * pressed,
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def _kept_in_bounds(force):  # type: ignore[no-untyped-def]
    """The force, none where it is no number, at most LARGEST_FORCE; and 1 where nothing had to be done."""
    square = dot(force, force)
    sound = within(square, _INFINITE)
    zero = sound * _F(0.0)
    force = choose(sound, force[0], zero), choose(sound, force[1], zero), choose(sound, force[2], zero)
    square = choose(sound, square, zero)
    in_bounds = sound * within(square, _LARGEST_SQUARE)
    shorter = at_most(_F(LARGEST_FORCE) / sqrt(square + _TINY), _ONE)
    return (force[0] * shorter, force[1] * shorter, force[2] * shorter), in_bounds


@njit(fastmath=FAST_MATH, forceinline=True)
def _equilibrium(weight, force):  # type: ignore[no-untyped-def]
    """Lean of weight and force less that of the weight: exactly zero without a force.

    With r the root of 1 + load^2, that is F / r1 - G (r1 - r0) / (r0 r1), and (r1 - r0)(r1 + r0) = F^2 + 2 F.G.
    """
    own = dot(weight, weight) + _ONE
    more = dot(force, force) + dot(weight, force) * _F(2.0)
    before, after = sqrt(own), sqrt(own + more)
    pushed = force[0] / after, force[1] / after, force[2] / after
    target = add_scaled(pushed, weight, -more / ((after + before) * before * after))
    return target, (weight[0] / before, weight[1] / before, weight[2] / before)


@njit(fastmath=FAST_MATH, forceinline=True)
def _swing(target, lean, rate, step):  # type: ignore[no-untyped-def]
    """Lean and rate after one exact step towards a target."""
    y = lean - target
    moved = target + y * step[0] + rate * step[1]
    return settled(moved, _THRESHOLD), settled(y * step[2] + rate * step[3], _THRESHOLD)


@njit(fastmath=FAST_MATH, forceinline=True)
def _step_tile(k, c, s, wind, push, substeps):  # type: ignore[no-untyped-def]
    """Steps the eight blades of a tile in constant air; 1 in every lane whose forces were all in bounds."""
    frame_axis, frame_normal = load3(c, np.uintp(AXIS) * _W), load3(c, np.uintp(NORMAL) * _W)
    frame = frame_axis, frame_normal, cross(frame_axis, frame_normal)
    drag, reach = load(c, np.uintp(DRAG) * _W), load(c, np.uintp(REACH) * _W)
    flat, side = load4(c, np.uintp(FLAT_STEP) * _W), load4(c, np.uintp(SIDE_STEP) * _W)
    lean, rate = load3(s, np.uintp(LEAN) * _W), load3(s, np.uintp(RATE) * _W)
    broken = load(s, np.uintp(BROKEN) * _W)
    zero = broken * _F(0.0)
    in_bounds = zero + _ONE
    for _ in range(substeps):
        softer = broken * k[SOFTER] + _ONE
        soft_drag = drag * softer
        down = softer * (-k[WEIGHT])
        weight = frame[0][2] * down, frame[1][2] * down, frame[2][2] * down
        moving = add_scaled((zero, zero, zero), frame[1], rate[1] * reach)
        moving = add_scaled(moving, frame[2], rate[2] * reach * k[SIDE_REACH])
        force, sound = _kept_in_bounds(
            _force(k, soft_drag, soft_drag * reach * flat[2] * _F(-2.0), wind, push, frame, moving)
        )
        in_bounds = in_bounds * sound
        target, rest = _equilibrium(weight, force)
        along = _swing(target[0], lean[0], rate[0], flat)
        across = _swing(target[1], lean[1], rate[1], flat)
        aside = _swing(target[2], lean[2], rate[2], side)
        lean, rate = (along[0], across[0], aside[0]), (along[1], across[1], aside[1])
        bent = add_scaled(rest, lean, _ONE)
        # No blade leans further than its length: there its swing ends. Within, nothing is changed, not even rounded.
        shorter = at_most(_ONE / sqrt(dot(bent, bent) + _TINY), _ONE)
        lean = add_scaled(lean, bent, shorter - _ONE)
        rate = rate[0] * shorter, rate[1] * shorter, rate[2] * shorter
        pulled = at_most(bent[0], _F(0.0))
        bending = pulled * pulled + bent[1] * bent[1] + bent[2] * bent[2]
        broken = choose(within(bending, k[BREAKING]), broken, zero + _ONE)
    store3(s, np.uintp(LEAN) * _W, lean)
    store3(s, np.uintp(RATE) * _W, rate)
    store(s, np.uintp(BROKEN) * _W, broken)
    return in_bounds


@njit(fastmath=FAST_MATH, forceinline=True)
def _lanes_out_of_bounds(in_bounds, lanes_used):  # type: ignore[no-untyped-def]
    """How many of a tile's blades felt a force that had to be mended."""
    count = 0
    if not all_set(in_bounds):
        for lane in range(lanes_used):
            count += extract(in_bounds, np.uintp(lane)) < _F(0.5)
    return count


@njit(fastmath=FAST_MATH, cache=True)
def _chunk_in_field(chunk, k, constants, state, blades, field, grid, substeps, clamped):  # type: ignore[no-untyped-def]
    for tile in range(chunk * _CHUNK, min((chunk + 1) * _CHUNK, len(state))):
        c = constants[tile]
        wind, push = sample(field, grid, load3(c, np.uintp(PLACE) * _W))
        sound = _step_tile(k, c, state[tile], wind, push, substeps)
        clamped[chunk] += _lanes_out_of_bounds(sound, min(WIDTH, blades - tile * WIDTH))


@njit(fastmath=FAST_MATH, parallel=True, cache=True)
def _step_in_field(k, constants, state, blades, field, grid, substeps, clamped):  # type: ignore[no-untyped-def]
    for chunk in prange(len(clamped)):
        _chunk_in_field(chunk, k, constants, state, blades, field, grid, substeps, clamped)


@njit(fastmath=FAST_MATH, cache=True)
def _step_alone(k, constants, state, blades, field, grid, substeps, clamped):  # type: ignore[no-untyped-def]
    for chunk in range(len(clamped)):
        _chunk_in_field(chunk, k, constants, state, blades, field, grid, substeps, clamped)


@njit(fastmath=FAST_MATH, parallel=True, cache=True)
def _step_in_given(k, constants, state, blades, air, substeps, clamped):  # type: ignore[no-untyped-def]
    tiles = len(state)
    for chunk in prange(len(clamped)):
        for tile in range(chunk * _CHUNK, min((chunk + 1) * _CHUNK, tiles)):
            wind, push = load3(air[tile], np.uintp(0)), load3(air[tile], _W * np.uintp(3))
            sound = _step_tile(k, constants[tile], state[tile], wind, push, substeps)
            clamped[chunk] += _lanes_out_of_bounds(sound, min(WIDTH, blades - tile * WIDTH))


def step_in_field(blades: Blades, state: BladeState, field: PackedField, substeps: int = 1) -> BladeState:
    """Advances blades by ``substeps`` steps in a field that stays as it is meanwhile.

    Args:
        blades: what stands where.
        state: stepped in place and returned.
        field: air velocity and contact pressure on a grid (`pack_field`).
        substeps: number of steps, each ``blades.time_step`` long.
    """
    tiles, clamped = len(state.lanes), _counters(state)
    step = _step_alone if tiles <= ALONE else _step_in_field
    step(
        kind_numbers(blades.kind),
        blades.constants.reshape(tiles, -1),
        state.lanes.reshape(tiles, -1),
        blades.count,
        field.nodes,
        field.grid,
        substeps,
        clamped,
    )
    return _counted(state, clamped, substeps)


def step_in_given(
    blades: Blades, state: BladeState, velocity: Floats, push: Floats | None = None, substeps: int = 1
) -> BladeState:
    """As `step_in_field`, with the air given for every blade.

    Args:
        blades: what stands where.
        state: stepped in place and returned.
        velocity: (B, 3) of the air, m/s.
        push: (B, 3) contact pressure, N/m^2; None for none.
        substeps: number of steps.
    """
    tiles, clamped = len(state.lanes), _counters(state)
    air = np.concatenate([velocity, np.zeros_like(velocity) if push is None else push], axis=1)
    _step_in_given(
        kind_numbers(blades.kind),
        blades.constants.reshape(tiles, -1),
        state.lanes.reshape(tiles, -1),
        blades.count,
        to_tiles(air).reshape(tiles, -1),
        substeps,
        clamped,
    )
    return _counted(state, clamped, substeps)


def _counters(state: BladeState) -> np.ndarray:
    return np.zeros(-(-len(state.lanes) // _CHUNK), np.int64)


def _counted(state: BladeState, clamped: np.ndarray, substeps: int) -> BladeState:
    state.clamped_count += int(clamped.sum())
    state.step_count += substeps
    return state
