"""From the wind tables of a scene file to Wind."""

from __future__ import annotations

import math

import numpy as np

from windswept.errors import InputError
from windswept.scene.form import GustForm, WaveForm, WindForm
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind, Profile
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.waves import AS_PRINTED, Waves, WaveSchedule, WaveSet
from windswept.wind.wind import Wind


def build_wind(source: str, form: WindForm, seed: int) -> Wind:
    """The wind of a scene.

    Args:
        source: the scene file, for error messages.
        form: its [wind] table.
        seed: of the turbulence.

    Raises:
        InputError: keys that contradict each other.
    """
    azimuth = math.radians(form.direction_degrees)
    sets = (
        [WaveSet(plausible_waves(form.speed_m_s, form.turbulence, seed, azimuth))]
        if _is_turbulent(form)
        else []
    )
    sets += [_build_wave(source, f"wind.waves[{i}]", wave, azimuth) for i, wave in enumerate(form.waves)]
    return Wind(
        profile=_build_profile(source, form),
        mean=MeanWind(form.speed_m_s, azimuth),
        waves=WaveSchedule(tuple(sets)),
        gusts=tuple(_build_gust(gust, azimuth) for gust in form.gust),
    )


def _is_turbulent(form: WindForm) -> bool:
    return form.speed_m_s > 0.0 and form.turbulence > 0.0


def _build_profile(source: str, form: WindForm) -> Profile:
    """The height profile; the canopy must stay below the height at which speeds are stated."""
    try:
        return Profile(form.roughness_m, form.displacement_m)
    except InputError:
        most = Profile.reference_height - math.e * form.roughness_m
        expected = f"a number below {most:.2f} with roughness_m = {form.roughness_m:g}"
        raise InputError(source, "wind.displacement_m", form.displacement_m, expected) from None


def _build_gust(form: GustForm, mean_azimuth: float) -> Gust:
    """One gust; its direction is the mean wind's unless given."""
    return Gust(
        start=form.start_s,
        strength=form.strength_m_s,
        azimuth=_azimuth(form.direction_degrees, mean_azimuth),
        position=form.position,
        speed=form.speed_m_s,
        rise_length=form.rise_m,
        hold_length=form.hold_m,
        decay_length=form.decay_m,
        width=math.inf if form.width_m is None else form.width_m,
    )


def _build_wave(source: str, place: str, form: WaveForm, mean_azimuth: float) -> WaveSet:
    """One train of waves as a set of its own."""
    if form.form == AS_PRINTED and form.power != round(form.power):
        raise InputError(source, f"{place}.power", form.power, 'a whole number, as form = "as_printed"')
    start = -math.inf if form.start_s is None else form.start_s
    end = math.inf if form.end_s is None else form.end_s
    if not end > start:
        raise InputError(source, f"{place}.end_s", form.end_s, f"a time after start_s = {start:g}")
    travel = _azimuth(form.direction_degrees, mean_azimuth)
    waves = Waves(
        travel=np.array([travel]),
        push=np.array([_azimuth(form.push_degrees, travel)]),
        wavelength=np.array([form.wavelength_m]),
        speed=np.array([form.speed_m_s]),
        amplitude=np.array([form.amplitude_m_s]),
        power=np.array([form.power]),
        phase=np.array([math.radians(form.phase_degrees)]),
        form=form.form,
    )
    return WaveSet(waves, start=start, end=end, fade=form.fade_s)


def _azimuth(degrees: float | None, otherwise: float) -> float:
    """An azimuth in radians, or the one to follow where none is given."""
    return otherwise if degrees is None else math.radians(degrees)
