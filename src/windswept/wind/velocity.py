"""Air velocity at many points at once: the fused kernel, and the plain formula it implements beside it."""

from __future__ import annotations

import math

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from windswept.wind.fade import smooth_step
from windswept.wind.mean import Profile, profile_factor
from windswept.wind.wind import Wind

Floats = NDArray[np.float32]
Reals = NDArray[np.float64]

BLOCK = 512
"""Points a thread takes at a time; their sums stay in its nearest cache."""
ALONE = 8 * BLOCK
"""Up to so many points, some 70 microseconds, waiting for other threads costs more than they save."""


def velocity(wind: Wind, points: Floats, height: Floats, time: float, out: Floats | None = None) -> Floats:
    """Air velocity at points, all sources added up.

    Args:
        wind: profile and sources.
        points: (N, 3) float32 world positions, m; only x and y are read.
        height: (N,) float32 height of each point above the ground, m.
        time: s.
        out: (N, 3) float32 to write into, or None for a new array.

    Returns:
        (N, 3) float32, m/s; sources are horizontal, so z is 0.
        U = profile(height) (mean + sum of waves + sum of gusts), PHYSICS C5.
    """
    result = np.empty((len(points), 3), dtype=np.float32) if out is None else out
    profile, waves = _profile_row(wind.profile), wave_rows(wind, time)
    add_up = _add_up_alone if len(points) <= ALONE else _add_up
    add_up(points, height, profile, wind.mean.vector, waves, wind.gust_rows, time, result)
    return result


def velocity_reference(wind: Wind, points: Floats, height: Floats, time: float) -> Reals:
    """(N, 3) the same as ``velocity`` in readable double-precision NumPy."""
    place = np.asarray(points, dtype=np.float64)[:, :2]
    total = (
        np.array(wind.mean.vector) + _waves_reference(wind, place, time) + _gusts_reference(wind, place, time)
    )
    horizontal = profile_factor(wind.profile, height)[:, None] * total
    return np.concatenate([horizontal, np.zeros((len(place), 1))], axis=1)


def _waves_reference(wind: Wind, place: Reals, time: float) -> Reals:
    """(N, 2) sum of D a (2 ((sin(w D.x - phi t + psi) + 1) / 2)^k - mean), PHYSICS C5."""
    table = wind.waves.table
    turns = place @ np.array([table.turns_x, table.turns_y]) + table.turns_t * time + table.turns_0
    raised = ((np.sin(2.0 * np.pi * turns) + table.bias) / 2.0) ** table.power - table.mean
    return (raised * wind.waves.weights(time)) @ np.array([table.push_x, table.push_y]).T


def _gusts_reference(wind: Wind, place: Reals, time: float) -> Reals:
    """(N, 2) each gust's smooth rise, hold and decay behind its front, times its sideways fade."""
    total = np.zeros_like(place)
    for row in wind.gust_rows:
        start, x0, y0, dx, dy, speed, strength, per_rise, decay_start, per_decay, per_width = row
        along = (place[:, 0] - x0) * dx + (place[:, 1] - y0) * dy
        aside = (place[:, 1] - y0) * dx - (place[:, 0] - x0) * dy
        behind = speed * (time - start) - along
        rise = smooth_step(behind * per_rise)
        decay = 1.0 - smooth_step((behind - decay_start) * per_decay)
        shape = rise * decay * (1.0 - smooth_step(np.abs(aside) * per_width))
        total += strength * shape[:, None] * np.array([dx, dy])
    return total


def wave_rows(wind: Wind, time: float) -> Reals:
    """(W, 8) what a kernel needs of each wave at one time; waves that are faded out are left out.

    Columns: turns per metre of x and y, turns now at the origin (kept small, so that single precision lasts),
    push x and y in m/s with the fade applied, bias, power, mean.
    """
    table, weight = wind.waves.table, wind.waves.weights(time)
    turns = np.mod(table.turns_t * time + table.turns_0, 1.0)
    push_x, push_y = weight * table.push_x, weight * table.push_y
    rows = np.array(
        (table.turns_x, table.turns_y, turns, push_x, push_y, table.bias, table.power, table.mean)
    )
    return np.ascontiguousarray(rows[:, weight > 0.0].T)


def _profile_row(profile: Profile) -> tuple[float, float, float, float, float]:
    """Displacement, 1/roughness, join height, attenuation, 1/ln((z_ref-d)/z0)."""
    return (
        profile.displacement,
        1.0 / profile.roughness,
        profile.join_height,
        profile.attenuation,
        1.0 / profile.log_reference,
    )


@njit(parallel=True, cache=True, fastmath=True)
def _add_up(points, height, profile, mean, waves, gusts, time, out):  # type: ignore[no-untyped-def]
    """Blocks of points over the threads."""
    for block in prange((len(points) + BLOCK - 1) // BLOCK):
        _add_up_block(block, points, height, profile, mean, waves, gusts, time, out)


@njit(cache=True, fastmath=True)
def _add_up_alone(points, height, profile, mean, waves, gusts, time, out):  # type: ignore[no-untyped-def]
    """Blocks of points on this thread."""
    for block in range((len(points) + BLOCK - 1) // BLOCK):
        _add_up_block(block, points, height, profile, mean, waves, gusts, time, out)


@njit(cache=True, fastmath=True)
def _add_up_block(block, points, height, profile, mean, waves, gusts, time, out):  # type: ignore[no-untyped-def]
    first = block * BLOCK
    size = min(BLOCK, len(points) - first)
    x = points[first : first + size, 0].copy()
    y = points[first : first + size, 1].copy()
    u, v = air_at_reference(x, y, mean, waves, gusts, time)
    _scale_with_height(profile, height[first : first + size], u, v, out[first : first + size])


@njit(cache=True, fastmath=True)
def air_at_reference(x, y, mean, waves, gusts, time):  # type: ignore[no-untyped-def]
    """Horizontal velocity of a block of points at the profile's reference height, for kernels of other rooms too.

    One source after another, points innermost; ``waves`` is that of ``wave_rows``, ``gusts`` ``Wind.gust_rows``.
    """
    size = len(x)
    u = np.full(size, np.float32(mean[0]), dtype=np.float32)
    v = np.full(size, np.float32(mean[1]), dtype=np.float32)
    base = np.empty(size, dtype=np.float32)
    raised = np.empty(size, dtype=np.float32)
    for i in range(len(waves)):
        _add_wave(waves[i], x, y, base, raised, u, v)
    for i in range(len(gusts)):
        _add_gust(gusts[i], time, x, y, u, v)
    return u, v


@njit(cache=True, fastmath=True)
def _add_wave(wave, x, y, base, raised, u, v):  # type: ignore[no-untyped-def]
    """Add one wave to the block: phase in turns, sine, power, push."""
    # A quarter turn back makes the sine an even cosine, whose folding needs no sign.
    for p in range(len(x)):
        turns = wave[0] * x[p] + wave[1] * y[p] + (wave[2] - 0.25)
        base[p] = np.float32(0.5) * (_cosine(np.float32(turns - np.rint(turns))) + np.float32(wave[5]))
    _raise(base, wave[6], raised)
    push_x, push_y, mean = np.float32(wave[3]), np.float32(wave[4]), np.float32(wave[7])
    for p in range(len(x)):
        u[p] += push_x * (raised[p] - mean)
        v[p] += push_y * (raised[p] - mean)


@njit(inline="always")
def _cosine(turns):  # type: ignore[no-untyped-def]
    """cos(2 pi turns) for -0.5..0.5: Taylor's sine to x^11 about the nearest zero, error below 1e-7."""
    x = np.float32(2.0 * math.pi) * (np.float32(0.25) - abs(turns))
    s = x * x
    poly = np.float32(1.0 / 362880.0) - s * np.float32(1.0 / 39916800.0)
    poly = np.float32(-1.0 / 5040.0) + s * poly
    poly = np.float32(1.0 / 120.0) + s * poly
    poly = np.float32(-1.0 / 6.0) + s * poly
    return x + x * s * poly


@njit(cache=True, fastmath=True)
def _raise(base, power, raised):  # type: ignore[no-untyped-def]
    """base^power for a block: products for whole powers, pow for the rest."""
    if power != math.floor(power):
        for p in range(len(base)):
            raised[p] = max(base[p], np.float32(0.0)) ** np.float32(power)
        return
    raised[:] = base
    for _ in range(int(power) - 1):
        for p in range(len(base)):
            raised[p] *= base[p]


@njit(cache=True, fastmath=True)
def _add_gust(gust, time, x, y, u, v):  # type: ignore[no-untyped-def]
    """Add one gust to the block (columns GUST_COLUMNS)."""
    x0, y0, dx, dy = gust[1], gust[2], gust[3], gust[4]
    travelled = gust[5] * (time - gust[0])
    for p in range(len(x)):
        along = (x[p] - x0) * dx + (y[p] - y0) * dy
        aside = (y[p] - y0) * dx - (x[p] - x0) * dy
        behind = travelled - along
        rise = _smooth(behind * gust[7])
        decay = 1.0 - _smooth((behind - gust[8]) * gust[9])
        push = gust[6] * rise * decay * (1.0 - _smooth(abs(aside) * gust[10]))
        u[p] += np.float32(push * dx)
        v[p] += np.float32(push * dy)


@njit(inline="always")
def _smooth(progress):  # type: ignore[no-untyped-def]
    p = min(max(progress, 0.0), 1.0)
    return p * p * (3.0 - 2.0 * p)


@njit(cache=True, fastmath=True)
def _scale_with_height(profile, height, u, v, out):  # type: ignore[no-untyped-def]
    """Write the block's velocity scaled by ``profile_factor``."""
    displacement, per_roughness, join, attenuation, per_reference = profile
    per_join = 1.0 / join
    for p in range(len(height)):
        z = max(np.float64(height[p]), 0.0)
        if z >= join:
            factor = math.log((z - displacement) * per_roughness)
        else:
            factor = math.exp(attenuation * (z * per_join - 1.0))
        scale = np.float32(factor * per_reference)
        out[p, 0] = scale * u[p]
        out[p, 1] = scale * v[p]
        out[p, 2] = np.float32(0.0)
