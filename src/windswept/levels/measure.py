"""measure: the errors of a plant's levels as they come out in wind, beside those that were reckoned."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from windswept.levels.ladder import Ladder
from windswept.levels.maximal_wind import TRIAL_SECONDS, maximal_wind
from windswept.levels.metrics import METRICS
from windswept.levels.training_wind import PLACEMENTS, Air, training_air
from windswept.motion import Level, Model, State, build_stepper, pose_links, rest_state
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats, Ints

MOST_TIPS = 500
"""Stem tips that are followed, evenly picked."""
SUBSTEPS = 4
"""Inner steps between two samples of the wind."""
FOLLOW_EVERY = 3
"""Samples of the wind between two looks at the tips."""
OTHER_TRIALS = 1.2
"""Bound over the largest error in the hardest winds, since they are eight of endlessly many."""
LARGEST_IN_PIXELS = 3.0
"""How many times the stated error the largest may be."""
OTHER_WINDS = 1.15
"""Stated error over that in the training wind, since no two winds are alike."""
SHORT_SECONDS, FEW_TIPS = 3.0, 120
"""A short measurement for plants of a scene: seconds of wind and stem tips."""


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


def measure(
    ladder: Ladder,
    seconds: float = 20.0,
    air: Air | None = None,
    metric: str = "displacement",
    most_tips: int = MOST_TIPS,
) -> Measured:
    """Runs every level in the same wind and compares the tips of all stems with level 0.

    Args:
        ladder: of one plant.
        seconds: length of the run.
        air: in which; None for the training wind at the stated speed.
        metric: what an error is; see METRICS. Errors are in its unit.
        most_tips: stem tips that are followed.
    """
    model = ladder.hierarchy.model
    tips = followed_tips(model, most_tips)
    rest = tip_positions(model, ladder.levels[0], rest_state(ladder.levels[0], PLACEMENTS), tips)
    errors: list[Floats] = []
    moved = []
    for now, before, apart in follow(ladder, seconds, training_air() if air is None else air, tips):
        errors.append(METRICS[metric].between(now, before, apart).reshape(len(now), -1))
        moved.append(np.mean(np.sum((now[0] - rest) ** 2, axis=-1)))
    every = np.concatenate(errors, axis=1)
    return Measured(
        np.percentile(every, 95.0, axis=1),
        every.max(axis=1),
        np.sqrt(np.mean(every**2, axis=1)),
        float(np.sqrt(np.mean(moved))),
    )


def bound_errors(ladder: Ladder, metric: str = "displacement") -> Doubles:
    """(K,) bound on the error of any tip in wind up to the stated speed, m; never falls among levels of one model.

    A bound by trial, not by proof: see docs/decisions/bounds-by-maximal-wind.md.

    Args:
        ladder: of one plant.
        metric: what an error is; see METRICS.
    """
    model = ladder.hierarchy.model
    tips = followed_tips(model, model.link_count)
    largest = np.zeros(len(ladder.levels))
    for now, before, apart in follow(ladder, TRIAL_SECONDS, maximal_wind(model), tips):
        error = METRICS[metric].between(now, before, apart)
        largest = np.maximum(largest, error.max(axis=(1, 2)))
    return OTHER_TRIALS * _rising(ladder, largest)


def with_measured_errors(ladder: Ladder, measured: Measured, bound: Doubles | None = None) -> Ladder:
    """The ladder with errors as measured: 95 % within the stated error, and the largest within three times it.

    Args:
        ladder: of one plant.
        measured: its errors in the training wind.
        bound: (K,) its largest errors in maximal wind, where they were sought.
    """
    return replace(ladder, error=_rising(ladder, stated_errors(measured)), bound=bound)


def _rising(ladder: Ladder, errors: Doubles) -> Doubles:
    """(K,) errors that never fall among the levels of one motion model."""
    rising = errors.copy()
    coupled = np.array([level.coupled for level in ladder.levels])
    for one in (coupled, ~coupled):
        rising[one] = np.maximum.accumulate(errors[one])
    return rising


def stated_errors(measured: Measured) -> Doubles:
    """(K,) what is stated of levels whose errors were measured, m."""
    return OTHER_WINDS * np.maximum(measured.p95, measured.largest / LARGEST_IN_PIXELS)


def measured_ladder(ladder: Ladder) -> Ladder:
    """The ladder with errors of a short measurement, for plants of a scene.

    Of a ladder with `multibody` only those levels are left that no cheaper level is as near to the truth as.
    """
    measured = measure(ladder, SHORT_SECONDS, most_tips=FEW_TIPS)
    if not ladder.levels[0].coupled:
        return with_measured_errors(ladder, measured)
    stated = stated_errors(measured)
    cheaper = np.minimum.accumulate(np.append(stated, np.inf)[::-1])[::-1][1:]
    kept = np.flatnonzero(stated < cheaper)
    return replace(
        ladder,
        levels=tuple(ladder.levels[k] for k in kept),
        error=stated[kept],
        tolerance=ladder.tolerance[kept],
        bound=None,
    )


def follow(
    ladder: Ladder, seconds: float, air: Air, tips: Ints, every: int = FOLLOW_EVERY
) -> Iterator[tuple[Floats, Floats, float]]:
    """Where tips are at every level, (K, P, n, 3) m, now and at the last look, and the seconds in between.

    Args:
        ladder: of one plant, all levels of which start from rest.
        seconds: length of the run.
        air: in which.
        tips: (n,) links whose far ends are looked at.
        every: samples of the wind, 30 a second, between two looks.
    """
    model, levels = ladder.hierarchy.model, ladder.levels
    states = [rest_state(level, PLACEMENTS) for level in levels]
    steppers = [build_stepper(model, level) for level in levels]
    interval = SUBSTEPS * model.time_step

    def look() -> Floats:
        return np.array([tip_positions(model, *pair, tips) for pair in zip(levels, states, strict=True)])

    before = look()
    for sample in range(round(seconds / interval)):
        for stepper, state in zip(steppers, states, strict=True):
            start = air(stepper.level, sample * interval)
            stepper.step(state, start, air(stepper.level, (sample + 1) * interval), SUBSTEPS)
        if sample % every == every - 1:
            now = look()
            yield now, before, every * interval
            before = now


def tip_positions(model: Model, level: Level, state: State, links: Ints) -> Floats:
    """(P, n, 3) where the far ends of some links are, m."""
    return pose_links(model, level, state).ends(model.skeleton.vector, links)


def followed_tips(model: Model, most: int) -> Ints:
    """Last links of stems, evenly picked."""
    skeleton = model.skeleton
    last = np.append(skeleton.stem_first_link[1:], model.link_count) - 1
    return last[:: max(1, len(last) // most)].astype(np.int32)
