"""exact_step: a damped oscillator over a whole step, without error."""

from __future__ import annotations

import numpy as np

from windswept.motion.rods import Doubles


def exact_step(frequency: Doubles, damping_ratio: Doubles, time_step: float) -> Doubles:
    """The damped oscillator y'' + 2 zeta omega y' + omega^2 y = 0 advanced exactly (PHYSICS A2, Quigley).

    Args:
        frequency: (n,) omega, rad/s.
        damping_ratio: (n,) zeta, below 1.
        time_step: s.

    Returns:
        (n, 4) coefficients xx, xv, vx, vv of (y, v) -> (xx y + xv v, vx y + vv v).
    """
    damped = frequency * np.sqrt(1.0 - damping_ratio**2)
    decay = np.exp(-damping_ratio * frequency * time_step)
    cosine, sine = np.cos(damped * time_step), np.sin(damped * time_step) / damped
    friction = damping_ratio * frequency * sine
    return np.column_stack(
        [decay * (cosine + friction), decay * sine, -decay * frequency**2 * sine, decay * (cosine - friction)]
    )
