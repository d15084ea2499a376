"""Kernels that fit cubic Bezier pieces to grown stems and carry a frame along them."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Doubles = NDArray[np.float64]
Ints = NDArray[np.int32]

SAMPLES_PER_LINK = 4
"""Points of the grown curve per link at which the fit is judged."""
FRAME_STEPS = 8
"""Double reflections per piece; its error falls with the fourth power of the step."""


@njit(cache=True)
def grown_tangents(nodes: Doubles) -> Doubles:
    """Unit tangents of the smooth curve through the nodes of one stem (Catmull-Rom with chord-length knots).

    Args:
        nodes: (n+1, 3) link ends from base to tip.
    """
    last = len(nodes) - 1
    chords = nodes[1:] - nodes[:-1]
    tangents = np.empty_like(nodes)
    for i in range(1, last):
        before = np.sqrt(np.sum(chords[i - 1] ** 2))
        after = np.sqrt(np.sum(chords[i] ** 2))
        tangents[i] = chords[i - 1] * (after / before) + chords[i] * (before / after)
        tangents[i] /= np.sqrt(np.sum(tangents[i] ** 2))
    unit_first = chords[0] / np.sqrt(np.sum(chords[0] ** 2))
    unit_last = chords[last - 1] / np.sqrt(np.sum(chords[last - 1] ** 2))
    if last == 1:
        tangents[0] = unit_first
        tangents[1] = unit_last
        return tangents
    # At the ends the tangent of the circular arc through the last two nodes.
    tangents[0] = 2.0 * np.sum(unit_first * tangents[1]) * unit_first - tangents[1]
    tangents[last] = 2.0 * np.sum(unit_last * tangents[last - 1]) * unit_last - tangents[last - 1]
    return tangents


@njit(cache=True)
def sample_grown(
    nodes: Doubles, tangents: Doubles, first: int, end: int, points: Doubles, knots: Doubles
) -> int:
    """Points of the grown curve from node ``first`` to node ``end`` with chord-length parameters in 0..1.

    Args:
        nodes: (n+1, 3) link ends.
        tangents: (n+1, 3) unit tangents there.
        first: node at which the samples start.
        end: node at which they end.
        points: (m, 3) out, m at least ``SAMPLES_PER_LINK * (end - first) + 1``.
        knots: (m,) out.

    Returns:
        How many samples were written.
    """
    count = 0
    travelled = 0.0
    for link in range(first, end):
        length = np.sqrt(np.sum((nodes[link + 1] - nodes[link]) ** 2))
        for k in range(SAMPLES_PER_LINK):
            u = k / SAMPLES_PER_LINK
            start = (1.0 + 2.0 * u) * (1.0 - u) ** 2
            finish = u * u * (3.0 - 2.0 * u)
            points[count] = start * nodes[link] + finish * nodes[link + 1]
            points[count] += length * u * (1.0 - u) * ((1.0 - u) * tangents[link] - u * tangents[link + 1])
            knots[count] = travelled + u * length
            count += 1
        travelled += length
    points[count] = nodes[end]
    knots[count] = travelled
    count += 1
    knots[:count] /= travelled
    return count


@njit(cache=True)
def fit_piece(
    points: Doubles,
    knots: Doubles,
    count: int,
    start_tangent: Doubles,
    end_tangent: Doubles,
    piece: Doubles,
) -> float:
    """Least-squares handle lengths of a cubic with given ends and end tangents (Schneider, Graphics Gems 1990).

    Args:
        points: (m, 3) points to meet; the first and the last are met exactly.
        knots: (m,) parameter of each in 0..1.
        count: how many of them to use.
        start_tangent: (3,) unit tangent at the start.
        end_tangent: (3,) unit tangent at the end.
        piece: (4, 3) out, control points.

    Returns:
        The largest distance from a point to the cubic at its parameter, an upper bound of the true distance.
    """
    first, last = points[0], points[count - 1]
    a11, a12, a22, r1, r2 = 0.0, 0.0, 0.0, 0.0, 0.0
    cosine = -np.sum(start_tangent * end_tangent)
    for i in range(1, count - 1):
        t = knots[i]
        b1, b2 = 3.0 * t * (1.0 - t) ** 2, 3.0 * t * t * (1.0 - t)
        rest = points[i] - first * ((1.0 - t) ** 3 + b1) - last * (t**3 + b2)
        a11 += b1 * b1
        a12 += b1 * b2 * cosine
        a22 += b2 * b2
        r1 += b1 * np.sum(rest * start_tangent)
        r2 -= b2 * np.sum(rest * end_tangent)
    third = np.sqrt(np.sum((last - first) ** 2)) / 3.0
    determinant = a11 * a22 - a12 * a12
    start_handle, end_handle = third, third
    if determinant > 1e-6 * a11 * a22:
        start_handle = (r1 * a22 - r2 * a12) / determinant
        end_handle = (a11 * r2 - a12 * r1) / determinant
    if start_handle < 0.2 * third or end_handle < 0.2 * third:
        start_handle, end_handle = third, third
    piece[0], piece[3] = first, last
    piece[1] = first + start_handle * start_tangent
    piece[2] = last - end_handle * end_tangent
    worst = 0.0
    for i in range(1, count - 1):
        t = knots[i]
        s = 1.0 - t
        gap = s**3 * piece[0] + 3.0 * s * s * t * piece[1] + 3.0 * s * t * t * piece[2] + t**3 * piece[3]
        worst = max(worst, np.sum((gap - points[i]) ** 2))
    return np.sqrt(worst)


@njit(cache=True)
def fit_stem(nodes: Doubles, tolerance: float, pieces: Doubles, ends: Ints) -> int:
    """Chain of as few pieces as a greedy search from the base finds, each within ``tolerance`` of the stem.

    Args:
        nodes: (n+1, 3) link ends.
        tolerance: largest distance, m.
        pieces: (n, 4, 3) out, control points.
        ends: (n,) out, node at which each piece ends.

    Returns:
        How many pieces were written.
    """
    last = len(nodes) - 1
    tangents = grown_tangents(nodes)
    points = np.empty((SAMPLES_PER_LINK * last + 1, 3))
    knots = np.empty(SAMPLES_PER_LINK * last + 1)
    count, first = 0, 0
    while first < last:
        fits, misses, attempt = first + 1, last + 1, last
        while True:
            samples = sample_grown(nodes, tangents, first, attempt, points, knots)
            gap = fit_piece(points, knots, samples, tangents[first], tangents[attempt], pieces[count])
            if gap <= tolerance:
                fits = attempt
            else:
                misses = attempt
            if misses - fits <= 1:
                break
            attempt = (fits + misses) // 2
        samples = sample_grown(nodes, tangents, first, fits, points, knots)
        fit_piece(points, knots, samples, tangents[first], tangents[fits], pieces[count])
        ends[count] = fits
        count += 1
        first = fits
    return count


@njit(cache=True)
def transport(piece: Doubles, side: Doubles) -> Doubles:
    """Carry a side vector along a piece by double reflection (Wang et al. 2008).

    Args:
        piece: (4, 3) control points.
        side: (3,) unit vector perpendicular to the curve's start.

    Returns:
        (3,) unit vector perpendicular to the curve's end, twisted as little as the curve allows.
    """
    point, tangent = piece[0].copy(), piece[1] - piece[0]
    tangent /= np.sqrt(np.sum(tangent**2))
    for step in range(1, FRAME_STEPS + 1):
        t = step / FRAME_STEPS
        s = 1.0 - t
        ahead = s**3 * piece[0] + 3.0 * s * s * t * piece[1] + 3.0 * s * t * t * piece[2] + t**3 * piece[3]
        heading = (
            s * s * (piece[1] - piece[0])
            + 2.0 * s * t * (piece[2] - piece[1])
            + t * t * (piece[3] - piece[2])
        )
        heading /= np.sqrt(np.sum(heading**2))
        mirror = ahead - point
        square = np.sum(mirror**2)
        side = side - (2.0 / square) * np.sum(mirror * side) * mirror
        tangent = tangent - (2.0 / square) * np.sum(mirror * tangent) * mirror
        mirror = heading - tangent
        square = np.sum(mirror**2)
        if square > 1e-20:
            side = side - (2.0 / square) * np.sum(mirror * side) * mirror
        point, tangent = ahead, heading
    side = side - np.sum(side * tangent) * tangent
    return side / np.sqrt(np.sum(side**2))


@njit(cache=True)
def start_side(heading: Doubles, reference: Doubles) -> Doubles:
    """Skjermo's S0 = L0 x O, normalised; any perpendicular where the two are parallel (PHYSICS C1.2)."""
    side = np.cross(heading, reference)
    if np.sum(side**2) < 1e-6:
        side = np.cross(heading, np.array([0.0, 1.0, 0.0]))
        if np.sum(side**2) < 1e-2:
            side = np.cross(heading, np.array([1.0, 0.0, 0.0]))
    return side / np.sqrt(np.sum(side**2))


@njit(cache=True)
def fit_stems(
    nodes: Doubles,
    node_start: Ints,
    tolerance: Doubles,
    reference: Doubles,
    pieces: Doubles,
    sides: Doubles,
    ends: Ints,
    counts: Ints,
) -> None:
    """Fit every stem; piece k of stem s is written to row ``node_start[s] - s + k``.

    Args:
        nodes: (L+S, 3) link ends of all stems.
        node_start: (S+1,) rows of ``nodes`` that belong to each stem.
        tolerance: (S,) largest distance, m.
        reference: (S, 3) O of each stem: unit direction of the parent where the stem grows out.
        pieces: (L, 4, 3) out.
        sides: (L, 2, 3) out, unit side vectors at both ends of each piece.
        ends: (L,) out, node of the stem at which each piece ends.
        counts: (S,) out, pieces of each stem.
    """
    for stem in range(len(counts)):
        row = node_start[stem] - stem
        own = nodes[node_start[stem] : node_start[stem + 1]]
        room = row + len(own) - 1
        count = fit_stem(own, tolerance[stem], pieces[row:room], ends[row:room])
        counts[stem] = count
        heading = pieces[row, 1] - pieces[row, 0]
        side = start_side(heading / np.sqrt(np.sum(heading**2)), reference[stem])
        for k in range(row, row + count):
            sides[k, 0] = side
            side = transport(pieces[k], side)
            sides[k, 1] = side
