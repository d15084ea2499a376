"""Colour of sun, sky and haze for a height of the sun."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Doubles = NDArray[np.float64]

SUN_ABOVE_AIR = np.array([5.6, 5.3, 5.0])
"""Linear RGB of the sun outside the atmosphere, in the renderer's own unit."""
OPTICAL_DEPTH = np.array([0.10, 0.17, 0.33])
"""Rayleigh and aerosol depth of a clear rural sky straight up at 640, 550 and 450 nm."""
EXTINCTION = 1.0 / 3200.0
"""Of the haze near the ground, 1/m: clear summer air with a little moisture."""


@dataclass(frozen=True, slots=True)
class Daylight:
    """Light at one moment, linear RGB."""

    sun: Doubles
    """(3,) on a surface that faces the sun."""
    sky: Doubles
    """(3,) on a surface that faces up."""
    haze: Doubles
    """(3,) of the horizon."""
    exposure: float
    """Factor on all light before tone mapping: an eye opens as the sun goes down."""


def daylight(sun: Doubles) -> Daylight:
    """Light for a unit direction (3,) towards the sun."""
    elevation = np.degrees(np.arcsin(np.clip(sun[2], -1.0, 1.0)))
    # Kasten and Young 1989; below the horizon the air mass of the horizon stands in.
    height = max(elevation, 0.0)
    air_mass = 1.0 / (np.sin(np.radians(height)) + 0.50572 * (height + 6.07995) ** -1.6364)
    risen = np.clip(elevation / 4.0 + 0.5, 0.0, 1.0)
    light = risen * SUN_ABOVE_AIR * np.exp(-OPTICAL_DEPTH * air_mass)
    bright = 0.15 + 0.85 * np.clip(sun[2] * 1.6, 0.0, 1.0) ** 0.8
    sky = bright * np.array([0.78, 0.92, 1.18])
    haze = bright * np.array([0.70, 0.80, 0.92]) + 0.06 * light
    return Daylight(light, sky, haze, float(0.95 - 0.33 * np.clip(sun[2] * 1.6, 0.0, 1.0)))
