"""Frames that growth carries along stems: (n, 3, 3) arrays whose rows are the unit x, y and z axes.

z points along the stem. A stem leaves its parent by a turn about the parent's z and then about its own x;
a positive turn about x tips z towards -y.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Reals = NDArray[np.float64]

X, Y, Z = 0, 1, 2


def upright(count: int) -> Reals:
    """(count, 3, 3) frames along the world's axes."""
    return np.tile(np.eye(3), (count, 1, 1))


def turn_about_x(frame: Reals, angle: ArrayLike) -> Reals:
    """Frames turned about their own x axis by angle, rad."""
    cos, sin = _cos_sin(angle)
    y, z = frame[:, Y], frame[:, Z]
    return np.stack((frame[:, X], cos * y + sin * z, cos * z - sin * y), axis=1)


def turn_about_y(frame: Reals, angle: ArrayLike) -> Reals:
    """Frames turned about their own y axis by angle, rad."""
    cos, sin = _cos_sin(angle)
    x, z = frame[:, X], frame[:, Z]
    return np.stack((cos * x - sin * z, frame[:, Y], cos * z + sin * x), axis=1)


def turn_about_z(frame: Reals, angle: ArrayLike) -> Reals:
    """Frames turned about their own z axis by angle, rad."""
    cos, sin = _cos_sin(angle)
    x, y = frame[:, X], frame[:, Y]
    return np.stack((cos * x + sin * y, cos * y - sin * x, frame[:, Z]), axis=1)


def tip_towards(frame: Reals, heading: ArrayLike, angle: ArrayLike) -> Reals:
    """Frames turned by angle about the axis at ``heading`` in their own x-y plane, rad."""
    heading = np.asarray(heading)
    return turn_about_z(turn_about_x(turn_about_z(frame, heading), angle), -heading)


def turn_about_axis(frame: Reals, axis: Reals, angle: ArrayLike) -> Reals:
    """Frames turned about a world axis (n, 3) of unit length by angle, rad (Rodrigues)."""
    cos, sin = (np.broadcast_to(part, (len(frame), 1))[:, None] for part in _cos_sin(angle))
    k = np.broadcast_to(axis, (len(frame), 3))[:, None, :]
    along = (frame * k).sum(axis=2, keepdims=True)
    return frame * cos + np.cross(k, frame) * sin + k * along * (1.0 - cos)


def turn_to(frame: Reals, direction: Reals) -> Reals:
    """Frames turned by the shortest way so that z becomes the unit direction (n, 3)."""
    z = frame[:, Z]
    middle = (z + direction)[:, None, :]
    to_middle = (frame * middle).sum(axis=2, keepdims=True)
    along = (frame * z[:, None, :]).sum(axis=2, keepdims=True)
    share = to_middle / np.maximum(1.0 + (z * direction).sum(axis=1), 1e-9)[:, None, None]
    return frame - share * middle + 2.0 * along * direction[:, None, :]


def declination(frame: Reals) -> Reals:
    """(n,) angle between z and the vertical, rad."""
    return np.arccos(np.clip(frame[:, Z, 2], -1.0, 1.0))


def _cos_sin(angle: ArrayLike) -> tuple[Reals, Reals]:
    """Cosine and sine as columns."""
    column = np.atleast_1d(np.asarray(angle, np.float64))[:, None]
    return np.cos(column), np.sin(column)
