"""Turbulent wind at a plant's probes, and where its links' tips are: what the studies of motion models share."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from windswept.motion import Model, State, finest_level, pose_links
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats, Ints
from windswept.wind.mean import MeanWind
from windswept.wind.plausible_waves import CROSS_RATIO
from windswept.wind.velocity import velocity
from windswept.wind.waves import Waves, WaveSchedule, WaveSet
from windswept.wind.wind import Wind

APART = 97.0
"""Distance between placements in the wind, m: farther than gusts are long."""
INTENSITY = 0.25
"""Standard deviation of the wind's speed over its mean."""

LONGEST, SHORTEST = 80.0, 1.0
"""Wavelengths, m."""
WAVE_COUNT = 40
"""Waves that push along the wind, and as many across it."""
TRAVEL_SPREAD = np.radians(60.0)
"""Crests travel within this angle of the mean wind."""

Air = Callable[[float], Floats]
"""(P, B, 3) air velocity at the probes of every placement at a time in s, m/s."""


def turbulent_air(model: Model, mean_speed: float, seed: int, placements: int = 1) -> Air:
    """Turbulence over plants that stand in a row, at their probes.

    Args:
        model: the plant's constants.
        mean_speed: at 10 m height, m/s.
        seed: of the turbulence.
        placements: P.
    """
    waves = WaveSet(fine_waves(mean_speed, seed))
    wind = Wind(mean=MeanWind(speed=mean_speed), waves=WaveSchedule((waves,)))
    probes = model.probe_position
    points = np.tile(probes, (placements, 1))
    shift = np.repeat(APART * np.arange(placements, dtype=np.float32), len(probes))
    points[:, 0] += shift
    points[:, 1] += np.float32(0.5) * shift
    height = np.maximum(points[:, 2], 1.0).astype(np.float32)
    return lambda time: velocity(wind, points, height, time).reshape(placements, -1, 3)


def fine_waves(mean_speed: float, seed: int) -> Waves:
    """Plane waves that drift with the mean wind, from tens of metres down to a limb's size, so dense that their
    energy falls as the -5/3 power of frequency through all bands in which plants sway.

    Args:
        mean_speed: m/s.
        seed: of their phases and directions.
    """
    rng = np.random.default_rng([seed, 0x7A3B])
    wavelength = np.geomspace(LONGEST, SHORTEST, 2 * WAVE_COUNT) * rng.uniform(0.97, 1.03, 2 * WAVE_COUNT)
    travel = rng.uniform(-TRAVEL_SPREAD, TRAVEL_SPREAD, 2 * WAVE_COUNT)
    across = np.arange(2 * WAVE_COUNT) % 2 == 1
    amplitude = np.cbrt(wavelength) * np.where(across, CROSS_RATIO, 1.0)
    # A sine of amplitude a has the variance a^2 / 2.
    amplitude *= INTENSITY * mean_speed / np.sqrt(0.5 * np.sum(amplitude[~across] ** 2))
    return Waves(
        travel=travel,
        push=np.where(across, 0.5 * np.pi, 0.0),
        wavelength=wavelength,
        speed=mean_speed * np.cos(travel),
        amplitude=amplitude,
        power=np.ones(2 * WAVE_COUNT),
        phase=rng.uniform(0.0, 2.0 * np.pi, 2 * WAVE_COUNT),
    )


def link_tips(model: Model, state: State, links: Ints) -> Floats:
    """(P, n, 3) where the far ends of some links are at level 0, m."""
    pose = pose_links(model, finest_level(model), state)
    q, d = pose.rotation[:, links], model.skeleton.vector[links].astype(np.float32)
    t = 2.0 * np.cross(q[..., :3], d)
    return pose.position[:, links] + d + q[..., 3:] * t + np.cross(q[..., :3], t)


def rms(apart: Floats | Doubles) -> float:
    """Root mean square length of (..., 3) vectors."""
    return float(np.sqrt(np.mean(np.sum(np.square(apart, dtype=np.float64), axis=-1))))
