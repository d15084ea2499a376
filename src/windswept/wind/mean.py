"""The mean wind and how wind speed grows with height above ground."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from windswept.errors import InputError


@dataclass(frozen=True)
class Profile:
    """Speed at a height over speed at the reference height: log law above, exponential canopy below.

    The two meet at ``join_height`` with equal value and slope; nowhere is the factor negative.
    """

    roughness: float = 0.1
    """Roughness length z0, m: 0.01 short grass, 0.1 farmland with hedges, 1 forest."""
    displacement: float = 0.0
    """Displacement height d, m: about 0.7 of the height of a closed canopy, 0 in the open."""
    reference_height: float = 10.0
    """Height above ground at which sources state their speed, m."""

    def __post_init__(self) -> None:
        self.validate()

    def validate(self) -> None:
        """Raise InputError where a length is out of range or the reference lies inside the canopy."""
        if not (self.roughness > 0.0 and math.isfinite(self.roughness)):
            raise InputError("wind profile", "roughness", self.roughness, "a length above 0 m")
        if not (self.displacement >= 0.0 and math.isfinite(self.displacement)):
            raise InputError("wind profile", "displacement", self.displacement, "a height of 0 m or more")
        if not (math.isfinite(self.reference_height) and self.reference_height > self.join_height):
            expected = f"a height above displacement + e roughness = {self.join_height:.2f} m"
            raise InputError("wind profile", "reference_height", self.reference_height, expected)

    @property
    def join_height(self) -> float:
        """Height d + e z0 where the log law hands over to the canopy, m.

        With d = 0.7 h and z0 = 0.1 h this is 0.97 h, the canopy top itself.
        """
        return self.displacement + math.e * self.roughness

    @property
    def attenuation(self) -> float:
        """Canopy coefficient a of U_h exp(a (z/h - 1)) that makes the slope continuous at the join."""
        return self.join_height / (math.e * self.roughness)

    @property
    def log_reference(self) -> float:
        """ln((z_ref - d) / z0), by which the factor is normalised."""
        return math.log((self.reference_height - self.displacement) / self.roughness)


@dataclass(frozen=True)
class MeanWind:
    """The steady part of the wind."""

    speed: float = 0.0
    """At the profile's reference height, m/s."""
    azimuth: float = 0.0
    """Where the air goes to, radians counter-clockwise from +x."""

    @property
    def vector(self) -> tuple[float, float]:
        """Horizontal velocity at the reference height, m/s."""
        return self.speed * math.cos(self.azimuth), self.speed * math.sin(self.azimuth)


def profile_factor(profile: Profile, height: ArrayLike) -> NDArray[np.float64]:
    """Speed at a height over speed at the reference height.

    Args:
        profile: roughness, displacement and reference height.
        height: any shape, m above ground; below ground counts as on it.

    Returns:
        Same shape, dimensionless. Above the join ln((z-d)/z0), below it U_h exp(a (z/h - 1)) (PHYSICS B5).
    """
    z = np.maximum(np.asarray(height, dtype=np.float64), 0.0)
    join = profile.join_height
    above = np.log((np.maximum(z, join) - profile.displacement) / profile.roughness)
    below = np.exp(profile.attenuation * (np.minimum(z, join) / join - 1.0))
    return np.where(z >= join, above, below) / profile.log_reference
