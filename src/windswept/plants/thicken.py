"""Wood is nowhere thinner than its load asks for.

A parametric tree's stems taper to nothing whatever hangs on their tips, which no living stem can afford: wood is laid
down where the wind strains it, so that bending stress at the surface is about the same everywhere (Metzger's rule of
uniform stress). Here each link gets at least the radius that carries the drag of everything beyond it at a working
wind and stress; where the grown radius is larger, it stays.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numba import njit
from numpy.typing import NDArray

from windswept.plants.air import AIR_DENSITY, reconfiguration
from windswept.plants.plant import Floats, Ints, Plant

WORKING_WIND = 10.0
"""Wind speed at which the stress is reckoned, m/s."""
WORKING_STRESS = 1.5e7
"""Bending stress at the surface in that wind, Pa: about a third of what green hardwood bears."""
PLATE_SHARE = 1.0 / 3.0
"""Drag of leaves that face every way over that of leaves that all face the wind."""


def thicken(plant: Plant) -> Plant:
    """The same plant with radii that carry its leaves; only ``link_radius_base`` and ``link_radius_tip`` change."""
    material = plant.material
    folded = reconfiguration(material, np.array([WORKING_WIND]))[0]
    pressure = 0.5 * AIR_DENSITY * WORKING_WIND**2
    push = pressure * material.leaf_drag * PLATE_SHARE * folded * plant.leaf_area.astype(np.float64)
    force = np.bincount(plant.leaf_link, push, plant.link_count)
    middle = 0.5 * (plant.link_base.astype(np.float64) + plant.link_tip)
    needed = _needed_radius(plant.link_parent, force, middle, plant.link_base.astype(np.float64))
    base = np.maximum(plant.link_radius_base, needed)
    tip = np.maximum(plant.link_radius_tip, 0.5 * needed)
    # A link is nowhere thinner than what grows out of it.
    child = np.flatnonzero(plant.link_parent >= 0)
    np.maximum.at(tip, plant.link_parent[child], base[child])
    return replace(plant, link_radius_base=base.astype(np.float32), link_radius_tip=tip.astype(np.float32))


@njit(cache=True)
def _needed_radius(
    parent: Ints, force: NDArray[np.float64], middle: NDArray[np.float64], base: Floats
) -> NDArray[np.float64]:
    """(L,) m; the bending moment is the summed drag beyond a link's base times the arm to its centre."""
    count = len(parent)
    total, first = force.copy(), middle * force.reshape(-1, 1)
    needed = np.zeros(count)
    for link in range(count - 1, -1, -1):
        arm = first[link] - base[link] * total[link]
        moment = np.sqrt(np.sum(arm * arm))
        needed[link] = max(needed[link], (4.0 * moment / (np.pi * WORKING_STRESS)) ** (1.0 / 3.0))
        if parent[link] >= 0:
            needed[parent[link]] = max(needed[parent[link]], needed[link])
            total[parent[link]] += total[link]
            first[parent[link]] += first[link]
    return needed
