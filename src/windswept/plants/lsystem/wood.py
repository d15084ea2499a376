"""Radii of stems: as the grammar sets them, or from the pipe model."""

from __future__ import annotations

import math

from windswept.plants.lsystem.sketch import Sketch

THINNEST = 3e-4
"""No wood is thinner than this radius, m."""


def node_radii(sketch: Sketch, tip_radius: float) -> list[list[float]]:
    """Radius of every stem at each of its nodes, m.

    Where the grammar sets a width, wood after a node has half of it. Where it sets none for the whole plant,
    Leonardo's rule holds: the cross-section of a stem is the sum of those that grow out of it, and the last
    twigs have the tip radius.

    Args:
        sketch: tidied, in metres.
        tip_radius: m.
    """
    if any(width is not None for stem in sketch.stems for width in stem.width):
        return [_given(stem.width, tip_radius) for stem in sketch.stems]
    return _piped(sketch, tip_radius)


def _given(width: list[float | None], tip_radius: float) -> list[float]:
    """Half the widths; the tip keeps that of the last link."""
    radii = [tip_radius if value is None else 0.5 * value for value in width]
    return [max(radius, THINNEST) for radius in (*radii, radii[-1])]


def _piped(sketch: Sketch, tip_radius: float) -> list[list[float]]:
    """Radii by the number of twig tips beyond each node; stems come before what grows out of them."""
    tips = [[0] * len(stem.nodes) for stem in sketch.stems]
    for number in range(len(sketch.stems) - 1, -1, -1):
        own, stem = tips[number], sketch.stems[number]
        own[-1] = max(own[-1], 1)
        for node in range(len(own) - 2, -1, -1):
            own[node] += own[node + 1]
        if stem.seat is not None:
            tips[stem.seat[0]][stem.seat[1]] += own[0]
    return [[tip_radius * math.sqrt(count) for count in own] for own in tips]
