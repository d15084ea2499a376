"""held_mass: what the links of a level carry of the mass of merged branches."""

from __future__ import annotations

import numpy as np

from windswept.motion.level import Level
from windswept.motion.model import Model
from windswept.motion.rods import Doubles


def held_mass(model: Model, level: Level) -> Doubles:
    """(A, 3) mass (kg), first moment along the link (kg m) and inertia across it (kg m^2) of what hangs on each.

    A group's branches go with their carrier as if they were rigid on it; they bend under the wind's pressure alone.
    A carrier is a line of mass, so its inertia is the mean of the two axes across it, and what branches that stand
    askew resist to a turn about the line itself is lost, as their own links lose it.

    Args:
        model: the plant's constants.
        level: a coupled level.
    """
    skeleton, rods = model.skeleton, model.rods
    sizes = level.group_stop - level.group_first
    group = np.repeat(np.arange(level.group_count), sizes)
    member = np.arange(len(group)) + np.repeat(level.group_first - (np.cumsum(sizes) - sizes), sizes)
    carrier = level.group_carrier[group]
    member, carrier = member[carrier >= 0], carrier[carrier >= 0]
    base = skeleton.base[member] - skeleton.base[carrier]
    d, unit = skeleton.vector[member], (skeleton.vector / skeleton.length[:, None])[carrier]
    mass, first = rods.mass[member], rods.moment[member]
    second = rods.inertia[member] / skeleton.length[member] ** 2

    def moments(one: Doubles, other: Doubles) -> Doubles:
        """(n,) integral over each member's mass of the square of ``one + s other``, summed over components."""
        squares = [np.sum(a * b, axis=1) for a, b in ((one, one), (one, other), (other, other))]
        return mass * squares[0] + 2.0 * first * squares[1] + second * squares[2]

    along = (np.sum(base * unit, axis=1)[:, None], np.sum(d * unit, axis=1)[:, None])
    inertia = 0.5 * (moments(*along) + moments(base, d))
    summed = (mass, mass * along[0][:, 0] + first * along[1][:, 0], inertia)
    held = np.zeros((model.link_count, 3))
    for column, one in enumerate(summed):
        held[:, column] = np.bincount(carrier, one, model.link_count)
    return held[level.link]
