"""The constraint law by which a blade goes to its equilibrium (Barzel and Barr 1988; Endo, section 4.3).

    D'' + 2 zeta omega D' + omega^2 D = 0,        D = lean - equilibrium lean

With zeta = 1 and omega = 1 / tau it is Barzel and Barr's: D = (D0 + (v0 + D0 / tau) t) exp(-t / tau), of which 73.6 %
are left at tau, 5 % at 4.744 tau and 1 % at 6.638 tau (PHYSICS B7). Endo's equation 5 leaves the velocity out, and
would swing for ever (PHYSICS C2.9).
"""

from __future__ import annotations

import numpy as np

from windswept.motion.exact_step import exact_step
from windswept.motion.rods import Doubles


def constraint_step(frequency: Doubles, damping_ratio: float, time_step: float) -> Doubles:
    """One step of the law, exact for an equilibrium that stays.

    Args:
        frequency: (n,) omega, rad/s.
        damping_ratio: zeta, 0 to 1.
        time_step: s.

    Returns:
        (n, 4) coefficients xx, xv, vx, vv of (D, D') -> (xx D + xv D', vx D + vv D').
    """
    if damping_ratio < 1.0:
        return exact_step(frequency, np.full_like(frequency, damping_ratio), time_step)
    turned = frequency * time_step
    decay = np.exp(-turned)
    return np.column_stack(
        [decay * (1.0 + turned), decay * time_step, -decay * frequency * turned, decay * (1.0 - turned)]
    )


def resolves(step: Doubles) -> np.ndarray:
    """(n,) whether steps (n, 4) are less than a quarter of a turn of the swing.

    Air damps by the velocity that a blade has when a step begins. Over a quarter of a turn that is no longer its
    velocity in the step; from half a turn on, where ``vx`` changes its sign, it would feed the swing. A blade that
    swings so fast is left to its own damping, which ends the swing within a few steps.
    """
    return np.asarray(step[:, 0] + step[:, 3] > 0.0)
