"""Mass and stiffness of every link, from the wood's radii and the leaves it carries."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.plants.plant import Plant

Doubles = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Rods:
    """Links as tapered rods of wood with their leaves' mass, about the joint at their base."""

    mass: Doubles
    """(L,) wood and leaves, kg."""
    moment: Doubles
    """(L,) first moment over link length: mass x (centre of mass as a fraction of the link), kg."""
    inertia: Doubles
    """(L,) second moment about an axis across the link through its base, kg m^2."""
    compliance: Doubles
    """(L, 2) joint angle per torque about each of its two axes, rad/(N m)."""


def link_length(plant: Plant) -> Doubles:
    """(L,) length of every link, m."""
    return np.linalg.norm(plant.link_tip.astype(np.float64) - plant.link_base, axis=1)


def leaf_fraction(plant: Plant) -> Doubles:
    """(N,) where along its link each leaf's centre lies, 0 at the base, 1 at the tip."""
    link = plant.leaf_link
    centre = plant.leaf_position + 0.5 * plant.leaf_length[:, None] * plant.leaf_axis
    along = (plant.link_tip - plant.link_base)[link].astype(np.float64)
    offset = (centre - plant.link_base[link]).astype(np.float64)
    return np.clip(np.sum(offset * along, axis=1) / np.sum(along * along, axis=1), 0.0, 1.0)


def half_compliance(
    radius_joint: Doubles, radius_end: Doubles, length: Doubles, youngs_modulus: float
) -> Doubles:
    """Integral of ds / EI over the half of a conical rod that lies next to a joint, rad/(N m).

    Args:
        radius_joint: (n,) radius at the joint, m.
        radius_end: (n,) radius at the rod's other end, m.
        length: (n,) of the whole rod, m.
        youngs_modulus: Pa.

    """
    middle = 0.5 * (radius_joint + radius_end)
    # Integral over the half of 4 / (pi E r^4) with r linear; the bracket is (a^-3 - b^-3) / (3 (b - a)) for
    # a = joint, b = middle, written so that it stays exact when a equals b.
    bracket = (radius_joint**2 + radius_joint * middle + middle**2) / (3.0 * (radius_joint * middle) ** 3)
    return 4.0 / (np.pi * youngs_modulus) * 0.5 * length * bracket


def build_rods(plant: Plant) -> Rods:
    """Rods of a plant.

    A joint stands for the wood half a link to either side of it; the first joint of a stem only for the half
    link above it, since the wood below belongs to the parent stem (PHYSICS B3: 2 EI/h at the base joint).
    """
    material, length = plant.material, link_length(plant)
    base, tip = plant.link_radius_base.astype(np.float64), plant.link_radius_tip.astype(np.float64)
    squares = base**2 + base * tip + tip**2
    linear_density = material.wood_density * np.pi * length
    mass = linear_density * squares / 3.0
    moment = linear_density * (base**2 + 2 * base * tip + 3 * tip**2) / 12.0
    inertia = linear_density * length**2 * (base**2 + 3 * base * tip + 6 * tip**2) / 30.0
    inertia += linear_density * (base**4 + base**3 * tip + (base * tip) ** 2 + base * tip**3 + tip**4) / 20.0

    leaf_mass = material.leaf_mass * plant.leaf_area.astype(np.float64)
    fraction, link, count = leaf_fraction(plant), plant.leaf_link, plant.link_count
    mass += np.bincount(link, leaf_mass, count)
    moment += np.bincount(link, leaf_mass * fraction, count)
    inertia += np.bincount(link, leaf_mass * (fraction * length[link]) ** 2, count)

    compliance = half_compliance(base, tip, length, material.youngs_modulus)
    first = np.zeros(count, bool)
    first[plant.stem_link_start[:-1]] = True
    inner = np.flatnonzero(~first)
    below = inner - 1
    compliance[inner] += half_compliance(tip[below], base[below], length[below], material.youngs_modulus)
    strength = np.ones((count, 2)) if plant.joint_scale is None else plant.joint_scale.astype(np.float64)
    return Rods(mass, moment, inertia, compliance[:, None] / strength)
