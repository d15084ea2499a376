"""Radius of a stem along and round it (Weber and Penn 1995): taper, flare and lobes as pure functions.

Z is the fraction of the stem's full length, 0 at its base and 1 at its tip. Every argument may be an array;
all broadcast against each other, and the result is float64.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Reals = NDArray[np.float64]

FLARE_REACH = 8.0
"""Flare fades out at Z = 1/8."""


def unit_taper(taper: ArrayLike) -> Reals:
    """How much of its radius a stem loses from base to tip: 1 for a cone, 0 for a cylinder.

    Args:
        taper: nTaper, 0..3: cylinder at 0, cone at 1, spherical end at 2, beads above 2.
    """
    value = np.asarray(taper, np.float64)
    return np.where(value < 1.0, value, np.maximum(2.0 - value, 0.0))


def taper_radius(radius: ArrayLike, taper: ArrayLike, z: ArrayLike, length: ArrayLike) -> Reals:
    """Radius of a stem at Z, without flare and lobes, m.

    Args:
        radius: base radius of the whole stem, m.
        taper: nTaper, 0..3; above 2 the stem is a row of beads, fully spherical at 3.
        z: fraction of the full length, 0..1.
        length: full length of the stem, m; the rounded ends depend on it.
    """
    shape = np.asarray(taper, np.float64)
    z_fraction = np.asarray(z, np.float64)
    plain = np.asarray(radius, np.float64) * (1.0 - unit_taper(shape) * z_fraction)
    to_tip = (1.0 - z_fraction) * np.asarray(length, np.float64)
    return np.where(shape < 1.0, plain, _rounded_radius(plain, shape, to_tip))


def _rounded_radius(plain: Reals, taper: Reals, to_tip: Reals) -> Reals:
    """Spherical end (taper 1..2) or beads (2..3) of local radius ``plain``, ``to_tip`` metres below the tip."""
    depth = np.where((taper < 2.0) | (to_tip < plain), 1.0, taper - 2.0)
    bead = 2.0 * np.maximum(plain, np.finfo(np.float64).tiny)
    along = np.where(taper < 2.0, to_tip, np.abs(to_tip - bead * np.floor(to_tip / bead + 0.5)))
    bulge = np.sqrt(np.maximum(plain**2 - (along - plain) ** 2, 0.0))
    straight = (taper < 2.0) & (along >= plain)
    return np.where(straight, plain, (1.0 - depth) * plain + depth * bulge)


def flare_factor(flare: ArrayLike, z: ArrayLike) -> Reals:
    """Factor by which a trunk widens at its foot: 1 + 0.99 Flare at Z = 0, exactly 1 from Z = 1/8 on.

    Args:
        flare: Flare.
        z: fraction of the trunk's length, 0..1.
    """
    reach = np.maximum(0.0, 1.0 - FLARE_REACH * np.asarray(z, np.float64))
    return 1.0 + np.asarray(flare, np.float64) * (np.power(100.0, reach) - 1.0) / 100.0


def bulge_factor(bulges: ArrayLike, depth: ArrayLike, z: ArrayLike) -> Reals:
    """Factor on the radius of a stem that swells and narrows along its length (Skjermo 2007, equation 4).

    Args:
        bulges: number of swellings from base to tip.
        depth: of the swellings, a fraction of the radius.
        z: position Z along the stem, 0 at the base, 1 at the tip.
    """
    turns = 2.0 * np.pi * np.asarray(bulges, np.float64) * np.asarray(z, np.float64)
    return 1.0 + np.asarray(depth, np.float64) * np.sin(turns)


def lobe_factor(lobes: ArrayLike, depth: ArrayLike, angle: ArrayLike) -> Reals:
    """Factor on the radius round a lobed stem.

    Args:
        lobes: number of lobes round the stem.
        depth: LobeDepth, a fraction of the radius.
        angle: angle round the stem, rad.
    """
    count = np.asarray(lobes, np.float64)
    return 1.0 + np.asarray(depth, np.float64) * np.sin(count * np.asarray(angle, np.float64))
