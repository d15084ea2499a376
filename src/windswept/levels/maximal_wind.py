"""maximal_wind: the hardest winds up to a speed, to find the largest errors that a level can make."""

from __future__ import annotations

import numpy as np

from windswept.levels.static_shapes import STATED_WIND
from windswept.levels.training_wind import PLACEMENTS, Air
from windswept.motion import Level, Model
from windswept.plants.plant import Floats

TRIAL_SECONDS = 12.0
"""Length of the trial, s."""
REVERSAL = 1.5
"""Time between two reversals of the wind, s."""
FRONT_PERIOD = 4.0
"""From one sharp front to the next, s; behind it the wind blows for half that time."""
FRONT_RISE = 2.0
"""From calm to full speed in such a front, m: as sharp as the sharpest gust of the training wind."""
PAUSES = (0.15, 0.3, 0.6, 1.2, 2.4)
"""How long the random wind holds a speed, a direction and a height, s."""
WHOLE_SHARE = 0.5
"""Share of the random wind that blows at every height; the rest blows above one, as over shelter."""


def maximal_wind(model: Model, speed: float = STATED_WIND, seed: int = 0) -> Air:
    """Eight winds at once that never exceed a speed and change as hard as wind can, and harder.

    They blow at full speed, all but the last at every height: a step, then calm; reversals; on and off at the plant's
    lowest and at its middle frequency, which drives the motion up; sharp fronts that cross the crown at full and at
    half speed; a wind that turns at the lowest frequency; a random sequence of speeds, directions and heights above
    which it blows.

    Args:
        model: of the plant.
        speed: that is never exceeded, m/s.
        seed: of the random wind.
    """
    lowest = float(model.stem_frequency[model.skeleton.stem[0]]) / (2.0 * np.pi)
    middle = float(np.median(model.stem_frequency)) / (2.0 * np.pi)
    every = model.probe_position
    times, drawn, calm_below = _random_sequence(speed, float(every[:, 2].max()), np.random.default_rng(seed))

    def blow(level: Level, time: float) -> Floats:
        probes = level.probe_position
        wind = np.zeros((PLACEMENTS, len(probes), 3), np.float32)
        if time <= 0.0:
            return wind
        wind[0] = _along(speed * (time < 0.5 * TRIAL_SECONDS), 0.3)
        wind[1] = _along(speed * (1.0 if time % (2.0 * REVERSAL) < REVERSAL else -1.0), 1.9)
        wind[2] = _along(speed * (lowest * time % 1.0 < 0.5), 2.6)
        wind[3] = _along(speed * (middle * time % 1.0 < 0.5), 4.0)
        wind[4] = _fronts(every, probes, time, speed, speed, 0.8)
        wind[5] = _fronts(every, probes, time, speed, 0.5 * speed, 3.9)
        wind[6] = _along(speed, 2.0 * np.pi * lowest * time)
        now = np.searchsorted(times, time, side="right") - 1
        wind[7, :, :2] = drawn[now] * (probes[:, 2:] >= calm_below[now])
        return wind

    return blow


def _along(speed: float, azimuth: float) -> Floats:
    """(3,) horizontal wind."""
    return np.array([speed * np.cos(azimuth), speed * np.sin(azimuth), 0.0], np.float32)


def _fronts(
    every: Floats, probes: Floats, time: float, speed: float, travel: float, azimuth: float
) -> Floats:
    """(B, 3) wind behind sharp fronts that travel along an azimuth at a speed of their own.

    The first reaches the first of ``every`` probe of the plant at time 0, whichever of them a level samples.
    """
    along = np.array([np.cos(azimuth), np.sin(azimuth)])
    behind = time * travel - (probes[:, :2] @ along - (every[:, :2] @ along).min())
    period = FRONT_PERIOD * travel
    within = np.where(behind > 0.0, behind % period, 0.0)
    rise = np.clip(np.minimum(within, 0.5 * period - within) / FRONT_RISE, 0.0, 1.0)
    return rise[:, None].astype(np.float32) * _along(speed, azimuth)


def _random_sequence(speed: float, height: float, rng: np.random.Generator) -> tuple[Floats, Floats, Floats]:
    """(n,) times, (n, 2) winds from each of them on, a third of them calm, and (n,) heights that they blow above."""
    pauses = rng.choice(PAUSES, 400)
    strength = speed * np.sqrt(rng.uniform(0.0, 1.0, 400)) * (rng.uniform(0.0, 1.0, 400) > 0.3)
    azimuth = rng.uniform(0.0, 2.0 * np.pi, 400)
    winds = strength[:, None] * np.column_stack([np.cos(azimuth), np.sin(azimuth)])
    calm_below = height * np.maximum(rng.uniform(-WHOLE_SHARE / (1.0 - WHOLE_SHARE), 1.0, 400), 0.0)
    times = np.cumsum(pauses) - pauses
    return times.astype(np.float32), winds.astype(np.float32), calm_below.astype(np.float32)
