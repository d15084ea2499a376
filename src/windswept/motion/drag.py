"""How the air pushes on every link: the one place where velocity becomes force.

A leaf is a plate that feels the air's component along its normal, a stem a cylinder that feels the component
across its axis. With speed |u| relative to the air, the force on a link is

    F = |u| ( f T u + w (u - d (d.u)) ),     T = 1/2 rho C_d sum A n n^T,     w = 1/2 rho C_d diameter length

where f = (1 + (U/U_c)^2)^(V/2) is the leaves' reconfiguration (PHYSICS B4). Leaves keep their orientation in the
plant's frame: they hang on flexible petioles, while the stem under them turns.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.motion.rods import Doubles, leaf_fraction, link_length
from windswept.plants.air import AIR_DENSITY
from windswept.plants.plant import Plant


@dataclass(frozen=True, slots=True)
class Drag:
    """Aerodynamic constants of every link; a force over speed squared is in N / (m/s)^2 = kg/m."""

    leaf: Doubles
    """(L, 6) the symmetric tensor T of its leaves: xx, yy, zz, xy, xz, yz, kg/m."""
    wood: Doubles
    """(L,) the coefficient w of its bare stem, kg/m."""
    centre: Doubles
    """(L,) where along the link the force acts, 0 at the base, 1 at the tip; the middle where there is none."""

    @property
    def leaf_tensors(self) -> Doubles:
        """(L, 3, 3) T of every link's leaves."""
        xx, yy, zz, xy, xz, yz = self.leaf.T
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)


def build_drag(plant: Plant) -> Drag:
    """Drag constants of a plant."""
    material, link, count = plant.material, plant.leaf_link, plant.link_count
    area = plant.leaf_area.astype(np.float64)
    push = 0.5 * AIR_DENSITY * material.leaf_drag * area
    n = plant.leaf_normal.astype(np.float64)
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    leaf: Doubles = np.column_stack([np.bincount(link, push * n[:, i] * n[:, j], count) for i, j in pairs])
    diameter = plant.link_radius_base.astype(np.float64) + plant.link_radius_tip
    wood = 0.5 * AIR_DENSITY * material.wood_drag * diameter * link_length(plant)
    whole = np.bincount(link, push, count) + wood
    first = np.bincount(link, push * leaf_fraction(plant), count) + 0.5 * wood
    return Drag(leaf, wood, np.divide(first, whole, out=np.full(count, 0.5), where=whole > 0.0))
