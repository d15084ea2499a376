"""training_wind: the wind in which errors of levels are measured."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from windswept.levels.static_shapes import STATED_WIND
from windswept.motion import Level
from windswept.plants.plant import Floats
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.velocity import velocity
from windswept.wind.waves import WaveSchedule, WaveSet
from windswept.wind.wind import Wind

PLACEMENTS = 8
"""Plants that stand in different parts of the same wind: one register of lanes."""
APART = 97.0
"""Distance between them, m: farther than gusts are long."""
ONSET = 1.0
"""Time over which the wind gets up from calm, s."""

Air = Callable[[Level, float], Floats]
"""(PLACEMENTS, B, 3) air velocity at the B probes of a level at a time in s, m/s."""


def training_wind(seed: int = 0, top_speed: float = STATED_WIND) -> Wind:
    """Turbulence, and every nine seconds a gust, soft or sharp, that brings the air to about the top speed (m/s)."""
    mean = 0.5 * top_speed
    rng = np.random.default_rng(seed)
    gusts = tuple(
        Gust(
            start=float(start),
            position=(-20.0, 0.0),
            azimuth=float(rng.uniform(-0.6, 0.6)),
            strength=float(rng.uniform(0.2, 0.5)) * top_speed,
            speed=mean * 1.5,
            rise_length=float(rng.uniform(2.0, 20.0)),
        )
        for start in np.arange(-90.0, 600.0, 9.0)
    )
    waves = WaveSet(plausible_waves(mean, 0.25, seed))
    return Wind(mean=MeanWind(speed=mean), waves=WaveSchedule((waves,)), gusts=gusts)


def wind_on(level: Level, wind: Wind, time: float) -> Floats:
    """(PLACEMENTS, B, 3) wind at the level's probes of plants that stand in a row along the wind, m/s."""
    probes = level.probe_position
    shift = APART * np.arange(PLACEMENTS, dtype=np.float32)
    points = np.tile(probes, (PLACEMENTS, 1))
    points[:, 0] += np.repeat(shift, len(probes))
    points[:, 1] += 0.5 * np.repeat(shift, len(probes))
    return velocity(wind, points, np.maximum(points[:, 2], 0.0), time).reshape(PLACEMENTS, -1, 3)


def training_air(seed: int = 0, top_speed: float = STATED_WIND) -> Air:
    """The training wind as it gets up from calm, nowhere faster than the top speed, at the probes of any level."""
    wind = training_wind(seed, top_speed)

    def blow(level: Level, time: float) -> Floats:
        late = np.float32(min(time / ONSET, 1.0))
        air = wind_on(level, wind, time)
        speed = np.linalg.norm(air, axis=2, keepdims=True)
        return air * (late * late * (3.0 - 2.0 * late) * np.minimum(1.0, top_speed / np.maximum(speed, 1e-6)))

    return blow
