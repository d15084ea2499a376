"""The turtle's frame: heading, left and up, unit vectors square to each other, up = heading x left.

It starts heading +Z with left -X, so up -Y: the turtle of The Algorithmic Beauty of Plants (heading +Y, left -X, up
towards the viewer) stood upright in our axes. Angles are radians; every turn keeps the frame square.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

Vector = tuple[float, float, float]

UPRIGHT: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Frame:
    """Three unit vectors."""

    heading: Vector
    left: Vector
    up: Vector

    def yawed(self, angle: float) -> Frame:
        """Turned to the left (+)."""
        heading, left = turned(self.heading, self.left, angle)
        return Frame(heading, left, self.up)

    def pitched(self, angle: float) -> Frame:
        """Turned down (&)."""
        up, heading = turned(self.up, self.heading, angle)
        return Frame(heading, self.left, up)

    def rolled(self, angle: float) -> Frame:
        """Rolled so that the left side goes down (backslash)."""
        up, left = turned(self.up, self.left, angle)
        return Frame(self.heading, left, up)

    def levelled(self) -> Frame:
        """Rolled until left is horizontal and up points upwards ($); a vertical heading stays as it is."""
        across = cross(UPRIGHT, self.heading)
        size = math.sqrt(dot(across, across))
        if size < 1e-6:
            return self
        left = scaled(across, 1.0 / size)
        return Frame(self.heading, left, cross(self.heading, left))

    def bent(self, tropism: Vector, elasticity: float) -> Frame:
        """Turned towards a direction by e |H x T| radians (The Algorithmic Beauty of Plants, p. 58)."""
        axis = cross(self.heading, tropism)
        torque = math.sqrt(dot(axis, axis))
        if torque < 1e-12:
            return self
        axis, angle = scaled(axis, 1.0 / torque), elasticity * torque
        heading = unit(about(self.heading, axis, angle))
        left = about(self.left, axis, angle)
        left = unit(added(left, heading, -dot(left, heading)))
        return Frame(heading, left, cross(heading, left))


START = Frame(heading=UPRIGHT, left=(-1.0, 0.0, 0.0), up=(0.0, -1.0, 0.0))
"""How the turtle stands at the root."""


def turned(first: Vector, second: Vector, angle: float) -> tuple[Vector, Vector]:
    """Two square unit vectors turned in their plane, the first towards the second."""
    cosine, sine = math.cos(angle), math.sin(angle)
    (a, b, c), (x, y, z) = first, second
    return (
        (cosine * a + sine * x, cosine * b + sine * y, cosine * c + sine * z),
        (cosine * x - sine * a, cosine * y - sine * b, cosine * z - sine * c),
    )


def about(vector: Vector, axis: Vector, angle: float) -> Vector:
    """A vector turned about a unit axis (Rodrigues)."""
    cosine, sine = math.cos(angle), math.sin(angle)
    side, along = cross(axis, vector), dot(axis, vector) * (1.0 - cosine)
    return added(added(scaled(vector, cosine), side, sine), axis, along)


def dot(a: Vector, b: Vector) -> float:
    """A . b"""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """A x b"""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def scaled(a: Vector, factor: float) -> Vector:
    """Factor a"""
    return (factor * a[0], factor * a[1], factor * a[2])


def added(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    """A + factor b"""
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


def unit(a: Vector) -> Vector:
    """A over its length."""
    return scaled(a, 1.0 / math.sqrt(dot(a, a)))
