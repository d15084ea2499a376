"""Wind: a height profile and the sources that add up under it."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from windswept.wind.gusts import Gust, gust_table
from windswept.wind.mean import MeanWind, Profile
from windswept.wind.waves import WaveSchedule


@dataclass(frozen=True)
class Wind:
    """Air velocity as profile(height) x (mean + waves + gusts); see ``velocity``."""

    profile: Profile = field(default_factory=Profile)
    mean: MeanWind = field(default_factory=MeanWind)
    waves: WaveSchedule = field(default_factory=WaveSchedule)
    gusts: tuple[Gust, ...] = ()

    @cached_property
    def gust_rows(self) -> NDArray[np.float64]:
        """(G, 11) see ``gusts.GUST_COLUMNS``."""
        return gust_table(self.gusts)


def calm() -> Wind:
    """Air that stands exactly still."""
    return Wind()
