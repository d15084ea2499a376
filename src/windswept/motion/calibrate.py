"""calibrated: the decoupled joints of a plant, tuned to how the coupled plant answers the wind.

In a plant whose joints are all coupled, the angle of a joint is not that of an oscillator at its stem's own frequency:
the trunk carries the branches' inertia along, and a branch is driven by the trunk that swings under it. How every joint
answers turbulence of each frequency is a linear problem with one walk up and one down the plant for each frequency
(the articulated-body recursion on complex stiffness). Each stem then gets the frequency and the damping ratio whose
oscillator, driven by the torque that `springs` reckons with, comes nearest to its joints' true angles in turbulence.
Stiffness stays, so static deflection does too.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from windswept.motion.model import Model, pack_constants
from windswept.motion.multibody.constants import joint_lag
from windswept.motion.rods import Doubles
from windswept.motion.skeleton import Skeleton
from windswept.plants.air import reconfiguration

Complexes = NDArray[np.complex128]

REFERENCE_SPEED = 8.0
"""Mean wind whose drag damps the plant while it is tuned, m/s."""
GUST_TIME = 1.0
"""Integral time scale of the wind pressure that a plant feels, s."""
TRAVEL = np.radians([-45.0, 0.0, 45.0])
"""Where the turbulence's crests travel to while they drift with the mean wind along x, radians."""
CROSS_RATIO = 0.8
"""Turbulence across the wind over that along it."""
LOWEST, HIGHEST, LINES = 0.5, 40.0, 32
"""Angular frequencies of the turbulence, rad/s, and their number."""
LIVELY = 0.3
"""Weight of what a stem's mean square angle is off by, beside the mean square error."""
AT_ONCE = 8
"""Angular frequencies at once: what bounds the memory."""
RATIOS = np.geomspace(0.7, 1.4, 41)
"""Frequencies that are tried, over the stem's own."""
DAMPINGS = np.geomspace(0.25, 4.0, 25)
"""Damping ratios that are tried, over the stem's own: beyond these an oscillator would hide a misfit, not mend it."""


def calibrated(model: Model) -> Model:
    """The model with stem frequencies and damping ratios tuned to the coupled plant in turbulent wind.

    Args:
        model: as ``build_model`` makes it.
    """
    line = np.geomspace(LOWEST, HIGHEST, LINES)
    weight = np.gradient(line) / (1.0 + (line * GUST_TIME) ** 2) ** (5.0 / 6.0)
    frequency, damping = nearest_oscillators(model, line, weight, *stem_answers(model, line))
    tuned = replace(model, stem_frequency=frequency, damping_ratio=damping)
    return replace(tuned, constants=pack_constants(tuned))


def nearest_oscillators(
    model: Model, line: Doubles, weight: Doubles, pushed: Doubles, turned: Doubles, cross: Complexes
) -> tuple[Doubles, Doubles]:
    """Frequency and damping ratio of the oscillator that takes each stem's torques nearest to its angles.

    What is least is the mean square error plus what the mean square angle is off by: where an oscillator cannot keep
    the phase, least squares alone would hush it.

    Args:
        model: with each stem's own frequency and damping ratio.
        line: (F,) angular frequencies, rad/s.
        weight: (F,) of them in the wind.
        pushed: (F, S) mean square of compliance x torque.
        turned: (F, S) mean square angle.
        cross: (F, S) mean of conj(compliance x torque) x angle.
    """
    own, own_damping = model.stem_frequency, model.damping_ratio
    least = np.full(len(own), np.inf)
    frequency, damping = own.copy(), own_damping.copy()
    swing = weight @ turned
    for ratio in RATIOS:
        relative = line[:, None] / (ratio * own)
        for share in DAMPINGS:
            zeta = np.minimum(share * own_damping, 0.95)
            response = 1.0 / (1.0 - relative**2 + 2j * zeta * relative)
            power = weight @ (np.abs(response) ** 2 * pushed)
            # |G t - a|^2 = |G|^2 |t|^2 - 2 Re(conj(G) conj(t) a) + |a|^2
            error = power - 2.0 * (weight @ (response.conj() * cross).real) + swing
            error += LIVELY * np.abs(power - swing)
            better = error < least
            least[better], frequency[better], damping[better] = (
                error[better],
                (ratio * own)[better],
                zeta[better],
            )
    return frequency, damping


def stem_answers(model: Model, line: Doubles) -> tuple[Doubles, Doubles, Complexes]:
    """How the joints of every stem answer turbulence in the coupled plant.

    Returns:
        (F, S) mean squares of compliance x torque and of the angle, and mean of conj(compliance x torque) x angle,
        over the stem's joints by how far they move tips, and over the winds.
    """
    stems, count = model.skeleton.stem, len(model.stem_frequency)
    compliance, weight = model.rods.compliance[:, :, None], tip_weight(model.skeleton)
    pushed, turned = np.empty((2, len(line), count))
    cross = np.empty((len(line), count), complex)
    for first in range(0, len(line), AT_ONCE):
        block = line[first : first + AT_ONCE]
        for k, (angle, torque) in enumerate(zip(*joint_answers(model, block, TRAVEL), strict=True), first):
            target = compliance * torque
            pushed[k] = np.bincount(stems, weight * np.sum(np.abs(target) ** 2, axis=(1, 2)), count)
            turned[k] = np.bincount(stems, weight * np.sum(np.abs(angle) ** 2, axis=(1, 2)), count)
            both = weight * np.sum(target.conj() * angle, axis=(1, 2))
            cross[k] = np.bincount(stems, both.real, count) + 1j * np.bincount(stems, both.imag, count)
    return pushed, turned, cross


def joint_answers(model: Model, line: Doubles, travel: Doubles) -> tuple[Complexes, Complexes]:
    """Angles of all joints of the coupled plant in waves of air, and torques on them without inertia.

    Args:
        model: the plant's constants.
        line: (F,) angular frequencies, rad/s.
        travel: (D,) where the waves' crests travel to while they drift with the mean wind along x, radians.

    Returns:
        (F, L, 2, 2 D) each, for waves of every direction that push along x and across it.
    """
    skeleton = model.skeleton
    axes = np.concatenate([skeleton.axes, np.zeros_like(skeleton.axes)], axis=2).astype(complex)
    at = (skeleton.base + model.drag.centre[:, None] * skeleton.vector)[:, :2]
    delay = at @ np.array([np.cos(travel), np.sin(travel)]) / (REFERENCE_SPEED * np.cos(travel))
    tree = (skeleton.parent, skeleton.attach, skeleton.vector, axes)
    springs = 1.0 / model.rods.compliance, joint_lag(model)
    return _answers(line, *tree, *springs, *spatial_constants(model), delay)


def tip_weight(skeleton: Skeleton) -> Doubles:
    """(L,) sum of squared distances from every joint to the stem tips beyond it, m^2."""
    last = np.append(skeleton.stem_first_link[1:], len(skeleton.parent)) - 1
    is_tip = np.zeros(len(skeleton.parent))
    is_tip[last] = 1.0
    tip = skeleton.base + skeleton.vector

    def beyond(per_link: Doubles) -> Doubles:
        summed = np.concatenate([np.zeros((1, *per_link.shape[1:])), np.cumsum(per_link, axis=0)])
        return summed[skeleton.subtree_end] - summed[:-1]

    mean = np.sum(beyond(is_tip[:, None] * tip) * skeleton.base, axis=1)
    square = beyond(is_tip * np.sum(tip**2, axis=1))
    return square - 2.0 * mean + beyond(is_tip) * np.sum(skeleton.base**2, axis=1)


def spatial_constants(model: Model) -> tuple[Doubles, Doubles, Doubles]:
    """Mass (L, 6, 6) and drag (L, 6, 6) of every link about its joint, turning first, and the wrench (L, 6, 2) of a
    little more wind along x and along y.
    """
    skeleton, rods, air = model.skeleton, model.rods, model.drag
    length, b = skeleton.length, skeleton.vector / skeleton.length[:, None]
    across = np.eye(3) - b[:, :, None] * b[:, None, :]
    folded = float(reconfiguration(model.material, np.array([REFERENCE_SPEED]))[0])
    resistance = REFERENCE_SPEED * (folded * air.leaf_tensors + air.wood[:, None, None] * across)

    def about_joint(tensor: Doubles, arm: Doubles) -> Doubles:
        """(L, 6, 6) of a (L, 3, 3) tensor that acts at an (L, 3) arm."""
        cross = -np.cross(arm[:, None, :], np.eye(3))
        reach = np.concatenate([cross, np.broadcast_to(np.eye(3), cross.shape)], axis=1)
        return reach @ tensor @ np.swapaxes(reach, 1, 2)

    arm = (air.centre * length)[:, None] * b
    drag = about_joint(resistance, arm)
    push = np.concatenate([np.cross(arm[:, :, None], resistance, axis=1), resistance], axis=1)[:, :, :2]
    ball = np.broadcast_to(np.eye(3), across.shape)
    # A rod is a point at its centre of mass, and what is left of its turning inertia.
    fraction = rods.moment / rods.mass
    mass = about_joint(rods.mass[:, None, None] * ball, (fraction * length)[:, None] * b)
    mass[:, :3, :3] += (rods.inertia - rods.mass * (fraction * length) ** 2)[:, None, None] * across
    return mass, drag, push * np.array([1.0, CROSS_RATIO])


@njit(cache=True, parallel=True)
def _answers(  # type: ignore[no-untyped-def]
    line, parent, attach, vector, axes, stiffness, lag, mass, drag, push, delay
):
    """(F, L, 2, R) angles of all joints, and torques on them without inertia, at every angular frequency."""
    count, columns = len(parent), push.shape[2] * delay.shape[1]
    angle = np.empty((len(line), count, 2, columns), np.complex128)
    torque = np.empty_like(angle)
    for k in prange(len(line)):
        omega = line[k]
        wave = np.empty((count, 6, columns), np.complex128)
        for link in range(count):
            for direction in range(delay.shape[1]):
                phase = np.exp(-1j * omega * delay[link, direction])
                wave[link, :, 2 * direction : 2 * direction + 2] = push[link] * phase
        _answer(omega, parent, attach, vector, axes, stiffness, lag, mass, drag, wave, angle[k], torque[k])
    return angle, torque


@njit(cache=True)
def _answer(  # type: ignore[no-untyped-def]
    omega, parent, attach, vector, axes, stiffness, lag, mass, drag, push, angle, torque
):
    """One frequency: articulated stiffness leaf to root, angles and motion root to leaf, torques leaf to root."""
    count = len(parent)
    z = -(omega**2) * mass + 1j * omega * drag
    p = push.copy()
    answer, motion = np.empty((count, 2, 6), np.complex128), np.zeros(push.shape, np.complex128)
    for link in range(count - 1, -1, -1):
        s = axes[link]
        u = s @ z[link]
        d = u @ _transposed(s)
        for i in range(2):
            d[i, i] += stiffness[link, i] * (1.0 + 1j * omega * lag[link])
        e = np.array([[d[1, 1], -d[0, 1]], [-d[1, 0], d[0, 0]]]) / (d[0, 0] * d[1, 1] - d[0, 1] * d[1, 0])
        answer[link], angle[link] = e @ u, e @ (s @ p[link])
        up = parent[link]
        if up >= 0:
            t = _transport(attach[link] * vector[up])
            u, back = _transposed(u), _transposed(t)
            z[up] += back @ (z[link] - u @ answer[link]) @ t
            p[up] += back @ (p[link] - u @ angle[link])
    for link in range(count):
        up = parent[link]
        if up >= 0:
            motion[link] = _transport(attach[link] * vector[up]) @ motion[up]
        angle[link] -= answer[link] @ motion[link]
        motion[link] += _transposed(axes[link]) @ angle[link]
    for link in range(count):
        p[link] = push[link] - 1j * omega * (drag[link].astype(np.complex128) @ motion[link])
    for link in range(count - 1, -1, -1):
        torque[link] = axes[link] @ p[link]
        up = parent[link]
        if up >= 0:
            p[up] += _transposed(_transport(attach[link] * vector[up])) @ p[link]


@njit(cache=True)
def _transposed(m):  # type: ignore[no-untyped-def]
    return np.ascontiguousarray(m.T)


@njit(cache=True)
def _transport(r):  # type: ignore[no-untyped-def]
    """(6, 6) motion of a point at r from that of the origin: x + turn x r."""
    t = np.eye(6).astype(np.complex128)
    t[3, 1], t[3, 2] = r[2], -r[1]
    t[4, 0], t[4, 2] = -r[2], r[0]
    t[5, 0], t[5, 1] = r[1], -r[0]
    return t
