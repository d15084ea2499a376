"""The same rods as a MuJoCo model: explicit inertials, two hinges a joint, no gravity, no contacts."""

from __future__ import annotations

import mujoco
import numpy as np

from windswept.motion.model import Model


def mujoco_tree(model: Model, time_step: float | None = None) -> mujoco.MjModel:
    """MuJoCo's model of a plant; sites ``tip<link>`` and ``centre<link>`` mark link ends and drag centres.

    Args:
        model: the plant's constants.
        time_step: s; None for the model's own.
    """
    skeleton, rods = model.skeleton, model.rods
    stiffness = 1.0 / rods.compliance
    damping = 2.0 * stiffness * (model.damping_ratio / model.stem_frequency)[skeleton.stem][:, None]
    children: list[list[int]] = [[] for _ in range(model.link_count)]
    roots: list[int] = []
    for link, parent in enumerate(skeleton.parent):
        (roots if parent < 0 else children[parent]).append(link)

    def numbers(values: np.ndarray) -> str:
        return " ".join(f"{v:.9g}" for v in values)

    def body(link: int) -> str:
        parent, d = skeleton.parent[link], skeleton.vector[link]
        at = skeleton.base[link] if parent < 0 else skeleton.attach[link] * skeleton.vector[parent]
        mass, fraction = rods.mass[link], rods.moment[link] / rods.mass[link]
        across = rods.inertia[link] - rods.mass[link] * fraction**2 * (d @ d)
        unit = d / np.linalg.norm(d)
        thin = 1e-3 * across + 1e-12
        tensor = across * (np.eye(3) - np.outer(unit, unit)) + thin * np.outer(unit, unit)
        full = numbers(tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]])
        hinges = "".join(
            f'<joint type="hinge" axis="{numbers(skeleton.axes[link, k])}" '
            f'stiffness="{stiffness[link, k]:.9g}" damping="{damping[link, k]:.9g}"/>'
            for k in range(2)
        )
        inner = "".join(body(child) for child in children[link])
        return (
            f'<body pos="{numbers(at)}">{hinges}<inertial pos="{numbers(fraction * d)}" mass="{mass:.9g}" '
            f'fullinertia="{full}"/><site name="centre{link}" pos="{numbers(model.drag.centre[link] * d)}"/>'
            f'<site name="tip{link}" pos="{numbers(d)}"/>{inner}</body>'
        )

    step = model.time_step if time_step is None else time_step
    xml = (
        f'<mujoco><compiler balanceinertia="true" boundmass="1e-9" boundinertia="1e-15"/>'
        f'<option gravity="0 0 0" timestep="{step}" integrator="Euler"><flag contact="disable"/></option>'
        f"<worldbody>{''.join(body(r) for r in roots)}</worldbody></mujoco>"
    )
    return mujoco.MjModel.from_xml_string(xml)


def mujoco_frequencies(tree: mujoco.MjModel) -> np.ndarray:
    """Natural frequencies in Hz from MuJoCo's own mass matrix and the hinges' stiffness."""
    data = mujoco.MjData(tree)
    mujoco.mj_forward(tree, data)
    mass = np.zeros((tree.nv, tree.nv))
    mujoco.mj_fullM(tree, data, mass)
    root = 1.0 / np.sqrt(tree.jnt_stiffness)
    values = np.linalg.eigvalsh(root[:, None] * mass * root[None, :])
    return np.sort(1.0 / np.sqrt(values)) / (2.0 * np.pi)
