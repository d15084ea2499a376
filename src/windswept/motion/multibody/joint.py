"""A joint that turns a link by the rotation vector angle_1 axis_1 + angle_2 axis_2, and never twists it.

Its rate of turn is not the rate of the rotation vector a: omega = J(a) a', with J the left Jacobian of rotations,
1 + A [a] + B [a]^2 with A = (1 - cos |a|) / |a|^2 and B = (|a| - sin |a|) / |a|^3. All here is in the frame of the
joint at rest, (axis_1, axis_2, link), carried by the parent.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from windswept.motion.lanes import FAST_MATH, clamped
from windswept.motion.rotation import Vector

_F = np.float32
_AT_ONCE = _F(1e12)
_ONE: Any = _F(1.0)


@njit(fastmath=FAST_MATH, forceinline=True)
def half_turn(x: Any) -> tuple[Any, Any]:
    """Sine of half an angle over the angle, and cosine of half the angle, from the angle's square.

    Taylor series as in ``rotation.from_rotation_vector``.
    """
    x = _F(0.25) * x
    s = _F(1 / 5040) - x * _F(1 / 362880)
    s = _F(0.5) * (_F(1.0) - x * (_F(1 / 6) - x * (_F(1 / 120) - x * s)))
    c = _F(1 / 720) - x * (_F(1 / 40320) - x * _F(1 / 3628800))
    return s, _F(1.0) - x * (_F(0.5) - x * (_F(1 / 24) - x * c))


@njit(fastmath=FAST_MATH, forceinline=True)
def joint_axes(angle_1: Any, angle_2: Any, x: Any, s: Any) -> tuple[Vector, Vector]:
    """Both columns of J: rate of turn per unit rate of either angle."""
    lean = _F(2.0) * s * s
    curl = _F(1 / 6) - x * (_F(1 / 120) - x * (_F(1 / 5040) - x * _F(1 / 362880)))
    one, two = angle_1 * curl, angle_2 * curl
    mixed = one * angle_2
    return (_F(1.0) - two * angle_2, mixed, -(lean * angle_2)), (
        mixed,
        _F(1.0) - one * angle_1,
        lean * angle_1,
    )


@njit(fastmath=FAST_MATH, forceinline=True)
def within_stop(over: Any) -> Any:
    """1 in a joint's stop, 0 outside, from the angle beyond its beginning."""
    return clamped(over * over * _AT_ONCE, _ONE)
