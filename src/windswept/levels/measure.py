"""measure: the errors of a plant's levels as they come out in wind, beside those that were reckoned."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from windswept.levels.ladder import Ladder
from windswept.levels.static_shapes import STATED_WIND
from windswept.motion import Level, Model, State, Stepper, pose_links, rest_state
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats, Ints
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
MOST_TIPS = 500
"""Stem tips that are followed, evenly picked."""
SUBSTEPS = 4
"""Inner steps between two samples of the wind."""
FOLLOW_EVERY = 3
"""Samples of the wind between two looks at the tips."""


@dataclass(frozen=True, slots=True)
class Measured:
    """Errors of K levels against level 0 over the tips, placements and moments that were looked at."""

    p95: Doubles
    """(K,) 95th percentile, m."""
    largest: Doubles
    """(K,) m."""
    rms: Doubles
    """(K,) m."""
    motion: float
    """Root mean square displacement of the tips from rest at level 0, m."""


def training_wind(seed: int = 0, top_speed: float = STATED_WIND) -> Wind:
    """Turbulence with gusts whose fastest air at 10 m height is about the given speed, m/s."""
    mean = 0.45 * top_speed
    rng = np.random.default_rng(seed)
    gusts = tuple(
        Gust(
            start=float(start),
            position=(-20.0, 0.0),
            azimuth=float(rng.uniform(-0.4, 0.4)),
            strength=float(rng.uniform(0.1, 0.3)) * top_speed,
            speed=mean * 1.5,
        )
        for start in np.arange(3.0, 600.0, 9.0)
    )
    waves = WaveSet(plausible_waves(mean, 0.25, seed))
    return Wind(mean=MeanWind(speed=mean), waves=WaveSchedule((waves,)), gusts=gusts)


def measure(ladder: Ladder, seconds: float = 20.0, wind: Wind | None = None) -> Measured:
    """Runs every level in the same wind and compares the tips of all stems with level 0.

    Args:
        ladder: of one plant.
        seconds: length of the run.
        wind: in which; None for the training wind at the stated speed.
    """
    model, air = ladder.hierarchy.model, training_wind() if wind is None else wind
    tips = _followed_tips(model)
    states = [rest_state(level, PLACEMENTS) for level in ladder.levels]
    steppers = [Stepper(level) for level in ladder.levels]
    rest = tip_positions(model, ladder.levels[0], states[0], tips)
    errors: list[Doubles] = []
    moved = []
    interval = SUBSTEPS * ladder.levels[0].time_step
    for sample in range(round(seconds / interval)):
        for stepper, state in zip(steppers, states, strict=True):
            before = wind_on(stepper.level, air, sample * interval)
            stepper.step(state, before, wind_on(stepper.level, air, (sample + 1) * interval), SUBSTEPS)
        if sample % FOLLOW_EVERY == 0:
            seen = [
                tip_positions(model, level, s, tips) for level, s in zip(ladder.levels, states, strict=True)
            ]
            errors.append(np.linalg.norm(np.array(seen) - seen[0], axis=-1).reshape(len(seen), -1))
            moved.append(np.mean(np.sum((seen[0] - rest) ** 2, axis=-1)))
    every = np.concatenate(errors, axis=1)
    return Measured(
        np.percentile(every, 95.0, axis=1),
        every.max(axis=1),
        np.sqrt(np.mean(every**2, axis=1)),
        float(np.sqrt(np.mean(moved))),
    )


def with_measured_errors(ladder: Ladder, measured: Measured) -> Ladder:
    """The ladder with its 95 % errors as measured, never falling from one level to the next."""
    return replace(ladder, error=np.maximum.accumulate(measured.p95))


def wind_on(level: Level, wind: Wind, time: float) -> Floats:
    """(PLACEMENTS, B, 3) wind at the level's probes of plants that stand in a row along the wind, m/s."""
    probes = level.probe_position
    shift = APART * np.arange(PLACEMENTS, dtype=np.float32)
    points = np.tile(probes, (PLACEMENTS, 1))
    points[:, 0] += np.repeat(shift, len(probes))
    points[:, 1] += 0.5 * np.repeat(shift, len(probes))
    return velocity(wind, points, np.maximum(points[:, 2], 0.0), time).reshape(PLACEMENTS, -1, 3)


def tip_positions(model: Model, level: Level, state: State, links: Ints) -> Floats:
    """(P, n, 3) where the far ends of some links are, m."""
    pose = pose_links(model, level, state)
    q, d = pose.rotation[:, links], model.skeleton.vector[links].astype(np.float32)
    t = 2.0 * np.cross(q[..., :3], d)
    return pose.position[:, links] + d + q[..., 3:] * t + np.cross(q[..., :3], t)


def _followed_tips(model: Model) -> Ints:
    """Last links of stems, evenly picked."""
    skeleton = model.skeleton
    last = np.append(skeleton.stem_first_link[1:], model.link_count) - 1
    step = max(1, len(last) // MOST_TIPS)
    return last[::step].astype(np.int32)
