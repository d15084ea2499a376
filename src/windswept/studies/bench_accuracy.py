"""How true the levels' stated errors are: six plants, all tips, a minute of a wind that no error was stated from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.signal import welch

from windswept.levels import Ladder, bound_errors, build_ladder, measure, simplify, with_measured_errors
from windswept.levels.measure import follow, followed_tips
from windswept.levels.training_wind import training_air
from windswept.motion import build_model
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats
from windswept.plants.sources import grow_source
from windswept.studies.branch_scene import bare

SOURCES = (
    ("quaking_aspen", "quaking_aspen"),
    ("scots_pine", "scots_pine"),
    ("black_tupelo", "black_tupelo"),
    ("california_black_oak", "california_black_oak"),
    ("bare_aspen", "quaking_aspen"),
    ("hogeweg_bush", "hogeweg_bush"),
)
"""Name in the figures, and source: four trees, one of them without its leaves, and a grammar's tree."""
SECONDS, SEED = 60.0, 1
"""Of the wind that the statements are held against; they are made from another."""
BANDS = ((0.1, 0.5), (0.5, 2.0), (2.0, 8.0))
"""Hz."""
BAND_TIPS, BAND_SECONDS = 60, 30.0
"""Tips and seconds from which spectra are taken."""


@dataclass(frozen=True, slots=True)
class Held:
    """What came of K levels in the other wind."""

    largest: Doubles
    """(K,) m."""
    p95: Doubles
    """(K,) m."""
    violations: Doubles
    """(K,) moments and tips at which an error was above the bound."""


def bench_accuracy(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``accuracy.<plant>.<level>.*``; pixels are those at the distance from which the level is used."""
    figures: dict[str, float] = {}
    tight = []
    for name, source in SOURCES:
        say(f"accuracy, {name}")
        plant = grow_source(source, 1)
        ladder = build_ladder(simplify(build_model(bare(plant) if name.startswith("bare") else plant)))
        ladder = with_measured_errors(ladder, measure(ladder), bound_errors(ladder))
        assert ladder.bound is not None
        held, bands = hold(ladder), band_errors(ladder)
        for rung in range(1, len(ladder.levels)):
            at, pixel = f"accuracy.{name}.{rung}", ladder.error[rung]
            figures[f"{at}.links"] = ladder.oscillators[rung]
            figures[f"{at}.violations"] = held.violations[rung]
            figures[f"{at}.bound_over_max"] = ladder.bound[rung] / held.largest[rung]
            figures[f"{at}.p95_pixels"] = held.p95[rung] / pixel
            figures[f"{at}.max_pixels"] = held.largest[rung] / pixel
            for (low, high), decibels in zip(BANDS, bands[rung], strict=True):
                figures[f"{at}.decibels_{low:g}_to_{high:g}_hz"] = decibels
            tight.append(ladder.bound[rung] / held.largest[rung])
    figures["accuracy.median_bound_over_max"] = float(np.median(tight))
    figures["accuracy.violations"] = sum(v for k, v in figures.items() if k.endswith(".violations"))
    return figures


def hold(ladder: Ladder, seconds: float = SECONDS, seed: int = SEED) -> Held:
    """Holds a ladder's bound against every stem's tip in a wind that its errors were not measured in.

    Args:
        ladder: with its bound.
        seconds: of wind.
        seed: of the wind.
    """
    assert ladder.bound is not None
    tips = followed_tips(ladder.hierarchy.model, ladder.hierarchy.model.link_count)
    largest, violations = np.zeros(len(ladder.levels)), np.zeros(len(ladder.levels))
    sampled = []
    for now, _, _ in follow(ladder, seconds, training_air(seed), tips):
        error = np.linalg.norm(now - now[:1], axis=-1)
        largest = np.maximum(largest, error.max(axis=(1, 2)))
        violations += (error > ladder.bound[:, None, None]).sum(axis=(1, 2))
        sampled.append(error[:, :, :: max(1, len(tips) // 500)].reshape(len(error), -1))
    return Held(largest, np.percentile(np.concatenate(sampled, axis=1), 95.0, axis=1), violations)


def band_errors(ladder: Ladder) -> Doubles:
    """(K, 3) power of the tips' motion at each level over that at level 0, in each band, dB; NaN where none is seen.

    Args:
        ladder: with its stated errors, which are one pixel at the distance from which each level is used.
    """
    tips = followed_tips(ladder.hierarchy.model, BAND_TIPS)
    looks = [now for now, _, _ in follow(ladder, BAND_SECONDS, training_air(SEED), tips, every=1)]
    track = np.array(looks)[30:]
    rate = 1.0 / (4.0 * ladder.hierarchy.model.time_step)
    power = np.array([_band_powers(track[:, level], rate) for level in range(len(ladder.levels))])
    seen = 2.0 * power[0] > ladder.error[:, None, None] ** 2
    either = np.where(seen, power, 0.0).sum(axis=2), np.where(seen, power[0], 0.0).sum(axis=2)
    ratio = np.maximum(either[0], 1e-30) / np.maximum(either[1], 1e-30)
    return np.where(either[1] > 0.0, 10.0 * np.log10(ratio), np.nan)


def _band_powers(track: Floats, rate: float) -> Doubles:
    """(3, P * n) mean square of a motion (T, P, n, 3) within each band, m^2."""
    frequency, density = welch(track.reshape(len(track), -1), fs=rate, nperseg=256, axis=0)
    powers = []
    for low, high in BANDS:
        within = (frequency >= low) & (frequency < high)
        powers.append(density[within].sum(axis=0).reshape(-1, 3).sum(axis=1) * frequency[1])
    return np.array(powers)
