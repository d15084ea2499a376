"""From the vertices of a polygon to a leaf of the same area."""

from __future__ import annotations

import math

from windswept.plants.lsystem.frame import Vector, added, cross, dot, scaled, unit
from windswept.plants.lsystem.sketch import Seat, SketchLeaf
from windswept.plants.plant import LEAF_FILL

LEAST_AREA = 1e-12
"""Polygons of less area over their squared extent are lines."""


def polygon_leaf(base: Vector, vertices: list[Vector], up: Vector, seat: Seat | None) -> SketchLeaf | None:
    """A leaf that reaches from the base to the farthest vertex and has the polygon's area; None for a line.

    Args:
        base: where it is attached.
        vertices: of the polygon, in order.
        up: the turtle's up; the leaf's upper face is on its side.
        seat: node that carries it.
    """
    if len(vertices) < 3:
        return None
    reach = max((added(vertex, base, -1.0) for vertex in vertices), key=lambda vector: dot(vector, vector))
    length = math.sqrt(dot(reach, reach))
    twice: Vector = (0.0, 0.0, 0.0)
    for one, other in zip(vertices, vertices[1:] + vertices[:1], strict=True):
        twice = added(twice, cross(added(one, base, -1.0), added(other, base, -1.0)))
    area = 0.5 * math.sqrt(dot(twice, twice))
    if length <= 0.0 or area <= LEAST_AREA * length**2:
        return None
    axis = scaled(reach, 1.0 / length)
    normal = added(twice, axis, -dot(twice, axis))
    if dot(normal, normal) <= LEAST_AREA * dot(twice, twice):
        return None
    normal = unit(normal)
    if dot(normal, up) < 0.0:
        normal = scaled(normal, -1.0)
    return SketchLeaf(seat, axis, normal, length, area / (LEAF_FILL * length))
