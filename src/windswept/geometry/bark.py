"""The bark deformer: Skjermo's surface round posed Bezier pieces, as ``gpu/shaders/bark.wgsl`` evaluates it.

With unit handles S_i, T_i at the first level of the generalized de Casteljau algorithm (Chang and Rockwood 1994)
and none below, the deformation has the closed form F(t, v, w) = C(t) + v S(t) + w T(t) with C the cubic and
S, T the quadratic Bezier curves of the handles. So its Jacobian is exact: dF/dt = C' + v S' + w T',
dF/dv = S, dF/dw = T. S(t) shortens where a piece bends: to 0.933 within a piece that turns by 60 degrees.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.geometry.geometry import Geometry, PosedCurves
from windswept.plants.plant import Ints
from windswept.plants.radius import bulge_factor, flare_factor, lobe_factor, taper_radius

Doubles = NDArray[np.float64]

SLOPE_STEP = 1e-5
"""Half the step of the central difference that gives a profile's slope, as a share of the stem's length."""


@dataclass(frozen=True, slots=True)
class Surface:
    """Points on bark."""

    position: Doubles
    """(n, 3) m."""
    tangent_along: Doubles
    """(n, 3) dF/dt at fixed angle, m."""
    tangent_round: Doubles
    """(n, 3) dF/dangle, m/rad."""

    @property
    def normal(self) -> Doubles:
        """(n, 3) unit normal out of the stem."""
        normal = np.cross(self.tangent_round, self.tangent_along)
        return normal / np.linalg.norm(normal, axis=1, keepdims=True)


@dataclass(frozen=True, slots=True)
class Deformer:
    """Curves of n points' pieces at their parameters."""

    curve: Doubles
    """(n, 3) C(t), m."""
    curve_slope: Doubles
    """(n, 3) C'(t), m."""
    handles: Doubles
    """(2, n, 3) S(t) and T(t)."""
    handle_slopes: Doubles
    """(2, n, 3) S'(t) and T'(t)."""


def bark_surface(
    geometry: Geometry, curves: PosedCurves, placement: int, piece: Ints, t: Doubles, angle: Doubles
) -> Surface:
    """Bark at parameters (t, angle) of pieces.

    Args:
        geometry: what was fitted.
        curves: where it is now.
        placement: which of the placements.
        piece: (n,) pieces.
        t: (n,) 0..1 along each piece.
        angle: (n,) round it, rad; 0 is the direction of T, pi/2 that of S.
    """
    frame = deformer(curves.points[placement, piece], curves.sides[placement, piece], t)
    radius, slope = _profile(geometry, piece, t)
    stem = geometry.piece_stem[piece]
    lobes, depth = geometry.stem_lobes[stem], geometry.stem_lobe_depth[stem]
    lobe = lobe_factor(lobes, depth, angle)
    lobe_slope = depth * lobes * np.cos(lobes * angle)

    round_s, round_t = np.sin(angle)[:, None], np.cos(angle)[:, None]
    outwards = round_s * frame.handles[0] + round_t * frame.handles[1]
    sideways = round_t * frame.handles[0] - round_s * frame.handles[1]
    turning = round_s * frame.handle_slopes[0] + round_t * frame.handle_slopes[1]
    width = (radius * lobe)[:, None]
    return Surface(
        frame.curve + width * outwards,
        frame.curve_slope + width * turning + (slope * lobe)[:, None] * outwards,
        width * sideways + (radius * lobe_slope)[:, None] * outwards,
    )


def deformer(points: Doubles, sides: Doubles, t: Doubles) -> Deformer:
    """C, S and T of n pieces with control points (n, 4, 3) and handles (n, 3, 3) at parameters t (n,)."""
    points, sides = points.astype(np.float64), sides.astype(np.float64)
    legs = np.diff(points, axis=1)
    tops = np.cross(sides, legs / np.linalg.norm(legs, axis=2, keepdims=True))
    handles = np.stack([sides, tops])
    s = 1.0 - t
    cubic = np.stack([s**3, 3 * s * s * t, 3 * s * t * t, t**3], axis=1)
    square = np.stack([s * s, 2 * s * t, t * t], axis=1)
    square_slope = np.stack([-2 * s, 2 * s - 2 * t, 2 * t], axis=1)
    return Deformer(
        np.einsum("ni,nik->nk", cubic, points),
        3.0 * np.einsum("ni,nik->nk", square, legs),
        np.einsum("ni,hnik->hnk", square, handles),
        np.einsum("ni,hnik->hnk", square_slope, handles),
    )


def stem_radius(geometry: Geometry, stem: Ints, span: Doubles) -> Doubles:
    """(n,) radius without lobes at shares of the length of stems, m."""
    start, end = geometry.stem_taper_span[stem].T.astype(np.float64)
    z = start + span * (end - start)
    taper = taper_radius(
        geometry.stem_radius[stem], geometry.stem_taper[stem], z, geometry.stem_taper_length[stem]
    )
    bulge = bulge_factor(geometry.bulges, geometry.bulge_depth, z)
    return taper * flare_factor(geometry.stem_flare[stem], z) * bulge


def _profile(geometry: Geometry, piece: Ints, t: Doubles) -> tuple[Doubles, Doubles]:
    """(n,) radius without lobes, m, and its slope over t."""
    stem = geometry.piece_stem[piece]
    start, end = geometry.piece_span[piece].T.astype(np.float64)
    span = start + t * (end - start)
    before, after = np.maximum(span - SLOPE_STEP, 0.0), np.minimum(span + SLOPE_STEP, 1.0)
    rise = stem_radius(geometry, stem, after) - stem_radius(geometry, stem, before)
    return stem_radius(geometry, stem, span), rise / (after - before) * (end - start)
