"""The static shape of a joint: the angles at which steady wind holds it, to second order in the wind's pressure.

    angle = A u + Q (u, u)        u the pressure vector (3) in the frame of the joint's parent link, (m/s)^2

The torque on a joint comes from what lies beyond it alone, so A (2 x 3) and Q (2 x 6) are constants of the link. A is
the response of the straight plant; Q is what bending does to the lever arms: a twig that the wind bends away from
itself yields less and less, one that it folds over yields more.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from windswept.motion.lanes import FAST_MATH, at_least, clamped, sqrt
from windswept.motion.rotation import dot

SHAPE_COUNT = 9
"""Numbers for each angle: x, y, z, then xx, yy, zz, xy, xz, yz of u."""
MAX_ANGLE = 1.5
"""No joint is pulled further than this, rad: wood that is bent so far at one joint has long left the linear law."""


_LIMIT: Any = np.float32(MAX_ANGLE)


@njit(fastmath=FAST_MATH, forceinline=True)
def shaped(shape, u, limit):  # type: ignore[no-untyped-def]
    """Both angles of a joint, rad.

    Args:
        shape: (2, SHAPE_COUNT) of the joint.
        u: pressure in its parent's frame, three numbers or Lanes, (m/s)^2.
        limit: pressure beyond which angles go on in proportion to it, (m/s)^2.
    """
    short = limit / sqrt(at_least(dot(u, u), limit * limit))
    xx, yy, zz = u[0] * u[0] * short, u[1] * u[1] * short, u[2] * u[2] * short
    xy, xz, yz = u[0] * u[1] * short, u[0] * u[2] * short, u[1] * u[2] * short
    first = u[0] * shape[0, 0] + u[1] * shape[0, 1] + u[2] * shape[0, 2]
    first = first + xx * shape[0, 3] + yy * shape[0, 4] + zz * shape[0, 5]
    first = first + xy * shape[0, 6] + xz * shape[0, 7] + yz * shape[0, 8]
    second = u[0] * shape[1, 0] + u[1] * shape[1, 1] + u[2] * shape[1, 2]
    second = second + xx * shape[1, 3] + yy * shape[1, 4] + zz * shape[1, 5]
    second = second + xy * shape[1, 6] + xz * shape[1, 7] + yz * shape[1, 8]
    return clamped(first, _LIMIT), clamped(second, _LIMIT)


@njit(fastmath=FAST_MATH, forceinline=True)
def shape_slopes(shape, u, limit):  # type: ignore[no-untyped-def]
    """(2, 3) slope of both angles in each component of u, as if nothing held them, rad s^2/m^2; see `shaped`."""
    short = limit / sqrt(at_least(dot(u, u), limit * limit))
    x, y, z = u[0] * short, u[1] * short, u[2] * short
    return (
        (
            shape[0, 0] + 2.0 * x * shape[0, 3] + y * shape[0, 6] + z * shape[0, 7],
            shape[0, 1] + 2.0 * y * shape[0, 4] + x * shape[0, 6] + z * shape[0, 8],
            shape[0, 2] + 2.0 * z * shape[0, 5] + x * shape[0, 7] + y * shape[0, 8],
        ),
        (
            shape[1, 0] + 2.0 * x * shape[1, 3] + y * shape[1, 6] + z * shape[1, 7],
            shape[1, 1] + 2.0 * y * shape[1, 4] + x * shape[1, 6] + z * shape[1, 8],
            shape[1, 2] + 2.0 * z * shape[1, 5] + x * shape[1, 7] + y * shape[1, 8],
        ),
    )
