"""Path: where something that moves over the ground is at a time."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError

Reals = NDArray[np.float64]


@dataclass(frozen=True)
class Path:
    """A polyline over the ground, run through at given times; before the first and after the last, nowhere."""

    times: Reals
    """(N,) growing, s."""
    places: Reals
    """(N, 2) x and y, m."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "times", np.atleast_1d(np.asarray(self.times, np.float64)))
        object.__setattr__(self, "places", np.atleast_2d(np.asarray(self.places, np.float64)))
        self.validate()

    def validate(self) -> None:
        """Raise InputError for times that do not grow or arrays that do not match."""
        count = len(self.times)
        if count < 2 or not (np.diff(self.times) > 0.0).all():
            raise InputError("path", "times", self.times.tolist(), "two growing times or more")
        if self.places.shape != (count, 2):
            raise InputError("path", "places", self.places.shape, f"shape ({count}, 2)")

    def covers(self, time: float) -> bool:
        """Whether there is something on the path at a time."""
        return bool(self.times[0] <= time <= self.times[-1])

    @cached_property
    def lengths(self) -> Reals:
        """(N,) way gone at each of the times, m."""
        steps = np.linalg.norm(np.diff(self.places, axis=0), axis=1)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def place(self, time: float) -> tuple[float, float]:
        """Place at a time, x and y, that of the nearer end outside its time, m."""
        x, y = (float(np.interp(time, self.times, self.places[:, axis])) for axis in (0, 1))
        return x, y

    def length(self, time: float) -> float:
        """Way gone at a time, m."""
        return float(np.interp(time, self.times, self.lengths))

    def place_after(self, length: float) -> tuple[float, float]:
        """Place after some way, x and y, m."""
        x, y = (float(np.interp(length, self.lengths, self.places[:, axis])) for axis in (0, 1))
        return x, y

    def velocity(self, start: float, stop: float) -> tuple[float, float]:
        """Mean velocity between two times, m/s."""
        (x0, y0), (x1, y1) = self.place(start), self.place(stop)
        return (x1 - x0) / (stop - start), (y1 - y0) / (stop - start)
