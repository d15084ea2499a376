"""Agents that push: rain, a ball that rolls, a person who walks, a helicopter that hovers or flies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from windswept.wind.fade import smooth_step
from windswept.wind.field.acts import Act, Body, Jet, Shower
from windswept.wind.field.path import Path

GRAVITY = 9.81
"""m/s^2."""
WATER = 1000.0
"""kg/m^3."""
AIR = 1.2
"""kg/m^3."""
RAIN_TICK = 1.0 / 30.0
"""Drops are counted over so long, s, whatever the step: the same drops fall at any frame rate."""
FADE = 1.0
"""A helicopter's jet comes and goes within this, s."""
STEP_PLANTED = 0.6
"""Share of a stride for which a foot stands (walking; Perry's textbook has 60 %)."""


@dataclass(frozen=True)
class Ball:
    """A ball that rolls along a path."""

    path: Path
    radius: float = 0.11
    """m."""
    pressure: float = 400.0
    """On plants below its middle, N/m^2: that of a wind of 25 m/s, which lays grass flat."""

    def acts(self, start: float, stop: float, shape: tuple[int, int], area: float) -> Sequence[Act]:
        """A body on the ground, while on its path; see ``Agent``."""
        if not self.path.covers(stop):
            return ()
        velocity = (*self.path.velocity(start, stop), 0.0)
        places = self.path.place(start), self.path.place(stop)
        return (Body(*places, 0.0, self.radius, self.radius, self.pressure, velocity),)


@dataclass(frozen=True)
class Walker:
    """A person on foot: two legs, of which one or both stand."""

    path: Path
    mass: float = 70.0
    """kg."""
    step_length: float = 0.7
    """From one foot to the other, m."""
    leg_length: float = 0.85
    """m."""
    leg_radius: float = 0.08
    """m."""
    leg_pressure: float = 400.0
    """On plants that a leg brushes aside, N/m^2."""
    foot_radius: float = 0.1
    """Of a disc as large as a sole, m."""
    apart: float = 0.1
    """Of each foot from the path, m."""
    lift: float = 0.1
    """Of a foot that swings, m."""

    def acts(self, start: float, stop: float, shape: tuple[int, int], area: float) -> Sequence[Act]:
        """Two legs and the soles that stand, while on the path; see ``Agent``."""
        if not self.path.covers(stop):
            return ()
        bodies: list[Act] = []
        for side in (-1.0, 1.0):
            x0, y0, _ = self.foot(start, side)
            x1, y1, lift = self.foot(stop, side)
            velocity = ((x1 - x0) / (stop - start), (y1 - y0) / (stop - start), 0.0)
            low = lift + self.leg_radius if lift > 0.0 else 0.0
            leg = (low, self.leg_length, self.leg_radius, self.leg_pressure, velocity)
            bodies.append(Body((x0, y0), (x1, y1), *leg))
            if lift == 0.0:
                pressure = self.mass * GRAVITY / (math.pi * self.foot_radius**2)
                bodies.append(Body((x1, y1), (x1, y1), 0.0, 0.0, self.foot_radius, pressure))
        return bodies

    def foot(self, time: float, side: float) -> tuple[float, float, float]:
        """x, y and lift of the left (-1) or right (1) foot, m."""
        stride = 2.0 * self.step_length
        strides, phase = divmod(self.path.length(time) / stride + (0.5 if side > 0.0 else 0.0), 1.0)
        swing = max(0.0, (phase - STEP_PLANTED) / (1.0 - STEP_PLANTED))
        # A foot is set down ahead of the body and taken up behind it, by as much.
        ahead = 0.5 * STEP_PLANTED - (0.5 if side > 0.0 else 0.0)
        gone = (strides + float(smooth_step(swing)) + ahead) * stride
        x, y = self.path.place_after(gone)
        ahead_x, ahead_y = self.path.place_after(gone + 0.5 * stride)
        long = math.hypot(ahead_x - x, ahead_y - y)
        right = ((ahead_y - y) / long, (x - ahead_x) / long) if long > 0.0 else (0.0, 0.0)
        lift = self.lift * math.sin(math.pi * swing) if swing > 0.0 else 0.0
        return x + side * self.apart * right[0], y + side * self.apart * right[1], lift


@dataclass(frozen=True)
class Helicopter:
    """The downwash of a helicopter over a path: a jet that spreads along the ground."""

    path: Path
    mass: float = 2000.0
    """kg."""
    rotor_radius: float = 5.0
    """m."""

    @property
    def speed(self) -> float:
        """Of the air far below the rotor, twice that through its disc, sqrt(2 W / (rho A)), m/s (momentum theory)."""
        disc = math.pi * self.rotor_radius**2
        return math.sqrt(2.0 * self.mass * GRAVITY / (AIR * disc))

    def acts(self, start: float, stop: float, shape: tuple[int, int], area: float) -> Sequence[Act]:
        """A jet that comes and goes within FADE at the path's ends; see ``Agent``."""
        if not self.path.covers(stop):
            return ()
        first, last = self.path.times[0], self.path.times[-1]
        share = float(smooth_step((stop - first) / FADE) * smooth_step((last - stop) / FADE))
        # The stream contracts to half of the disc's area below the rotor.
        radius = self.rotor_radius / math.sqrt(2.0)
        return (Jet(self.path.place(stop), radius, share * self.speed, radius / 3.0),)


@dataclass(frozen=True)
class Rain:
    """Drops that fall everywhere, each a small push."""

    rate: float
    """mm/h: 2 light, 10 heavy, 50 a cloudburst."""
    drop: float = 2.0
    """Diameter of the drops, mm."""
    seed: int = 0
    """Same seed, same rain."""
    start: float = -math.inf
    """s."""
    end: float = math.inf
    """s."""

    @property
    def drop_momentum(self) -> float:
        """Mass times terminal speed 9.65 - 10.3 exp(-0.6 D) (Atlas et al. 1973), kg m/s."""
        mass = WATER * math.pi / 6.0 * (1e-3 * self.drop) ** 3
        return mass * max(9.65 - 10.3 * math.exp(-0.6 * self.drop), 0.0)

    @property
    def drops_per_area(self) -> float:
        """Per m^2 and second."""
        return self.rate / 3.6e6 / (math.pi / 6.0 * (1e-3 * self.drop) ** 3)

    def acts(self, start: float, stop: float, shape: tuple[int, int], area: float) -> Sequence[Act]:
        """The drops that fall in the step, those of a tick evenly over it; see ``Agent``."""
        begin, end = max(start, self.start), min(stop, self.end)
        if begin >= end:
            return ()
        pressure = np.zeros(shape, np.float32)
        for tick in range(math.floor(begin / RAIN_TICK + 1e-6), math.ceil(end / RAIN_TICK - 1e-6)):
            within = min(end, (tick + 1) * RAIN_TICK) - max(begin, tick * RAIN_TICK)
            pressure += np.float32(within / (stop - start)) * _drops(self, tick, shape, area)
        return (Shower(pressure),)


@lru_cache(maxsize=4)
def _drops(rain: Rain, tick: int, shape: tuple[int, int], area: float) -> NDArray[np.float32]:
    """(nx, ny) mean pressure of a tick's drops, whose number in a column is Poisson's, N/m^2."""
    rng = np.random.default_rng([rain.seed, tick + (1 << 31), 0x4A17])
    count = rng.poisson(rain.drops_per_area * area * RAIN_TICK, shape)
    return (count * (rain.drop_momentum / (area * RAIN_TICK))).astype(np.float32)
