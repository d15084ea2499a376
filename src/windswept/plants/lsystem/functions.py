"""The functions that an expression may call, by name, with the number of their arguments."""

from __future__ import annotations

import math
from collections.abc import Callable


def _degrees(function: Callable[[float], float]) -> Callable[[float], float]:
    return lambda x: function(math.radians(x))


def _in_degrees(function: Callable[..., float]) -> Callable[..., float]:
    return lambda *x: math.degrees(function(*x))


FUNCTIONS: dict[str, tuple[Callable[..., float], int]] = {
    "sin": (_degrees(math.sin), 1),
    "cos": (_degrees(math.cos), 1),
    "tan": (_degrees(math.tan), 1),
    "asin": (_in_degrees(math.asin), 1),
    "acos": (_in_degrees(math.acos), 1),
    "atan": (_in_degrees(math.atan), 1),
    "atan2": (_in_degrees(math.atan2), 2),
    "sqrt": (math.sqrt, 1),
    "exp": (math.exp, 1),
    "log": (math.log, 1),
    "pow": (math.pow, 2),
    "floor": (lambda x: float(math.floor(x)), 1),
    "ceil": (lambda x: float(math.ceil(x)), 1),
    "trunc": (lambda x: float(math.trunc(x)), 1),
    "fabs": (abs, 1),
    "abs": (abs, 1),
    "sign": (lambda x: float((x > 0) - (x < 0)), 1),
    "min": (min, 2),
    "max": (max, 2),
}
"""Angles are degrees, as in cpfg."""

DRAWS: dict[str, tuple[Callable[..., float], int]] = {
    "ran": (lambda dice, x: x * dice.random(), 1),
    "nran": (lambda dice, mean, spread: mean + spread * dice.standard_normal(), 2),
    "bran": (lambda dice, a, b: dice.beta(a, b), 2),
}
"""ran(x) is uniform in 0..x, nran(mean, deviation) normal, bran(a, b) beta. The first argument is a Generator."""
