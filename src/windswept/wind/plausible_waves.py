"""A wave set that looks like turbulence over a meadow, from mean speed, intensity and seed."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from windswept.wind.waves import Waves, wave_deviation

Reals = NDArray[np.float64]

SHORTEST, LONGEST = 8.0, 80.0
"""Wavelengths, m: from about a crown's width to several tree heights."""
PUSH_SPREAD = math.radians(25.0)
"""Waves push within this angle of the mean wind (or of its perpendicular)."""
TRAVEL_SPREAD = math.radians(60.0)
"""Crests travel within this angle of the mean wind: their crossing is what puts trees side by side out of step."""
CHANGE = 0.15
"""Speeds differ from the mean wind's by up to this share, so that the pattern changes as it passes."""
CROSS_RATIO = 0.8
"""Deviation across the wind over that along it (IEC 61400-1, PHYSICS B5)."""


def plausible_waves(
    mean_speed: float,
    intensity: float,
    seed: int,
    azimuth: float = 0.0,
    along_count: int = 5,
    cross_count: int = 3,
) -> Waves:
    """Waves with the asked turbulence intensity whose crests pass neighbouring trees out of step.

    A handful of sines is a line spectrum, not turbulence: it has the right deviation and the -5/3 slope of
    amplitude with wavelength, but no more frequencies than it has waves. The pattern drifts with the mean wind
    (Taylor's hypothesis): a crest that runs at an angle to it travels the slower, by the cosine.

    Args:
        mean_speed: at the reference height, m/s; 0 gives waves of amplitude 0.
        intensity: standard deviation along the wind over mean speed, 0.1 over water to 0.5 at a canopy.
        seed: same seed, same waves.
        azimuth: where the mean wind goes to, radians.
        along_count: waves that push along the wind.
        cross_count: waves that push across it.
    """
    rng = np.random.default_rng([seed, 0x57A7E5])
    count = along_count + cross_count
    wavelength = np.concatenate([_log_spaced(along_count, rng), _log_spaced(cross_count, rng)])
    oblique = rng.permutation(np.linspace(-TRAVEL_SPREAD, TRAVEL_SPREAD, count))
    across = np.arange(count) >= along_count
    # Long gusts strike harder than they leave; short ones are as plain as the air across the wind.
    power = np.where(across, 1.0, np.round(np.interp(wavelength, [SHORTEST, LONGEST], [1.0, 3.0])))
    return Waves(
        travel=azimuth + oblique,
        push=azimuth + rng.uniform(-PUSH_SPREAD, PUSH_SPREAD, count) + np.where(across, 0.5 * math.pi, 0.0),
        wavelength=wavelength,
        speed=mean_speed * np.cos(oblique) * rng.uniform(1.0 - CHANGE, 1.0 + CHANGE, count),
        amplitude=_amplitudes(wavelength, power, across, intensity * mean_speed),
        power=power,
        phase=rng.uniform(0.0, 2.0 * math.pi, count),
    )


def _log_spaced(count: int, rng: np.random.Generator) -> Reals:
    """(count,) wavelengths, one drawn from each of equal slices of the log range, so that none is a multiple."""
    slices = (np.arange(count) + rng.uniform(0.2, 0.8, count)) / max(count, 1)
    return SHORTEST * (LONGEST / SHORTEST) ** slices


def _amplitudes(wavelength: Reals, power: Reals, across: NDArray[np.bool_], deviation: float) -> Reals:
    """(W,) amplitudes whose along and cross parts have the asked standard deviations, m/s.

    Energy per octave falls as wavelength^(2/3) in a -5/3 spectrum, so amplitude as wavelength^(1/3).
    """
    shape = np.cbrt(wavelength)
    amplitude = np.zeros_like(shape)
    for part, target in ((~across, deviation), (across, CROSS_RATIO * deviation)):
        if part.any():
            total = np.sqrt(np.sum((shape[part] * wave_deviation(power[part])) ** 2))
            amplitude[part] = target * shape[part] / total
    return amplitude
