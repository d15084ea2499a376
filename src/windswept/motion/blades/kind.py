"""BladeKind: everything about one component's motion that its blades share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

from windswept.motion.blades.chain import Chain, build_chain, weight_share
from windswept.motion.blades.lean import force_scale, lean_of_load
from windswept.motion.blades.pose_table import (
    DEFAULT_BINS,
    Bins,
    PoseTable,
    build_table,
    ray_directions,
    ray_norms,
)
from windswept.motion.blades.rest_shape import GRAVITY, moment
from windswept.motion.rods import Doubles
from windswept.plants.air import AIR_DENSITY
from windswept.plants.underbrush.blade import Blade

BROKEN_BINS = Bins(16, 12, 8)
"""Broken blades are few, and nobody looks at how they hang within a degree."""
STILL_SPEED = 20.0
"""m/s."""
STILL_LEAN = 0.02
"""A kind that leans less than this in a wind of STILL_SPEED need not be stepped."""


@dataclass(frozen=True, slots=True)
class BladeKind:
    """Constants of a blade of size 1. A force scale is the load that would bend the tip by one length (lean.py)."""

    name: str
    blade: Blade
    chain: Chain
    table: PoseTable
    """Poses while whole."""
    broken_table: PoseTable
    """Poses once the weakest joint is broken."""
    broken_scale: float
    """Force scale of a broken blade over that of a whole one."""
    breaking_lean: float
    """Bending lean at which the weakest joint breaks; infinity where no load does it."""
    force_scale: float
    """N."""
    weight: float
    """Weight, in force scales; the same for every size."""
    drag: float
    """1/2 rho C_d A, in force scales per (m/s)^2."""
    drag_share: Doubles
    """(3,) part of the drag that is felt from air along axis, normal and side."""
    reach: Doubles
    """(2,) travel of the drag's centre for a lean of 1 along normal and side, m."""
    frequency: Doubles
    """(2,) omega of the constraint law across the flat face and to the side, rad/s."""
    damping_ratio: float
    """zeta of the law; the air adds its own."""

    @property
    def push(self) -> float:
        """Force scales per N/m^2 of contact pressure."""
        return float(self.chain.area.sum()) / self.force_scale

    @property
    def still(self) -> bool:
        """Whether wind of STILL_SPEED moves it too little to be seen: a calyx, a bell of heather."""
        material = self.blade.component
        folded = (1.0 + (STILL_SPEED / material.reconfiguration_speed) ** 2) ** (
            0.5 * material.reconfiguration
        )
        return self.drag * STILL_SPEED**2 * folded < STILL_LEAN


def build_kind(blade: Blade, bins: Bins = DEFAULT_BINS, tau: float | None = None) -> BladeKind:
    """Kind of a component.

    Args:
        blade: shape and material, with what it carries.
        bins: how finely the table of poses is divided.
        tau: time constant of Barzel and Barr's critical law, s; None takes frequency and damping from the material.
    """
    component = blade.component
    chain = chain_of(blade)
    scale = force_scale(chain)
    table = build_table(chain, bins)
    breaking, joint = weakest(chain, table, bins)
    softened, broken_table, broken_scale = chain, table, 1.0
    if np.isfinite(breaking):
        broken = np.arange(chain.section_count) == joint
        softened = chain.softened(broken)
        broken_table = build_table(softened, BROKEN_BINS)
        broken_scale = force_scale(softened) / scale
    frequency = frequencies(chain) if tau is None else np.full(2, 1.0 / tau)
    return BladeKind(
        name=component.name,
        blade=blade,
        chain=chain,
        table=table,
        broken_table=broken_table,
        broken_scale=broken_scale,
        breaking_lean=breaking,
        force_scale=scale,
        weight=float(GRAVITY * chain.mass.sum() / scale),
        drag=float(0.5 * AIR_DENSITY * component.drag * chain.area.sum() / scale),
        drag_share=_drag_share(blade),
        reach=_reach(chain, scale),
        frequency=frequency,
        damping_ratio=component.damping_ratio if tau is None else 1.0,
    )


def chain_of(blade: Blade) -> Chain:
    """The springs and sections of a component."""
    return build_chain(
        blade.length,
        blade.bending_stiffness,
        blade.mass,
        blade.area,
        blade.curvature,
        1.0 if blade.round else blade.component.side_stiffness,
        blade.strength,
        blade.component.name,
    )


def weakest(chain: Chain, table: PoseTable, bins: Bins) -> tuple[float, int]:
    """Smallest bending lean at which a joint bears its strength, and that joint; infinity where none ever does."""
    strain = moment(chain, table.turns.astype(np.float64)) / chain.strength
    lean = lean_of_load(ray_norms(bins)[:, None, None] * ray_directions(bins)[:, None])
    worst, bending = strain.max(axis=-1), bending_lean(lean)
    before, after = worst[:, :-1], worst[:, 1:]
    crossing = (before < 1.0) & (after >= 1.0)
    if not crossing.any():
        return np.inf, 0
    part = (1.0 - before) / np.where(crossing, after - before, 1.0)
    at = np.where(crossing, bending[:, :-1] + part * (bending[:, 1:] - bending[:, :-1]), np.inf)
    node = np.unravel_index(np.argmin(at), at.shape)
    return float(at[node]), int(np.argmax(strain[:, 1:][node]))


def bending_lean(lean: Doubles) -> Doubles:
    """(...,) norm of leans (..., 3) without what pulls along the axis: a blade breaks by bending and folding only."""
    pulled = np.minimum(lean[..., :1], 0.0)
    return np.linalg.norm(np.concatenate([pulled, lean[..., 1:]], axis=-1), axis=-1)


def frequencies(chain: Chain) -> Doubles:
    """(2,) lowest angular frequency of the straight cantilever, across the flat face and to the side, rad/s."""
    base = np.concatenate([[0.0], np.cumsum(chain.length)[:-1]])
    arm = np.maximum(base + 0.5 * chain.length - base[:, None], 0.0)
    moves = (arm > 0.0).astype(np.float64)
    inertia = (arm * chain.mass) @ arm.T + (moves * chain.mass * chain.length**2 / 12.0) @ moves.T
    squares = [eigh(np.diag(chain.stiffness[:, i]), inertia, eigvals_only=True)[0] for i in range(2)]
    return np.sqrt(np.array(squares))


def _drag_share(blade: Blade) -> Doubles:
    """(3,) part of the drag felt along axis, normal and side: the faces that its own curve turns that way."""
    axis = blade.axis / np.linalg.norm(blade.axis, axis=1, keepdims=True)
    weight = blade.area / blade.area.sum()
    along = float(weight @ axis[:, 0] ** 2)
    side = 1.0 if blade.round else 0.0
    faces = np.array([1.0 - along, along, side])
    return blade.component.edge_drag + (1.0 - blade.component.edge_drag) * faces


def _reach(chain: Chain, scale: float) -> Doubles:
    """(2,) travel of the centre of drag for a lean of 1, of the straight chain, m."""
    base = np.concatenate([[0.0], np.cumsum(chain.length)[:-1]])
    arm = np.maximum(base + 0.5 * chain.length - base[:, None], 0.0)
    turn = scale * (arm @ weight_share(chain))[:, None] / chain.stiffness
    return (chain.area / chain.area.sum()) @ (arm.T @ turn)
