"""How far two damped oscillators part that the same wind pressure pushes: the error of letting one stand for both.

Both settle at the same deflection in steady wind, so only frequency parts them. Deflections are in units of the
deflection under the greatest pressure.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numba import njit

from windswept.motion.rods import Doubles

LOG_LOW, LOG_HIGH, LOG_CELLS = np.log(0.3), np.log(300.0), 48
"""The table's axes: mean and difference of the natural logarithms of both angular frequencies in rad/s."""
GUST_TIME = 1.5
"""Integral time scale of the wind pressure that a plant feels, s."""
GUST_SHARE = 0.3
"""Standard deviation of the pressure over the greatest pressure."""
AIR_DAMPING = 0.08
"""Damping ratio that the air adds in a wind worth speaking of."""


@cache
def mismatch_table(damping_ratio: float) -> Doubles:
    """Standard deviation of the difference of two oscillators in turbulent wind, with the air's damping.

    The root of the integral of |H1 - H2|^2 S over frequency, with a pressure spectrum S that falls as the -5/3 power.

    Args:
        damping_ratio: structural damping of both oscillators.

    Returns:
        (LOG_CELLS + 1, LOG_CELLS + 1) table over the mean and the difference of the frequencies' logarithms.
    """
    mean = np.linspace(LOG_LOW, LOG_HIGH, LOG_CELLS + 1)[:, None]
    apart = np.linspace(0.0, LOG_HIGH - LOG_LOW, LOG_CELLS + 1)
    damping_ratio += AIR_DAMPING
    line = np.exp(np.linspace(np.log(0.02), np.log(300.0), 600))
    spectrum = 1.0 / (1.0 + (line * GUST_TIME) ** 2) ** (5.0 / 6.0)
    weight = spectrum * np.gradient(line)
    weight *= GUST_SHARE**2 / weight.sum()

    def response(omega: Doubles) -> Doubles:
        """Deflection of an oscillator over its static one, complex, along the spectrum."""
        ratio = line / omega[..., None]
        return 1.0 / (1.0 - ratio**2 + 2j * damping_ratio * ratio)

    between = response(np.exp(mean + 0.5 * apart)) - response(np.exp(mean - 0.5 * apart))
    return np.sqrt(np.abs(between) ** 2 @ weight)


@njit(cache=True)
def look_up(table: Doubles, log_a: float, log_b: float) -> float:
    """Bilinear interpolation in a mismatch table, held at its edges."""
    scale = LOG_CELLS / (LOG_HIGH - LOG_LOW)
    x = min(max((0.5 * (log_a + log_b) - LOG_LOW) * scale, 0.0), LOG_CELLS - 1e-9)
    y = min(abs(log_a - log_b) * scale, LOG_CELLS - 1e-9)
    i, j = int(x), int(y)
    u, v = x - i, y - j
    low = table[i, j] * (1.0 - v) + table[i, j + 1] * v
    high = table[i + 1, j] * (1.0 - v) + table[i + 1, j + 1] * v
    return low * (1.0 - u) + high * u
