"""What is drawn of a plant: Bezier pieces carried by links, and leaves. Knows nothing of motion or its levels."""

from __future__ import annotations

from dataclasses import dataclass

from windswept.plants.plant import Floats, Ints


@dataclass(frozen=True, slots=True)
class Geometry:
    """The drawn form of one plant with S stems, L links, Q pieces, N leaves, at rest, in the plant's frame.

    A stem's curve is a chain of cubic Bezier pieces. Where two pieces meet stands a *station*: the points
    P2, P3 of the one and P0, P1 of the next are collinear and carried by the same link, so that the curve
    stays smooth however the links move. A station also carries a side vector, so that the frame round the
    curve is continuous too.
    """

    stem_piece_start: Ints
    """(S+1,) pieces of stem s are ``stem_piece_start[s]:stem_piece_start[s+1]``, base to tip; at least one."""
    stem_parent: Ints
    """(S,) parent stem, -1 for a trunk."""
    stem_depth: Ints
    """(S,) 0 for a trunk, parent's depth + 1 otherwise (a clone counts as a child)."""
    stem_attach_piece: Ints
    """(S,) piece of the parent stem that the stem grows out of; -1 for a trunk."""
    stem_attach_t: Floats
    """(S,) parameter on that piece at which it grows out."""
    stem_link: Ints
    """(S,) first link of the stem, whose base is the point that is shifted onto the parent's curve."""
    stem_parent_link: Ints
    """(S,) link that carries the stem's base; -1 for a trunk."""
    stem_reach: Floats
    """(S,) length of the stem along its curve, m: what geometric detail is chosen by, with the radius."""

    piece_stem: Ints
    """(Q,) stem of each piece."""
    piece_link: Ints
    """(Q, 2) links that carry its start (P0, P1) and its end (P2, P3)."""
    piece_points: Floats
    """(Q, 4, 3) control points at rest, m, before the stem's shift onto its parent's drawn curve."""
    piece_side: Floats
    """(Q, 2, 3) unit side vectors at its start and end, perpendicular to the curve, at rest."""
    piece_span: Floats
    """(Q, 2) fraction of the stem's length at its start and end: where radius functions are evaluated."""

    stem_radius: Floats
    """(S,) radius at Z = 0 before flare and lobes, m."""
    stem_taper: Floats
    """(S,) Weber-Penn nTaper."""
    stem_flare: Floats
    """(S,) Weber-Penn Flare."""
    stem_lobes: Floats
    """(S,) number of lobes."""
    stem_lobe_depth: Floats
    """(S,) depth of lobes over radius."""
    bulges: int
    """Swellings along every stem."""
    bulge_depth: float
    """Their depth over the radius."""
    stem_taper_span: Floats
    """(S, 2) Z of the taper at the stem's own base and tip: (0, 1) but for clones."""
    stem_taper_length: Floats
    """(S,) length over which Z runs from 0 to 1, m (periodic tapers need it)."""

    leaf_link: Ints
    """(N,) link that carries each leaf."""
    leaf_stem: Ints
    """(N,) stem of that link: the leaf shifts with it."""
    leaf_rank: Ints
    """(N,) a seeded shuffle of 0..N-1: geometric detail draws the ranks below a number, with their area kept."""
    leaf_position: Floats
    """(N, 3) attachment at rest, m, on the link's axis, before the stem's shift."""
    leaf_axis: Floats
    """(N, 3) unit direction to the leaf's tip."""
    leaf_normal: Floats
    """(N, 3) unit normal of the upper face."""
    leaf_size: Floats
    """(N, 2) length and width, m."""

    piece_openness: Floats
    """(Q, 2) share of the sky seen through the crown at each piece's start and end, 0..1."""
    leaf_openness: Floats
    """(N,) share of the sky that each leaf sees through the rest of the crown, 0..1."""
    leaf_outward: Floats
    """(N, 3) unit direction in which the crown thins out: shades the crown as a volume."""

    @property
    def stem_count(self) -> int:
        """Number of stems, S."""
        return len(self.stem_parent)

    @property
    def piece_count(self) -> int:
        """Number of pieces, Q."""
        return len(self.piece_stem)

    @property
    def leaf_count(self) -> int:
        """Number of leaves, N."""
        return len(self.leaf_link)


@dataclass(frozen=True, slots=True)
class PosedCurves:
    """Where the curves of P placements of one plant are now, each in the plant's own frame."""

    points: Floats
    """(P, Q, 4, 3) control points, m."""
    sides: Floats
    """(P, Q, 3, 3) the handles S0, S1, S2 of every piece; T_i = S_i x L_i."""
    shift: Floats
    """(P, S, 3) how far each stem was moved so that it grows out of its parent's drawn curve, m."""
