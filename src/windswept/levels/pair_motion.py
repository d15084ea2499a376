"""swing_pairs: a parent link and its only child, bent by steady wind on the leaf at the tip and then let go.

Two rigid uniform rods in a plane on a spring each, coupled. With a and b the turns of parent and child from rest,
D the angle from parent to child as they stand, and m, S, I a rod's mass and its moments about its own joint:

    (I_p + m_c L_p^2) a'' + L_p S_c cos(D) b'' - L_p S_c sin(D) b'^2 = F_a - k_p a + k_c (b - a)
          L_p S_c cos(D) a'' + I_c b''         + L_p S_c sin(D) a'^2 = F_b          - k_c (b - a)

Both joints are damped in proportion to their springs, so that of the pair's two modes the faster dies first. What is
read off is what an onlooker would read: how far the tip stands out in the wind, and how long ten swings take.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from windswept.motion.rods import Doubles

STEPS_PER_PERIOD = 200
SETTLING_PERIODS = 6
"""How long the wind holds, at critical damping."""
WAITED_PERIODS = 40
"""How long the pair swings before it is timed, while the faster mode dies."""
TIMED_SWINGS = 10
SWING_DAMPING = 0.1
"""Damping ratio of a free swing of the period reckoned beforehand."""


@dataclass(frozen=True, slots=True)
class Pairs:
    """n pairs of links: parent in column 0, child in column 1."""

    stiffness: Doubles
    """(n, 2) of the joints at their bases, N m/rad."""
    length: Doubles
    """(n, 2) m."""
    mass: Doubles
    """(n, 2) kg, spread evenly."""
    angle: Doubles
    """(n,) from the parent's direction to the child's at rest, rad."""

    @property
    def inertia(self) -> Doubles:
        """(n,) of each pair about the parent's joint, kg m^2."""
        (one, two), (l_p, l_c) = self.mass.T, self.length.T
        own, moment_c, own_c = one * l_p**2 / 3.0, two * l_c / 2.0, two * l_c**2 / 3.0
        return own + two * l_p**2 + 2.0 * l_p * moment_c * np.cos(self.angle) + own_c

    @property
    def reach(self) -> Doubles:
        """(n,) distance from the parent's joint to the child's tip at rest, m."""
        l_p, l_c = self.length.T
        return np.sqrt(l_p**2 + l_c**2 + 2.0 * l_p * l_c * np.cos(self.angle))


def swing_pairs(pairs: Pairs, force: float) -> tuple[Doubles, Doubles]:
    """How far wind holds the tip of each pair, and how fast the pair swings when let go.

    Args:
        pairs: of links.
        force: of the wind on the leaf at the child's tip, square to the line from the parent's joint to it, N.

    Returns:
        (n,) displacement of the tip along the wind, m, the mean of wind from either side.
        (n,) lowest undamped angular frequency, rad/s.
    """
    own_inertia = pairs.mass[:, 1] * pairs.length[:, 1] ** 2 / 3.0
    # Dunkerley: the lowest period is at most this, and at least this over the square root of two.
    softness = pairs.inertia / pairs.stiffness[:, 0] + own_inertia / pairs.stiffness[:, 1]
    period = 2.0 * np.pi * np.sqrt(softness)
    return _swing_all(pairs.stiffness, pairs.length, pairs.mass, pairs.angle, period, force)


@njit(cache=True)
def _swing_all(  # type: ignore[no-untyped-def]
    stiffness, length, mass, angle, period, force
):
    """Tip displacement and angular frequency of every pair."""
    count = len(angle)
    displacement, frequency = np.empty(count), np.empty(count)
    motion = np.empty(4)
    for i in range(count):
        pair = (
            stiffness[i, 0],
            stiffness[i, 1],
            length[i, 0],
            length[i, 1],
            mass[i, 0],
            mass[i, 1],
            angle[i],
        )
        time_step = period[i] / STEPS_PER_PERIOD
        displacement[i] = 0.0
        for side in (-1.0, 1.0):
            motion[:] = 0.0
            for _ in range(SETTLING_PERIODS * STEPS_PER_PERIOD):
                _advance(motion, pair, side * force, time_step, period[i] / np.pi, 1.0)
            displacement[i] += 0.5 * side * _displacement(motion, pair)
        frequency[i] = _time_swings(motion, pair, time_step, SWING_DAMPING * period[i] / np.pi)
    return displacement, frequency


@njit(cache=True)
def _advance(  # type: ignore[no-untyped-def]
    motion, pair, force, time_step, damping_time, share
):
    """One step of the two equations, with springs and dampers taken at ``share`` of the step.

    At 1 the step stills fast modes, at 1/2 it keeps time.

    Args:
        motion: (4,) turns of parent and child and their rates, rad and rad/s; stepped in place.
        pair: stiffnesses, lengths and masses of parent and child, and the angle between them.
        force: on the tip, N.
        time_step: s.
        damping_time: the joints' damping over their stiffness, s.
        share: of the step.
    """
    k_p, k_c, l_p, l_c, m_p, m_c, angle = pair
    a, b, rate_a, rate_b = motion
    between = angle + b - a
    moment = 0.5 * l_p * m_c * l_c
    coupling, whirl = moment * np.cos(between), moment * np.sin(between)
    wind = _rest_direction(l_p, l_c, angle) + 0.5 * np.pi
    later = share * time_step
    turn_p = a + (damping_time + later) * rate_a
    turn_c = b - a + (damping_time + later) * (rate_b - rate_a)
    torque_a = force * l_p * np.sin(wind - a) - k_p * turn_p + k_c * turn_c + whirl * rate_b**2
    torque_b = force * l_c * np.sin(wind - angle - b) - k_c * turn_c - whirl * rate_a**2
    ahead = later * (damping_time + later)
    m11 = m_p * l_p**2 / 3.0 + m_c * l_p**2 + ahead * (k_p + k_c)
    m12 = coupling - ahead * k_c
    m22 = m_c * l_c**2 / 3.0 + ahead * k_c
    determinant = m11 * m22 - m12 * m12
    gain_a = time_step * (m22 * torque_a - m12 * torque_b) / determinant
    gain_b = time_step * (m11 * torque_b - m12 * torque_a) / determinant
    motion[0] += time_step * (rate_a + share * gain_a)
    motion[1] += time_step * (rate_b + share * gain_b)
    motion[2] += gain_a
    motion[3] += gain_b


@njit(cache=True)
def _rest_direction(l_p, l_c, angle):  # type: ignore[no-untyped-def]
    """Angle from the parent at rest to the line from its joint to the child's tip."""
    return np.arctan2(l_c * np.sin(angle), l_p + l_c * np.cos(angle))


@njit(cache=True)
def _displacement(motion, pair):  # type: ignore[no-untyped-def]
    """How far the tip stands from its rest place, along the wind."""
    _, _, l_p, l_c, _, _, angle = pair
    line = _rest_direction(l_p, l_c, angle)
    return l_p * np.sin(motion[0] - line) + l_c * np.sin(angle + motion[1] - line)


@njit(cache=True)
def _time_swings(motion, pair, time_step, damping_time):  # type: ignore[no-untyped-def]
    """Undamped angular frequency of a pair that is let go, from the times and speeds at which it passes its rest."""
    widest = np.zeros(2)
    for step in range(WAITED_PERIODS * STEPS_PER_PERIOD):
        _advance(motion, pair, 0.0, time_step, damping_time, 1.0)
        if step >= (WAITED_PERIODS - 1) * STEPS_PER_PERIOD:
            widest = np.maximum(widest, np.abs(motion[:2]))
    joint = 0 if widest[0] > widest[1] else 1
    passed, step = 0, 0
    first = first_rate = last = last_rate = 0.0
    while passed <= TIMED_SWINGS:
        before, rate_before = motion[joint], motion[joint + 2]
        _advance(motion, pair, 0.0, time_step, damping_time, 0.5)
        if before < 0.0 <= motion[joint]:
            part = before / (before - motion[joint])
            last = (step + part) * time_step
            last_rate = rate_before + part * (motion[joint + 2] - rate_before)
            if passed == 0:
                first, first_rate = last, last_rate
            passed += 1
        step += 1
    # The swing e^(-sigma t) sin(omega_d t), whose undamped frequency is the root of omega_d^2 + sigma^2.
    damped = 2.0 * np.pi * TIMED_SWINGS / (last - first)
    decay = np.log(first_rate / last_rate) / (last - first)
    return np.sqrt(damped**2 + decay**2)
