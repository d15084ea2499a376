"""Nutrients: what the ground holds for plants, the same everywhere, in patches, or from an image."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from windswept.scene.terrain import spline_noise

Reals = NDArray[np.float64]

POINTS_A_PATCH, MOST_POINTS = 8, 1025
"""Points of the map from one patch to the next, and most points a side."""
OCTAVES, OCTAVE_GAIN = 3, 0.5
"""Layers of noise, each with half the patches and this much of the strength of the one before."""


@dataclass(frozen=True, slots=True)
class Nutrient:
    """One nutrient over a square ground centred on the origin."""

    name: str
    size: float
    """Edge of the ground, m."""
    map: Reals
    """(K, K) amount a square metre, first axis from south to north, the outer points on the edge."""

    def amount(self, x: Reals, y: Reals) -> Reals:
        """Amount a square metre, bilinear, at x, y of any one shape, m."""
        last = len(self.map) - 1
        place = [(coordinate / self.size + 0.5) * last for coordinate in (y, x)]
        return np.asarray(map_coordinates(self.map, place, order=1, mode="nearest"))


def constant_nutrient(name: str, size: float, amount: float) -> Nutrient:
    """The same everywhere."""
    return Nutrient(name, size, np.full((2, 2), amount))


def noise_nutrient(
    name: str, size: float, poor: float, rich: float, patch: float, rng: np.random.Generator
) -> Nutrient:
    """Soft patches, from ``poor`` to ``rich`` somewhere on the ground.

    Args:
        name: of the nutrient.
        size: edge of the ground, m.
        poor: least amount a square metre.
        rich: greatest.
        patch: from one rich patch to the next, m.
        rng: drawn from once an octave.
    """
    waves = size / patch
    points = int(np.clip(POINTS_A_PATCH * 2 ** (OCTAVES - 1) * waves, 16, MOST_POINTS - 1)) + 1
    noise = np.zeros((points, points))
    for octave in range(OCTAVES):
        noise += OCTAVE_GAIN**octave * spline_noise(points, waves * 2.0**octave, rng)
    span = np.ptp(noise)
    share = (noise - noise.min()) / span if span > 0.0 else np.ones_like(noise)
    return Nutrient(name, size, poor + (rich - poor) * share)


def image_nutrient(name: str, size: float, poor: float, rich: float, grey: Reals) -> Nutrient:
    """From an image: (K, K) from 0 poor to 1 rich, the first row in the north."""
    return Nutrient(name, size, poor + (rich - poor) * grey[::-1])
