"""tidy: stems with nodes no closer and no farther apart than mechanics wants them."""

from __future__ import annotations

import math
from itertools import pairwise

from windswept.plants.lsystem.frame import Vector, added, dot
from windswept.plants.lsystem.sketch import Seat, Sketch, SketchLeaf, SketchStem

SHORTEST_LINK = 1e-3
"""Shorter links are merged with their neighbours, m."""
STRAIGHT = math.cos(math.radians(3.0))
"""Links that turn by less, with nothing growing out between them, are merged."""
LEAST_LINKS = (8, 4)
"""Merging leaves so many links, and long links are divided to make so many, on trunks and on their branches."""


def tidy(sketch: Sketch, scale: float) -> Sketch:
    """The same plant in metres, short and straight links merged, trunks divided.

    What grows on a node that goes moves to the node that stands for it. Stems shorter than the shortest link
    vanish and leave what they carry to their parent.

    Args:
        sketch: what the turtle wrote.
        scale: metres per unit.
    """
    held: list[set[int]] = [set() for _ in sketch.stems]
    for seat in [stem.seat for stem in sketch.stems] + [leaf.seat for leaf in sketch.leaves]:
        if seat is not None:
            held[seat[0]].add(seat[1])
    result = Sketch()
    places: list[list[Seat | None]] = []
    for stem, kept in zip(sketch.stems, held, strict=True):
        seat = None if stem.seat is None else places[stem.seat[0]][stem.seat[1]]
        places.append(_tidied(stem, seat, kept, scale, result))
    for leaf in sketch.leaves:
        seat = None if leaf.seat is None else places[leaf.seat[0]][leaf.seat[1]]
        factor = 1.0 if leaf.in_metres else scale
        size = (leaf.length * factor, leaf.width * factor)
        result.leaves.append(SketchLeaf(seat, leaf.axis, leaf.normal, *size, in_metres=True))
    return result


def _tidied(
    stem: SketchStem, seat: Seat | None, held: set[int], scale: float, result: Sketch
) -> list[Seat | None]:
    """Write one stem; returns where each of its nodes went."""
    nodes: list[Vector] = [(scale * x, scale * y, scale * z) for x, y, z in stem.nodes]
    if seat is not None:
        nodes[0] = result.stems[seat[0]].nodes[seat[1]]
    order = 0 if seat is None else result.stems[seat[0]].order + 1
    long_enough = _without_short(nodes)
    if len(long_enough) < 2:
        return [seat] * len(nodes)
    chosen = _without_straight(nodes, long_enough, stem, held, order)
    parts = _divisions(len(chosen) - 1, order)
    number = len(result.stems)
    line = SketchStem(seat, order, [nodes[chosen[0]]])
    first_part = {chosen[0]: 0}
    for before, node in pairwise(chosen):
        along = added(nodes[node], nodes[before], -1.0)
        for part in range(1, parts):
            line.nodes.append(added(nodes[before], along, part / parts))
        line.nodes.append(nodes[node])
        first_part[node] = len(line.nodes) - 1
        width = stem.width[before]
        line.width.extend([None if width is None else scale * width] * parts)
        line.strength.extend([stem.strength[before]] * parts)
    result.stems.append(line)
    homes: list[Seat | None] = []
    home = 0
    for node in range(len(nodes)):
        home = first_part.get(node, home)
        homes.append((number, home))
    return homes


def _without_short(nodes: list[Vector]) -> list[int]:
    """Nodes that are at least the shortest link from the one before."""
    chosen = [0]
    for node in range(1, len(nodes)):
        gap = added(nodes[node], nodes[chosen[-1]], -1.0)
        if dot(gap, gap) >= SHORTEST_LINK**2:
            chosen.append(node)
    return chosen


def _without_straight(
    nodes: list[Vector], chosen: list[int], stem: SketchStem, held: set[int], order: int
) -> list[int]:
    """Nodes without those at which the stem runs on straight, carries nothing and is no longer than it may be."""
    least = LEAST_LINKS[order] if order < len(LEAST_LINKS) else 1
    total = sum(math.dist(nodes[a], nodes[b]) for a, b in pairwise(chosen))
    result = [chosen[0]]
    for before, node, after in zip(chosen, chosen[1:], chosen[2:], strict=False):
        entry = added(nodes[node], nodes[result[-1]], -1.0)
        leaving = added(nodes[after], nodes[node], -1.0)
        cosine = dot(entry, leaving) / math.sqrt(dot(entry, entry) * dot(leaving, leaving))
        longer = math.dist(nodes[result[-1]], nodes[after])
        same = stem.strength[before] == stem.strength[node]
        free = not any(place in held for place in range(node, after))
        if not (same and free and cosine > STRAIGHT and longer <= total / least * (1 + 1e-9)):
            result.append(node)
    return [*result, chosen[-1]]


def _divisions(links: int, order: int) -> int:
    """Into how many pieces every link of a stem is divided."""
    least = LEAST_LINKS[order] if order < len(LEAST_LINKS) else 1
    return math.ceil(least / links)
