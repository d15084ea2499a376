"""What a plant is: the rest skeleton that growth writes and that motion and geometry read."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Ints = NDArray[np.int32]


@dataclass(frozen=True, slots=True)
class Material:
    """What the wood and the leaves of a species are made of, in SI units."""

    youngs_modulus: float = 9.5e9
    """Bending modulus of green wood, Pa."""
    wood_density: float = 800.0
    """Green wood, kg/m^3."""
    damping_ratio: float = 0.05
    """Structural damping of a stem as a fraction of critical, without the air."""
    leaf_mass: float = 0.20
    """Fresh leaf mass per leaf area, kg/m^2."""
    leaf_drag: float = 1.0
    """Drag coefficient of a leaf held square to the wind, at low speed."""
    wood_drag: float = 1.0
    """Drag coefficient of a bare stem across the wind."""
    reconfiguration: float = -0.7
    """Exponent V: leaf drag grows as speed^(2+V) once leaves fold (Vogel)."""
    reconfiguration_speed: float = 4.0
    """Wind speed at which leaves begin to fold, m/s."""


@dataclass(frozen=True, slots=True)
class Look:
    """Colours and shapes for pictures; colours are linear RGB in 0..1."""

    bark_colour: tuple[float, float, float] = (0.22, 0.17, 0.12)
    bark_relief: float = 0.5
    """Depth of the bark's normal detail, 0 smooth to 1 deeply furrowed."""
    bark_bulges: int = 0
    """Swellings along a stem (Skjermo's b_n); the drawn mesh resolves a few to each piece of its curve."""
    bark_bulge_depth: float = 0.0
    """Their depth as a fraction of the radius (Skjermo's b_d)."""
    leaf_colour: tuple[float, float, float] = (0.10, 0.22, 0.04)
    leaf_back_colour: tuple[float, float, float] = (0.16, 0.28, 0.10)
    leaf_shape: str = "oval"
    """One of "oval", "round", "lance", "lobed", "needle"."""
    leaf_flutter: float = 0.5
    """How readily a leaf trembles, 0 stiff (holly) to 1 aspen."""


@dataclass(frozen=True, slots=True)
class Plant:
    """Rest skeleton of one plant: S stems, L links, N leaves. Frame: +Z up, root at the origin, metres.

    Order. Stems are in preorder: a stem comes before its child stems, and the child stems of a stem are
    ordered from its tip to its base. The links of a stem are contiguous, base to tip. So the links are in
    depth-first order, a parent is always smaller than its child, and the subtree of every link is one range.

    A *stem* is one axis from base to tip. A Weber-Penn clone (split) is a stem of its own that has the same
    order as its parent. A *link* is a straight rigid piece of a stem with its joint at its base.
    """

    species: str
    seed: int
    material: Material
    look: Look

    stem_parent: Ints
    """(S,) parent stem, -1 for a trunk."""
    stem_order: Ints
    """(S,) branching order, 0 for a trunk (Weber and Penn's level)."""
    stem_link_start: Ints
    """(S+1,) links of stem s are ``stem_link_start[s]:stem_link_start[s+1]``; every stem has at least one."""
    stem_radius: Floats
    """(S,) base radius of the whole stem before flare and lobes, m; a clone has that of the stem it continues."""
    stem_taper: Floats
    """(S,) Weber-Penn nTaper, 0..3."""
    stem_flare: Floats
    """(S,) Weber-Penn Flare; 0 for all but trunks."""
    stem_lobes: Floats
    """(S,) number of lobes round the stem."""
    stem_lobe_depth: Floats
    """(S,) depth of the lobes as a fraction of the radius."""
    stem_full_length: Floats
    """(S,) length over which taper runs from Z=0 to Z=1, m; longer than the stem's own links for a clone."""
    stem_taper_start: Floats
    """(S,) Z at which the stem begins on its taper: 0, or where a clone leaves the stem it continues."""

    link_parent: Ints
    """(L,) parent link, -1 at a root."""
    link_stem: Ints
    """(L,) stem of each link."""
    link_base: Floats
    """(L, 3) joint at the link's base; lies on the parent link's axis, m."""
    link_tip: Floats
    """(L, 3) far end of the link, m; equals the base of the stem's next link."""
    link_attach: Floats
    """(L,) where the base sits along the parent link: 1 within a stem, 0..1 for a stem's first link."""
    link_radius_base: Floats
    """(L,) wood radius at the link's base that mechanics reckons with (flare yes, lobes no), m."""
    link_radius_tip: Floats
    """(L,) the same at the link's tip, m."""

    leaf_link: Ints
    """(N,) link that carries the leaf, ascending."""
    leaf_position: Floats
    """(N, 3) where the leaf is attached, on its link's axis, m."""
    leaf_axis: Floats
    """(N, 3) unit direction from attachment to leaf tip."""
    leaf_normal: Floats
    """(N, 3) unit normal of the upper face, perpendicular to the axis."""
    leaf_length: Floats
    """(N,) m."""
    leaf_width: Floats
    """(N,) m."""

    joint_scale: Floats | None = field(default=None)
    """(L, 2) optional factors on the stiffness of a joint's two springs; None means 1. The first spring resists
    rotation about parent x child, the second about the axis perpendicular to that and to the link."""

    @property
    def stem_count(self) -> int:
        """Number of stems, S."""
        return len(self.stem_parent)

    @property
    def link_count(self) -> int:
        """Number of links, L."""
        return len(self.link_parent)

    @property
    def leaf_count(self) -> int:
        """Number of leaves, N."""
        return len(self.leaf_link)

    @property
    def leaf_area(self) -> Floats:
        """(N,) one-sided area of each leaf, m^2; the blade fills LEAF_FILL of its length x width."""
        return LEAF_FILL * self.leaf_length * self.leaf_width

    @property
    def height(self) -> float:
        """Height of the highest link end above the root, m."""
        return float(self.link_tip[:, 2].max())


LEAF_FILL = 0.7
"""Area of a leaf blade over length x width, about right for ovals and ellipses (pi/4 = 0.785) with a point."""
