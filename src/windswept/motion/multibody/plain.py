"""`multibody` as plain formulas for one placement in double precision, with the whole mass matrix written out.

What the kernels must equal, by another way: a link is a line of points x + s b whose velocity is J_x + s J_b times the
joint rates, and Lagrange's equations are solved densely.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from windswept.motion.model import Model, joint_lag
from windswept.motion.multibody.constants import (
    MOST_ANGLE,
    PULL_KNEE,
    RATE_LEAD,
    STOP_ANGLE,
    STOP_EDGE,
    STOP_STIFFNESS,
    forces_at,
    warped_step,
)
from windswept.motion.rods import Doubles
from windswept.plants.air import reconfiguration


@dataclass(frozen=True, slots=True)
class Kinematics:
    """Where L links are and how they move."""

    direction: Doubles
    """(L, 3) unit vector along the link."""
    velocity: Doubles
    """(L, 2, 3) of the joint (m/s) and of the direction (1/s)."""
    jacobian: Doubles
    """(L, 2, 3, 2 L) velocity per joint rate."""


def turn_matrix(a: Doubles) -> Doubles:
    """(3, 3) left Jacobian of rotations: angular velocity per rate of the rotation vector."""
    angle, cross = np.linalg.norm(a), np.cross(np.eye(3), a)
    if angle < 1e-4:
        return np.eye(3) + 0.5 * cross + cross @ cross / 6.0
    return (
        np.eye(3)
        + (1.0 - np.cos(angle)) / angle**2 * cross
        + (angle - np.sin(angle)) / angle**3 * cross @ cross
    )


def kinematics(model: Model, angles: Doubles, rates: Doubles) -> Kinematics:
    """Kinematics from (L, 2) joint angles and rates."""
    skeleton, count = model.skeleton, model.link_count
    rotation: list[Rotation] = []
    direction, spin = np.empty((count, 3)), np.zeros((count, 3))
    velocity, jacobian = np.zeros((count, 2, 3)), np.zeros((count, 2, 3, 2 * count))
    turning = np.zeros((count, 3, 2 * count))
    for link, up in enumerate(skeleton.parent):
        carrier = Rotation.identity()
        spin_above = np.zeros(3)
        if up >= 0:
            carrier, spin_above = rotation[up], spin[up]
            reach = skeleton.attach[link] * skeleton.length[up]
            turning[link] = turning[up]
            for total in (velocity, jacobian):
                total[link, 0] = total[up, 0] + reach * total[up, 1]
        a = angles[link] @ skeleton.axes[link]
        axes = carrier.apply((turn_matrix(a) @ skeleton.axes[link].T).T)
        turning[link, :, 2 * link : 2 * link + 2] = axes.T
        spin[link] = spin_above + rates[link] @ axes
        rotation.append(carrier * Rotation.from_rotvec(a))
        b = rotation[link].apply(skeleton.vector[link] / skeleton.length[link])
        direction[link] = b
        velocity[link, 1] = np.cross(spin[link], b)
        jacobian[link, 1] = np.cross(turning[link], b, axisa=0, axisb=0).T
    return Kinematics(direction, velocity, jacobian)


def mass_matrix(model: Model, moving: Kinematics) -> Doubles:
    """(2 L, 2 L) joint-space mass matrix, kg m^2."""
    return np.einsum("lixm,lij,ljxn->mn", moving.jacobian, rod_moments(model), moving.jacobian, optimize=True)


def rod_moments(model: Model) -> Doubles:
    """(L, 2, 2) integrals of mass, mass x s and mass x s^2 along every link: kg, kg m, kg m^2."""
    rods, first = model.rods, model.rods.moment * model.skeleton.length
    return np.array([[rods.mass, first], [first, rods.inertia]]).transpose(2, 0, 1)


def step_multibody_plain(
    model: Model,
    angles: Doubles,
    rates: Doubles,
    carried: Doubles,
    wind: Doubles,
    push: Doubles | None = None,
) -> tuple[Doubles, Doubles, Doubles]:
    """One inner step.

    Args:
        model: the plant's constants.
        angles: (L, 2) rad.
        rates: (L, 2) rad/s.
        carried: (L, 2, 3) velocity of every link's joint and direction, as the last step left them.
        wind: (B, 3) air velocity at the probes, m/s.
        push: (L, 3) other forces at the drag centres, N; None for none.

    Returns:
        New angles, rates and carried velocities.

    """
    step, ahead = warped_step(model), forces_at(model)
    moving = kinematics(model, angles + ahead * rates, rates)
    force, resistance = drag_plain(model, moving, wind)
    growth, strain = (of(model, moving, force, wind) for of in (growth_plain, strain_plain))
    if push is not None:
        force = force + push
    lever = model.drag.centre * model.skeleton.length
    centre = moving.jacobian[:, 0] + lever[:, None, None] * moving.jacobian[:, 1]
    held = np.einsum("lij,ljx->lix", rod_moments(model), (moving.velocity - carried) / ahead)
    stiffness, over = 1.0 / model.rods.compliance, angles - np.clip(angles, -STOP_ANGLE, STOP_ANGLE)
    lag = (ahead + joint_lag(model)[:, None]) * (1.0 + STOP_STIFFNESS * (over != 0.0))
    torque = np.einsum("lxm,lx->m", centre, force) - np.einsum("lixm,lix->m", moving.jacobian, held)
    torque -= (stiffness * (angles + STOP_STIFFNESS * over + lag * rates)).ravel()
    matrix = mass_matrix(model, moving) + np.diag((stiffness * ahead * lag).ravel())
    resistance = resistance + growth
    matrix += ahead * np.einsum("lxm,lxy,lyn->mn", centre, resistance, centre, optimize=True)
    pull = ahead**2 * strain
    turning = pull * (1.0 + pull / (pull + PULL_KNEE * model.rods.inertia))
    matrix += np.einsum("lxm,l,lxn->mn", moving.jacobian[:, 1], turning, moving.jacobian[:, 1], optimize=True)
    rise = np.linalg.solve(matrix, torque)
    carried = carried + (moving.velocity + ahead * moving.jacobian @ rise - carried) * (step / ahead)
    rise = rise.reshape(-1, 2)
    middle = rates + ahead * rise
    most = np.where(over != 0.0, MOST_ANGLE, STOP_EDGE)
    return np.clip(angles + step * middle, -most, most), middle + RATE_LEAD * ahead * rise, carried


def drag_plain(model: Model, moving: Kinematics, wind: Doubles) -> tuple[Doubles, Doubles]:
    """(L, 3) force of the air on every link, N, and (L, 3, 3) the same over relative velocity, N s/m."""
    drag, relative = model.drag, relative_air(model, moving, wind)
    air = wind[model.link_probe]
    speed = np.linalg.norm(relative, axis=1)
    folded = reconfiguration(model.material, np.linalg.norm(air, axis=1)).astype(np.float64)
    b = moving.direction
    across = np.eye(3) - b[:, :, None] * b[:, None, :]
    resistance = (speed * folded)[:, None, None] * drag.leaf_tensors + (speed * drag.wood)[
        :, None, None
    ] * across
    return np.einsum("lxy,ly->lx", resistance, relative), resistance


def growth_plain(model: Model, moving: Kinematics, force: Doubles, wind: Doubles) -> Doubles:
    """(L, 3, 3) what (L, 3) drag over velocity gains by growing with speed, N s/m; see ``descend.drag``."""
    relative = relative_air(model, moving, wind)
    size, speed = (np.maximum(np.linalg.norm(v, axis=1), 1e-15)[:, None] for v in (force, relative))
    half = 0.5 * np.sqrt(size / speed) * (force / size + relative / speed)
    return np.asarray(half[:, :, None] * half[:, None, :])


def relative_air(model: Model, moving: Kinematics, wind: Doubles) -> Doubles:
    """(L, 3) velocity of the air past every drag centre, m/s."""
    lever = (model.drag.centre * model.skeleton.length)[:, None]
    return wind[model.link_probe] - moving.velocity[:, 0] - lever * moving.velocity[:, 1]


def strain_plain(model: Model, moving: Kinematics, force: Doubles, wind: Doubles) -> Doubles:
    """(L,) what (L, 3) forces of the air on all links stiffen every link by, N m: the pull along it times its lever."""
    skeleton, b = model.skeleton, moving.direction
    lever = model.drag.centre * skeleton.length
    u = relative_air(model, moving, wind)
    along_wood = np.linalg.norm(u, axis=1) * model.drag.wood * np.sum(u * b, axis=1)
    pull, strain = force.copy(), lever * (np.sum(force * b, axis=1) + along_wood)
    for link in range(model.link_count - 1, 0, -1):
        up = skeleton.parent[link]
        if up >= 0:
            pull[up] += pull[link]
            strain[up] += pull[link] @ b[up] * skeleton.attach[link] * skeleton.length[up]
    return np.maximum(strain, 0.0)


def energy(model: Model, angles: Doubles, carried: Doubles) -> float:
    """Kinetic energy of (L, 2, 3) carried velocities and that of springs and stops at (L, 2) angles, J."""
    kinetic = 0.5 * np.einsum("lix,lij,ljx->", carried, rod_moments(model), carried)
    over = angles - np.clip(angles, -STOP_ANGLE, STOP_ANGLE)
    return float(kinetic + 0.5 * np.sum((angles**2 + STOP_STIFFNESS * over**2) / model.rods.compliance))
