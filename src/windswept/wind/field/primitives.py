"""Flow primitives of Wejchert and Haumann (1991), with cores (PHYSICS B7)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]


@dataclass(frozen=True)
class Uniform:
    """The same velocity everywhere."""

    velocity: tuple[float, float, float]
    """m/s."""
    start: float = -math.inf
    """s; the air inside the field is reached from its border, with the flow."""
    end: float = math.inf
    """s."""


@dataclass(frozen=True)
class Line:
    """A source, sink or vortex along an endless straight line, which may move.

    V = (a q + b (axis x q)) / (2 pi (r^2 + core^2)), with q the offset from the line and r its length.
    """

    position: tuple[float, float, float]
    """A point of the line at time 0: x, y and height above ground, m."""
    source: float = 0.0
    """a: volume blown out per metre of line, below 0 for a sink, m^2/s."""
    vortex: float = 0.0
    """b: circulation, counter-clockwise about the axis, m^2/s."""
    core: float = 1.0
    """Radius inside which the flow is tamed, m."""
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    """Direction of the line; any length but 0."""
    drift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Velocity of the line, m/s."""
    start: float = -math.inf
    """s; the air inside the field is reached from its border, with the flow."""
    end: float = math.inf
    """s."""


Primitive = Uniform | Line

LINE_COLUMNS = ("x", "y", "z", "axis_x", "axis_y", "axis_z", "source", "vortex", "core_squared")


def running(primitives: Sequence[Primitive], time: float) -> frozenset[int]:
    """Which of some primitives blow at a time."""
    return frozenset(i for i, one in enumerate(primitives) if one.start <= time < one.end)


def uniform_velocity(primitives: Sequence[Primitive]) -> Reals:
    """(3,) sum of the uniform ones, m/s."""
    parts = [one.velocity for one in primitives if isinstance(one, Uniform)]
    return np.sum(np.array(parts, np.float64).reshape(-1, 3), axis=0)


def line_rows(primitives: Sequence[Primitive], time: float) -> NDArray[np.float32]:
    """(R, 9) the lines at a time as the kernel reads them, LINE_COLUMNS; strengths over 2 pi, unit axes."""
    rows = []
    for one in primitives:
        if isinstance(one, Line):
            place = np.array(one.position) + time * np.array(one.drift)
            axis = np.array(one.axis) / np.linalg.norm(one.axis)
            strength = np.array([one.source, one.vortex]) / (2.0 * math.pi)
            rows.append([*place, *axis, *strength, one.core**2])
    return np.array(rows, np.float32).reshape(-1, len(LINE_COLUMNS))


def primitive_velocity(primitives: Sequence[Primitive], points: Reals, time: float) -> Reals:
    """Velocity of all that blow at a time, superposed: the plain formula that the kernel implements.

    Args:
        primitives: any number.
        points: (N, 3) x, y and height above ground, m.
        time: s.

    Returns:
        (N, 3) m/s.
    """
    blowing = [primitives[i] for i in sorted(running(primitives, time))]
    total = np.tile(uniform_velocity(blowing), (len(points), 1))
    for row in line_rows(blowing, time).astype(np.float64):
        place, axis, (source, vortex, core_squared) = row[:3], row[3:6], row[6:]
        offset = points - place
        offset -= (offset @ axis)[:, None] * axis
        turned = source * offset + vortex * np.cross(axis, offset)
        total += turned / (np.sum(offset**2, axis=1) + core_squared)[:, None]
    return total
