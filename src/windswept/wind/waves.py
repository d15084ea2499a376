"""Travelling sine waves of air velocity: Skjermo 2007 section 4.1, with the corrections of PHYSICS C1.7-9."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import gamma

from windswept.errors import InputError
from windswept.wind.fade import smooth_step

Reals = NDArray[np.float64]

CORRECTED = "corrected"
AS_PRINTED = "as_printed"


@dataclass(frozen=True)
class Waves:
    """W waves, each a crest line that travels over the ground and pushes the air along ``push``.

    ``corrected``: a (2 ((sin+1)/2)^k - mean) with crests travelling along +travel: zero mean.
    ``as_printed``: a (sin/2)^k of Skjermo eq. 14 (segment length l = 1), crests travelling along -travel.
    """

    travel: Reals
    """(W,) azimuth of the wave's direction D, radians counter-clockwise from +x."""
    push: Reals
    """(W,) azimuth of the added velocity, radians; equals ``travel`` in the paper."""
    wavelength: Reals
    """(W,) distance between crests, m."""
    speed: Reals
    """(W,) speed of the crests, m/s."""
    amplitude: Reals
    """(W,) half of the range from trough to crest (at any k), at the reference height, m/s."""
    power: Reals
    """(W,) exponent k >= 1 that sharpens the crests; whole numbers are fast."""
    phase: Reals
    """(W,) phase at the origin at time 0, radians."""
    form: str = CORRECTED

    def __post_init__(self) -> None:
        for name in WAVE_FIELDS:
            object.__setattr__(self, name, np.atleast_1d(np.asarray(getattr(self, name), dtype=np.float64)))
        self.validate()

    def validate(self) -> None:
        """Raise InputError for unequal lengths, values out of range, or a power the printed form cannot take."""
        for name in WAVE_FIELDS:
            values = getattr(self, name)
            if values.shape != self.wavelength.shape:
                raise InputError("waves", name, values.shape, f"shape {self.wavelength.shape}")
            if not np.isfinite(values).all():
                raise InputError("waves", name, values.tolist(), "finite numbers")
        if not (self.wavelength > 0.0).all():
            raise InputError("waves", "wavelength", self.wavelength.tolist(), "lengths above 0 m")
        if not (self.power >= 1.0).all():
            raise InputError("waves", "power", self.power.tolist(), "powers of 1 or more")
        if self.form not in (CORRECTED, AS_PRINTED):
            raise InputError("waves", "form", self.form, f'"{CORRECTED}" or "{AS_PRINTED}"')
        if self.form == AS_PRINTED and (self.power % 1.0 != 0.0).any():
            expected = "whole powers: a negative sine has no real power in the printed form"
            raise InputError("waves", "power", self.power.tolist(), expected)

    @property
    def wave_count(self) -> int:
        """Number of waves, W."""
        return len(self.wavelength)


WAVE_FIELDS = ("travel", "push", "wavelength", "speed", "amplitude", "power", "phase")


@dataclass(frozen=True)
class WaveSet:
    """Waves that blow for a while and fade in and out inside that while."""

    waves: Waves
    start: float = -math.inf
    """s."""
    end: float = math.inf
    """s."""
    fade: float = 2.0
    """Seconds that fading in takes after ``start``, and fading out before ``end``."""

    def __post_init__(self) -> None:
        self.validate()

    def validate(self) -> None:
        """Raise InputError where the fade is negative or the end not after the start."""
        if not self.fade >= 0.0:
            raise InputError("wave set", "fade", self.fade, "0 s or more")
        if not self.end > self.start:
            raise InputError("wave set", "end", self.end, f"a time after the start at {self.start} s")

    def weight(self, time: float) -> float:
        """Share of the amplitude at a time, 0..1, continuous in value and slope."""
        if self.fade == 0.0:
            return float(self.start <= time < self.end)
        return float(
            smooth_step((time - self.start) / self.fade) * smooth_step((self.end - time) / self.fade)
        )


@dataclass(frozen=True)
class WaveTable:
    """The constants of W waves as the kernels read them; one row a wave."""

    turns_x: Reals
    """(W,) turns of phase per metre of x."""
    turns_y: Reals
    """(W,) turns of phase per metre of y."""
    turns_t: Reals
    """(W,) turns of phase per second."""
    turns_0: Reals
    """(W,) turns of phase at the origin at time 0."""
    push_x: Reals
    """(W,) m/s per unit of wave."""
    push_y: Reals
    """(W,) m/s per unit of wave."""
    bias: Reals
    """(W,) added to the sine before it is halved and raised."""
    power: Reals
    """(W,)"""
    mean: Reals
    """(W,) taken off the raised value."""
    set_index: NDArray[np.int32]
    """(W,) set of the schedule that the wave belongs to."""


COLUMNS = ("turns_x", "turns_y", "turns_t", "turns_0", "push_x", "push_y", "bias", "power", "mean")
"""The columns of WaveTable that follow from the waves alone."""


@dataclass(frozen=True)
class WaveSchedule:
    """Sets of waves that take over from one another without a jump."""

    sets: tuple[WaveSet, ...] = field(default=())

    @cached_property
    def table(self) -> WaveTable:
        """All waves of all sets, at full strength."""
        counts = [wave_set.waves.wave_count for wave_set in self.sets]
        parts = [np.zeros((len(COLUMNS), 0)), *(_columns(wave_set.waves) for wave_set in self.sets)]
        columns = dict(zip(COLUMNS, np.concatenate(parts, axis=1), strict=True))
        return WaveTable(**columns, set_index=np.repeat(np.arange(len(counts), dtype=np.int32), counts))

    def weights(self, time: float) -> Reals:
        """(W,) share of its amplitude that each wave of the table has at a time."""
        by_set = np.array([wave_set.weight(time) for wave_set in self.sets], dtype=np.float64)
        return by_set[self.table.set_index]


def _columns(waves: Waves) -> Reals:
    """(9, W) COLUMNS of some waves."""
    corrected = waves.form == CORRECTED
    # Printed: sin(D.x w + t phi) runs towards -D (C1.7). Gain 2 and bias 1 restore GPU Gems' form (C1.9).
    gain = (2.0 if corrected else 1.0) * waves.amplitude
    rate = waves.speed / waves.wavelength
    ones = np.ones(waves.wave_count)
    return np.array(
        [
            np.cos(waves.travel) / waves.wavelength,
            np.sin(waves.travel) / waves.wavelength,
            -rate if corrected else rate,
            waves.phase / (2.0 * np.pi),
            gain * np.cos(waves.push),
            gain * np.sin(waves.push),
            ones if corrected else 0.0 * ones,
            waves.power,
            mean_raised(waves.power) if corrected else 0.0 * ones,
        ]
    )


def mean_raised(power: ArrayLike) -> Reals:
    """Mean of ((sin+1)/2)^k over a turn: Gamma(k+1/2) / (sqrt(pi) Gamma(k+1)), C(2k,k)/4^k for whole k."""
    k = np.asarray(power, dtype=np.float64)
    return gamma(k + 0.5) / (math.sqrt(math.pi) * gamma(k + 1.0))


def wave_deviation(power: ArrayLike) -> Reals:
    """Standard deviation of a corrected wave of amplitude 1: 2 sqrt(m(2k) - m(k)^2) with m = mean_raised."""
    k = np.asarray(power, dtype=np.float64)
    return 2.0 * np.sqrt(mean_raised(2.0 * k) - mean_raised(k) ** 2)
