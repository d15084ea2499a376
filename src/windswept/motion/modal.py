"""Modes: what the lowest natural modes of the whole plant mend in the motion of its joints.

In `springs` a joint answers its torque as an oscillator of its own. Where all joints are coupled the lowest modes are
not like that: the trunk carries the inertia of its branches, a branch is driven by the trunk that swings under it, and
near resonance a joint's angle is not its static angle times one number. So the part of every joint's motion that lies
in the lowest modes is taken out, and stepped at the modes' own frequencies and damping.

With K the stiffness and C = 1 / K the compliance of the joints, Phi the modes (L joints' angles by R) and
T = K Phi the torques that hold them, the coordinates of any angles x in the modes are ::

    modal(x) = G T' x,   G = (Phi' K Phi)^-1,   so that modal(Phi z) = z

which is orthogonal in elastic energy, as modes are. In a step, joint j has the deviation y_j from its static angle and
the rate v_j, and its own exact step is a_j y_j + b_j v_j. The modal part is stepped by the modes' A and B instead::

    x_j  +=  sum_r Phi_jr [(A_r - a_j) modal(y)_r + (B_r - b_j) modal(v)_r]

and so are rates. Where y and v are zero nothing is added: static deflection stays exact, and rest stays rest.
Nothing is remembered from step to step, so plants may change their level at any time.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.motion.exact_step import exact_step
from windswept.motion.modes import natural_modes
from windswept.motion.rods import Doubles, Rods
from windswept.motion.skeleton import Skeleton
from windswept.plants.plant import Floats, Ints

MODE_COUNT = 4
"""Modes that are stepped as such, R: for a tree the first two along and across."""
NEAR_ENOUGH = 1e-4
"""Relative error of a mode's frequency squared at which it is taken as found."""
LEFT_OUT = 0.05
"""Share of each mode's elastic energy in the joints that are left out of it, those that turn least."""
LEAST_SHARE = 0.25
"""A mode of which a level's links hold less elastic energy, beyond what they hold of other modes, is left out."""


@dataclass(frozen=True, slots=True)
class Modes:
    """R modes in K links of a plant or of one of its levels."""

    link: Ints
    """(K,) links that take part, ascending."""
    angle: Doubles
    """(K, 2, R) joint angles of every mode, Phi; elastic energy of the whole plant 1/2."""
    torque: Floats
    """(K, 2, R) torques that hold them, T."""
    gain: Floats
    """(R, R) G; rows and columns of zeros for modes that are left out."""
    frequency: Doubles
    """(R,) rad/s, ascending."""
    damping_ratio: Doubles
    """(R,) fraction of critical damping."""
    step: Floats
    """(R, 4) exact step, see exact_step.py."""

    def among(self, links: Ints) -> Modes:
        """The same modes where only some links are stepped, numbered by their place in ``links`` (A,), ascending."""
        place = np.searchsorted(links, self.link)
        own = links[np.minimum(place, len(links) - 1)] == self.link if len(links) else place < 0
        return _modes(
            place[own].astype(np.int32),
            self.angle[own],
            self.torque[own],
            (self.frequency, self.damping_ratio, self.step),
        )


def plant_modes(skeleton: Skeleton, rods: Rods, lag: Doubles, time_step: float) -> Modes:
    """The MODE_COUNT lowest modes of a plant.

    Args:
        skeleton: the rest skeleton.
        rods: mass and compliance.
        lag: (L,) damping of every joint over its stiffness, s.
        time_step: fixed inner step, s.
    """
    omega, shape = natural_modes(skeleton, rods, MODE_COUNT, NEAR_ENOUGH)
    # A single link has two freedoms: modes of no shape have no energy, and are left out.
    lacking = MODE_COUNT - len(omega)
    omega, shape = np.pad(omega, (0, lacking), "edge"), np.pad(shape, ((0, 0), (0, 0), (0, lacking)))
    torque = shape / rods.compliance[:, :, None]
    energy = np.sum(torque * shape, axis=1)
    damping = np.minimum(0.5 * omega * (lag @ energy), 0.95)
    link = _most_moved(energy)
    steps = omega, damping, exact_step(omega, damping, time_step).astype(np.float32)
    return _modes(link, shape[link], torque[link].astype(np.float32), steps)


def no_modes() -> Modes:
    """For what moves joint by joint."""
    nowhere, zeros = np.zeros((0, 2, MODE_COUNT)), np.zeros(MODE_COUNT)
    steps = zeros, zeros, np.zeros((MODE_COUNT, 4), np.float32)
    return _modes(np.zeros(0, np.int32), nowhere, nowhere.astype(np.float32), steps)


def _modes(link: Ints, angle: Doubles, torque: Floats, steps: tuple[Doubles, Doubles, Floats]) -> Modes:
    gain = _gain(np.einsum("kir,kis->rs", torque, angle))
    return Modes(link, angle, torque, gain.astype(np.float32), *steps)


def _most_moved(energy: Doubles) -> Ints:
    """(K,) the fewest links that hold all but LEFT_OUT of every mode's (L, R) energy."""
    order = np.argsort(-energy, axis=0)
    held = np.cumsum(np.take_along_axis(energy, order, axis=0), axis=0)
    needed = held - np.take_along_axis(energy, order, axis=0) < (1.0 - LEFT_OUT) * held[-1]
    return np.unique(order[needed]).astype(np.int32)


def _gain(overlap: Doubles) -> Doubles:
    """(R, R) inverse of the modes' (R, R) overlap, one mode after the other, without those that add too little."""
    kept: list[int] = []
    for mode in range(len(overlap)):
        both = overlap[np.ix_(kept, kept)]
        known = overlap[kept, mode]
        if overlap[mode, mode] - known @ np.linalg.solve(both, known) >= LEAST_SHARE:
            kept.append(mode)
    gain = np.zeros_like(overlap)
    gain[np.ix_(kept, kept)] = np.linalg.inv(overlap[np.ix_(kept, kept)])
    return gain
