"""`springs` as plain formulas for one placement in double precision: what the kernel in springs.py must equal."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from windswept.motion.exact_step import exact_step
from windswept.motion.model import Model, drag_mobility, tension_per_force
from windswept.motion.rods import Doubles
from windswept.motion.shapes import MAX_ANGLE
from windswept.plants.air import reconfiguration


def pose_plain(model: Model, angles: Doubles) -> tuple[list[Rotation], Doubles]:
    """Rotation and joint position of every link from (L, 2) joint angles."""
    skeleton = model.skeleton
    rotation: list[Rotation] = []
    position = np.empty((model.link_count, 3))
    for link, parent in enumerate(skeleton.parent):
        turn = Rotation.from_rotvec(angles[link] @ skeleton.axes[link])
        if parent < 0:
            rotation.append(turn)
            position[link] = skeleton.base[link]
        else:
            rotation.append(rotation[parent] * turn)
            reach = skeleton.attach[link] * skeleton.vector[parent]
            position[link] = position[parent] + rotation[parent].apply(reach)
    return rotation, position


def step_plain(
    model: Model, angles: Doubles, velocities: Doubles, wind: Doubles, push: Doubles | None = None
) -> tuple[Doubles, Doubles]:
    """One inner step.

    Args:
        model: the plant's constants.
        angles: (L, 2) rad.
        velocities: (L, 2) rad/s.
        wind: (B, 3) air velocity at the probes, m/s.
        push: (L, 3) other forces at the drag centres, N; None for none.

    Returns:
        New angles and velocities.

    """
    skeleton, drag = model.skeleton, model.drag
    # Half a step ahead: forces held over a step are those of its middle.
    rotation, position = pose_plain(model, angles + 0.5 * model.time_step * velocities)
    count = model.link_count
    spin, velocity = np.zeros((count, 3)), np.zeros((count, 3))
    force, moment = np.zeros((count, 3)), np.zeros((count, 3))
    mobility = drag_mobility(model)
    for link, parent in enumerate(skeleton.parent):
        rate = velocities[link] @ skeleton.axes[link]
        if parent >= 0:
            reach = skeleton.attach[link] * rotation[parent].apply(skeleton.vector[parent])
            spin[link] = spin[parent] + rotation[parent].apply(rate)
            velocity[link] = velocity[parent] + np.cross(spin[parent], reach)
        else:
            spin[link] = rate
        d = rotation[link].apply(skeleton.vector[link])
        centre_velocity = velocity[link] + drag.centre[link] * np.cross(spin[link], d)
        air = wind[model.link_probe[link]]
        speed = np.linalg.norm(air - centre_velocity)
        u = air - centre_velocity / (1.0 + model.time_step * mobility[link] * speed)
        xx, yy, zz, xy, xz, yz = drag.leaf[link]
        leaf = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ u
        across = u - d * (d @ u) / (d @ d)
        folded = float(reconfiguration(model.material, np.array([np.linalg.norm(air)]))[0])
        force[link] = speed * (folded * leaf + drag.wood[link] * across)
        if push is not None:
            force[link] += push[link]
        moment[link] = np.cross(position[link] + drag.centre[link] * d, force[link])
    coefficients = exact_step(model.stem_frequency, model.damping_ratio, model.time_step)[skeleton.stem]
    xx, xv, vx, vv = coefficients.T[:, :, None]
    torque = np.empty((count, 2))
    for link in range(count - 1, -1, -1):
        parent = skeleton.parent[link]
        about_joint = moment[link] - np.cross(position[link], force[link])
        in_parent = about_joint if parent < 0 else rotation[parent].inv().apply(about_joint)
        torque[link] = skeleton.axes[link] @ in_parent
        if parent >= 0:
            force[parent] += model.propagation[link] * force[link]
            moment[parent] += model.propagation[link] * moment[link]
    target = np.clip(model.rods.compliance * torque, -MAX_ANGLE, MAX_ANGLE)
    y = (angles - target) / np.maximum(np.linalg.norm(force, axis=1) * tension_per_force(model), 1.0)[:, None]
    moved = np.clip(angles - y + xx * y + xv * velocities, -2.0 * MAX_ANGLE, 2.0 * MAX_ANGLE)
    swung = vx * y + vv * velocities
    return moved, swung + modal_kick(model, moved - angles + y, swung)


def modal_kick(model: Model, deviation: Doubles, velocities: Doubles) -> Doubles:
    """(L, 2) what the modes change of the velocities, rad/s; see modal.py.

    Args:
        model: the plant's constants.
        deviation: (L, 2) angles less static angles, rad.
        velocities: (L, 2) rad/s.
    """
    modes, links = model.modes, model.modes.link
    gain, of_stiffness, of_damping = modes.gain.astype(np.float64)
    own = modes.own[:, None].astype(np.float64)
    kick = np.zeros_like(deviation)
    for joint, rate, quickening in (
        (deviation[links], own[..., 0], of_stiffness),
        (velocities[links], own[..., 1], of_damping),
    ):
        together, each = (np.einsum("kir,ki->r", modes.torque, part) for part in (joint, rate * joint))
        kick[links] -= modes.angle @ (quickening @ together - gain @ each)
        kick[links] += rate * (modes.angle @ (gain @ together))
    return modes.time_step * kick
