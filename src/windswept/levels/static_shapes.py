"""static_shapes: every joint's angles under steady wind to second order, fitted to the plant as it really bends."""

from __future__ import annotations

import numpy as np

from windswept.levels.influence import Influence
from windswept.levels.static_angles import static_angles
from windswept.motion import Model, finest_level, pose_links, rest_state
from windswept.motion.rods import Doubles
from windswept.motion.shapes import SHAPE_COUNT
from windswept.plants.air import reconfiguration
from windswept.plants.plant import Floats

STATED_WIND = 12.0
"""Wind speed that shapes and errors are stated for, m/s."""
FITTED_SPEEDS = (STATED_WIND, 8.0)
"""Speeds of the steady winds that the shapes are fitted to, m/s."""
DIRECTIONS = 8
"""From which they blow, all round."""
REGULAR = 1e-3
"""Keeps second-order terms small that no wind asks for; pressures are in units of the stated wind's."""


def stated_pressure(model: Model, influence: Influence, speed: float = STATED_WIND) -> float:
    """The wind's pressure at a speed, in the unit of the static shapes, (m/s)^2.

    A group reckons the pressure of a wind from its own shares of leaf and wood; this is that of the whole plant.
    """
    leaf = influence.folded * np.trace(influence.leaf_drag, axis1=1, axis2=2).sum()
    share = leaf / (leaf + np.trace(influence.wood_drag, axis1=1, axis2=2).sum() + 1e-30)
    folded = float(reconfiguration(model.material, np.array([speed]))[0])
    return speed**2 * (share * folded / influence.folded + 1.0 - share)


def static_shapes(model: Model, influence: Influence) -> Floats:
    """(L, 2, SHAPE_COUNT) shapes of all joints: first order from the influence, second order by least squares.

    Args:
        model: the plant at its finest level.
        influence: its static influence.
    """
    scale = stated_pressure(model, influence)
    winds, pressures = [], []
    for turn, speed in enumerate(FITTED_SPEEDS):
        azimuth = 2.0 * np.pi * (np.arange(DIRECTIONS) + turn / len(FITTED_SPEEDS)) / DIRECTIONS
        ways = np.column_stack([np.cos(azimuth), np.sin(azimuth), np.zeros(DIRECTIONS)])
        winds.append(speed * ways)
        pressures.append(ways * stated_pressure(model, influence, speed) / scale)
    angles = static_angles(model, np.concatenate(winds).astype(np.float32))
    felt = _felt_by_parents(model, angles, np.concatenate(pressures))
    squares = _squares(felt)
    left = angles.transpose(1, 0, 2) - np.einsum("lij,lpj->lpi", influence.angle * scale, felt)
    normal = np.matmul(squares.transpose(0, 2, 1), squares) + REGULAR * np.eye(6)
    right = np.matmul(squares.transpose(0, 2, 1), left)
    second = np.linalg.solve(normal, right).transpose(0, 2, 1)
    shapes = np.empty((model.link_count, 2, SHAPE_COUNT), np.float32)
    shapes[:, :, :3] = influence.angle
    shapes[:, :, 3:] = second / scale**2
    return shapes


def _felt_by_parents(model: Model, angles: Floats, pressure: Doubles) -> Doubles:
    """(L, P, 3) each of P pressures in the frame of every link's parent, the plant bent by (P, L, 2) angles."""
    level = finest_level(model)
    state = rest_state(level, len(angles))
    for placement, turned in enumerate(angles):
        state.angles(placement)[:] = turned
    pose = pose_links(model, level, state)
    parent = model.skeleton.parent
    q = pose.rotation[:, parent].transpose(1, 0, 2).astype(np.float64)
    q[parent < 0] = (0.0, 0.0, 0.0, 1.0)
    turned = np.broadcast_to(pressure, (len(parent), *pressure.shape))
    t = 2.0 * np.cross(turned, q[..., :3])
    return turned + q[..., 3:] * t + np.cross(t, q[..., :3])


def _squares(u: Doubles) -> Doubles:
    """(..., 6) xx, yy, zz, xy, xz, yz of (..., 3) vectors."""
    return u[..., (0, 1, 2, 0, 0, 1)] * u[..., (0, 1, 2, 1, 2, 2)]
