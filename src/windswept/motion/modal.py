"""Modes: what the lowest natural modes of the whole plant mend in the motion of its joints.

In `springs` a joint answers its torque as an oscillator of its own. Where all joints are coupled the lowest modes are
not like that: the trunk carries the inertia of its branches, a branch is driven by the trunk that swings under it, and
near resonance a joint's angle is not its static angle times one number. So the part of every joint's motion that lies
in the lowest modes is taken out, and stepped at the modes' own frequencies and damping.

With K the stiffness and C = 1 / K the compliance of the joints, Phi the modes (L joints' angles by R) and
T = K Phi the torques that hold them, the coordinates of any angles x in the modes are ::

    modal(x) = G T' x,   G = (Phi' K Phi)^-1,   so that modal(Phi z) = z and P = Phi modal

projects on the modes, orthogonally in elastic energy as modes are to one another. Let joint j, for itself, accelerate
by -w_j y_j, where y_j is its deviation from its static angle and w_j its frequency squared, and let W_r be those of the
modes. Then what all joints have to accelerate by is -B y with ::

    B = (1 - P) w (1 - P) + Phi W modal  =  w + D,    D y = Phi (Q modal(y) - modal(w y)) - w Phi modal(y)

where Q = modal(w Phi) + W. Every joint takes its own step exactly, and then its rate is changed by -D y times the step.
B Phi = Phi W, and beside the modes B is (1 - P) w (1 - P), which is self-adjoint in elastic energy: all frequencies of
B are real, and kicks neither feed nor drain the motion while a mode takes several steps. Damping, c_j = 2 zeta omega,
is shared out in the same way.

Where y is zero nothing is added: static deflection stays exact, and rest stays rest. Nothing is remembered from step to
step, so plants may change their level at any time.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

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
FASTEST = 1.0
"""Radians a step beyond which a mode is too fast to be kicked, and a joint for itself too fast to be told of modes.

Kicks feed a mode of more than two radians a step, of fewer where it is damped. All joints of a stem have its lowest
frequency, but its further modes are several times as fast.
"""
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
    """(3, R, R) G, Q G and the same as Q G of damping; rows and columns of zeros for modes that are left out."""
    own: Floats
    """(K, 2) w of every link's joints (1/s^2) and c (1/s)."""
    frequency: Doubles
    """(R,) rad/s, ascending."""
    damping_ratio: Doubles
    """(R,) fraction of critical damping."""
    time_step: float
    """s"""

    def among(self, links: Ints) -> Modes:
        """The same modes where only some links are stepped, numbered by their place in ``links`` (A,), ascending."""
        place = np.searchsorted(links, self.link)
        is_own = links[np.minimum(place, len(links) - 1)] == self.link if len(links) else place < 0
        return _taken_part(self, is_own, place[is_own].astype(np.int32))


def plant_modes(
    skeleton: Skeleton, rods: Rods, frequency: Doubles, damping_ratio: Doubles, time_step: float
) -> Modes:
    """The MODE_COUNT lowest modes of a plant.

    Args:
        skeleton: the rest skeleton.
        rods: mass and compliance.
        frequency: (L,) of every joint for itself, rad/s.
        damping_ratio: (L,) of every joint.
        time_step: fixed inner step, s.
    """
    omega, angle = natural_modes(skeleton, rods, MODE_COUNT, NEAR_ENOUGH)
    # A single link has two freedoms. Modes of no shape have no energy, and are left out.
    lacking = MODE_COUNT - len(omega)
    omega, angle = np.pad(omega, (0, lacking), "edge"), np.pad(angle, ((0, 0), (0, 0), (0, lacking)))
    angle[..., omega * time_step >= FASTEST] = 0.0
    torque = angle / rods.compliance[:, :, None]
    energy = np.sum(torque * angle, axis=1)
    lag = 2.0 * damping_ratio / frequency
    whole = Modes(
        link=np.arange(len(frequency), dtype=np.int32),
        angle=angle,
        torque=torque.astype(np.float32),
        gain=np.zeros((3, MODE_COUNT, MODE_COUNT), np.float32),
        own=np.column_stack([frequency**2, 2.0 * damping_ratio * frequency]).astype(np.float32),
        frequency=omega,
        damping_ratio=np.minimum(0.5 * omega * (lag @ energy), 0.95),
        time_step=time_step,
    )
    link = _most_moved(np.where((frequency * time_step < FASTEST)[:, None], energy, 0.0))
    return _taken_part(whole, link, link)


def no_modes() -> Modes:
    """For what moves joint by joint."""
    return Modes(
        link=np.zeros(0, np.int32),
        angle=np.zeros((0, 2, MODE_COUNT)),
        torque=np.zeros((0, 2, MODE_COUNT), np.float32),
        gain=np.zeros((3, MODE_COUNT, MODE_COUNT), np.float32),
        own=np.zeros((0, 2), np.float32),
        frequency=np.zeros(MODE_COUNT),
        damping_ratio=np.zeros(MODE_COUNT),
        time_step=0.0,
    )


def _taken_part(modes: Modes, chosen: Ints | NDArray[np.bool_], link: Ints) -> Modes:
    """The modes in some of their links, which have the numbers given."""
    angle, torque, own = modes.angle[chosen], modes.torque[chosen], modes.own[chosen]
    overlap = np.einsum("kir,kis->rs", torque, angle)
    of_joints = np.einsum("kir,km,kis->mrs", torque, own, angle)
    of_modes = np.stack([modes.frequency**2, 2.0 * modes.damping_ratio * modes.frequency])
    gain = _gain(overlap)
    quickening = (gain @ of_joints + of_modes[:, :, None] * np.eye(MODE_COUNT)) @ gain
    gains = np.concatenate([gain[None], quickening]).astype(np.float32)
    return replace(modes, link=link, angle=angle, torque=torque, own=own, gain=gains)


def _most_moved(energy: Doubles) -> Ints:
    """(K,) the fewest links that hold all but LEFT_OUT of every mode's (L, R) energy."""
    order = np.argsort(-energy, axis=0)
    share = np.take_along_axis(energy, order, axis=0)
    before = np.cumsum(share, axis=0) - share
    needed = (before < (1.0 - LEFT_OUT) * share.sum(axis=0)) & (share > 0.0)
    return np.unique(order[needed]).astype(np.int32)


def _gain(overlap: Doubles) -> Doubles:
    """(R, R) inverse of the modes' (R, R) overlap, one mode after the other, without those that add too little."""
    kept: list[int] = []
    for mode in range(len(overlap)):
        both = overlap[np.ix_(kept, kept)]
        known = overlap[kept, mode]
        if overlap[mode, mode] - known @ np.linalg.solve(both, known) >= LEAST_SHARE:
            kept.append(mode)
    gain = np.zeros_like(overlap, dtype=np.float64)
    gain[np.ix_(kept, kept)] = np.linalg.inv(overlap[np.ix_(kept, kept)].astype(np.float64))
    return gain
