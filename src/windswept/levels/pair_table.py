"""The look-up tables of parent/child pairs: how far wind holds a pair, and how fast it swings (PHYSICS C3.7).

Every pair of the table, and a single link, is simulated once in the stated wind (`pair_motion.py`). What comes out is
kept without dimensions, so that it serves links of any size:

    displacement    of the tip along the wind, times k_p / (F L^2)
    rate            lowest angular frequency, over the root of k_p / I

with k_p the parent's stiffness, F the force on the leaf, L the distance from the parent's joint to the child's tip,
and I the pair's inertia about the parent's joint.

Run ``python -m windswept.levels.pair_table`` to make the table again, to the same numbers.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np
from numba import njit

from windswept.levels.pair_motion import Pairs, swing_pairs
from windswept.motion.rods import Doubles
from windswept.plants.air import AIR_DENSITY
from windswept.plants.plant import Floats, Ints

STATED_SPEED = 20.0
"""The maximal wind, m/s (C3.8)."""
LEAF_AREA = 0.01
"""Of the leaf at each pair's tip, with a drag coefficient of 1, m^2."""
FARTHEST_TURN = 0.1
"""The pairs are as stiff as turns their two joints, together, at most this far in the stated wind, rad."""

LOW = (-12.0 * np.log(2.0), -np.log(2.0), 0.0, -2.0 * np.log(2.0))
"""Where the axes begin: ln(k_c / k_p), ln(L_c / L_p), angle between the links in rad, ln(density_c / density_p)."""
STEP = (0.5 * np.log(2.0), 0.5 * np.log(2.0), np.pi / 12.0, 2.0 * np.log(2.0))
COUNT = (37, 19, 7, 8)
"""Nodes on each axis. Density is mass per length; the static displacement does not depend on it."""
SHIPPED = Path(__file__).with_suffix(".npz")
_DECIMALS = 5
"""Logarithms are kept so finely; what lies below differs between processors."""


@dataclass(frozen=True, slots=True)
class PairTable:
    """Natural logarithms of what the simulated pairs did, over COUNT nodes of stiffness, length, angle and density."""

    displacement: Floats
    """(37, 19, 7) of displacement x k_p / (F L^2)."""
    rate: Floats
    """(37, 19, 7, 8) of frequency / root(k_p / I)."""
    single: Floats
    """(2,) of both for one link alone: 0, if it were not for the size of its swing and of the time step."""


@cache
def pair_table() -> PairTable:
    """The table that is shipped with the package."""
    with np.load(SHIPPED) as stored:
        return PairTable(stored["displacement"], stored["rate"], stored["single"])


def make_pair_table() -> PairTable:
    """The table, simulated."""
    every = np.indices(COUNT, np.int32).reshape(4, -1)
    displacement, rate = simulated_nodes(every)
    single = np.array(_simulate(np.array([1e6]), np.ones(1), np.zeros(1), np.ones(1))).ravel()
    # A pair's rest in the wind is the same whatever it weighs: kept once.
    displacement = displacement.reshape(COUNT)[..., 0]
    return PairTable(displacement, rate.reshape(COUNT), _rounded(single))


def simulated_nodes(node: Ints) -> tuple[Floats, Floats]:
    """Entries of some nodes of the table.

    Args:
        node: (4, n) indices along the table's axes.

    Returns:
        (n,) entries for displacement and (n,) for rate.
    """
    stiffness, length, angle, density = np.array(LOW)[:, None] + np.array(STEP)[:, None] * node
    displacement, rate = _simulate(np.exp(stiffness), np.exp(length), angle, np.exp(density))
    return _rounded(displacement), _rounded(rate)


def _simulate(
    stiffness_ratio: Doubles, length_ratio: Doubles, angle: Doubles, density_ratio: Doubles
) -> tuple[Doubles, Doubles]:
    """Dimensionless displacement and rate of pairs whose parent is 1 m long and weighs 1 kg."""
    one = np.ones(len(angle))
    force = 0.5 * AIR_DENSITY * LEAF_AREA * STATED_SPEED**2
    length, mass = np.column_stack([one, length_ratio]), np.column_stack([one, density_ratio * length_ratio])
    soft = Pairs(np.column_stack([one, stiffness_ratio]), length, mass, angle)
    reach = soft.reach
    parent = force * reach * np.sum(1.0 / soft.stiffness, axis=1) / FARTHEST_TURN
    pairs = replace(soft, stiffness=parent[:, None] * soft.stiffness)
    displacement, frequency = swing_pairs(pairs, force)
    return displacement * parent / (force * reach**2), frequency / np.sqrt(parent / pairs.inertia)


def _rounded(value: Doubles) -> Floats:
    """Natural logarithms as they are kept."""
    return np.round(np.log(value), _DECIMALS).astype(np.float32)


@njit(cache=True)
def look_up_stiffness(displacement, single, stiffness_ratio, length_ratio, angle):  # type: ignore[no-untyped-def]
    """Stiffness, over the parent's, of the single link of the pair's reach that stands as far out in the wind.

    Args:
        displacement: of the table.
        single: of the table.
        stiffness_ratio: k_c / k_p.
        length_ratio: L_c / L_p.
        angle: between parent and child, rad.
    """
    a, first = _node_weights(0, np.log(stiffness_ratio))
    b, second = _node_weights(1, np.log(length_ratio))
    c, third = _node_weights(2, angle)
    total = 0.0
    for i in range(4):
        for j in range(4):
            for k in range(4):
                total += first[i] * second[j] * third[k] * displacement[a + i, b + j, c + k]
    return np.exp(single[0] - total)


@njit(cache=True)
def look_up_rate(rate, single, stiffness_ratio, length_ratio, angle, density_ratio):  # type: ignore[no-untyped-def]
    """Lowest angular frequency of the pair, over that of a single link with its parent's stiffness and its inertia.

    Args:
        rate: of the table.
        single: of the table.
        stiffness_ratio: k_c / k_p.
        length_ratio: L_c / L_p.
        angle: between parent and child, rad.
        density_ratio: mass per length of the child over that of the parent.
    """
    a, first = _node_weights(0, np.log(stiffness_ratio))
    b, second = _node_weights(1, np.log(length_ratio))
    c, third = _node_weights(2, angle)
    d, fourth = _node_weights(3, np.log(density_ratio))
    total = 0.0
    for i in range(4):
        for j in range(4):
            for k in range(4):
                weight = first[i] * second[j] * third[k]
                for m in range(4):
                    total += weight * fourth[m] * rate[a + i, b + j, c + k, d + m]
    return np.exp(total - single[1])


@njit(cache=True)
def equal_rods(length_p, angle, inertia, moment_c, inertia_c):  # type: ignore[no-untyped-def]
    """The two uniform rods of the table that swing as a pair of any shape does.

    A pair's motion depends on its masses through three moments only: its own inertia, the child's, and the child's
    first moment. A pair whose mass lies as in no pair of the table is held at the table's edge; there the ratio of the
    links' own frequencies must be kept, not that of their stiffnesses, and the child's share of the inertia turns the
    one into the other.

    Args:
        length_p: from the parent's joint to the child's, m.
        angle: between parent and child, up to a right angle, rad.
        inertia: of the pair about the parent's joint, kg m^2.
        moment_c: first moment of the child about its own joint, kg m.
        inertia_c: of the child about its own joint, kg m^2.

    Returns:
        Ratios of length and density of the rods, and the child's share inertia_c / inertia of them.
    """
    length = 1.5 * inertia_c / max(moment_c * length_p, 1e-30)
    length = min(max(length, np.exp(LOW[1])), np.exp(LOW[1] + STEP[1] * (COUNT[1] - 1)))
    carried = length + length**2 * np.cos(angle) + length**3 / 3.0
    # The parent's own inertia in units of the child's density, a third of what it would be at equal density.
    parent = inertia / inertia_c * length**3 / 3.0 - carried
    densest = np.exp(LOW[3] + STEP[3] * (COUNT[3] - 1))
    density = min(max(1.0 / max(3.0 * parent, 1.0 / densest), np.exp(LOW[3])), densest)
    return length, density, length**3 / (1.0 / density + 3.0 * carried)


@njit(cache=True)
def _node_weights(axis, value):  # type: ignore[no-untyped-def]
    """First of the four nodes around a value, and their weights in the cubic through them; held at the axis' ends."""
    place = min(max((value - LOW[axis]) / STEP[axis], 0.0), COUNT[axis] - 1.0)
    first = min(max(int(place) - 1, 0), COUNT[axis] - 4)
    t = place - first
    u, v, w = t - 1.0, t - 2.0, t - 3.0
    return first, (-u * v * w / 6.0, t * v * w / 2.0, -t * u * w / 2.0, t * u * v / 6.0)


def write_pair_table(path: Path = SHIPPED) -> None:
    """Simulate the table and write it."""
    table = make_pair_table()
    np.savez(path, displacement=table.displacement, rate=table.rate, single=table.single)


if __name__ == "__main__":
    write_pair_table()
