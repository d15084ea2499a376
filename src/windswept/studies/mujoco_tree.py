"""The same rods as a MuJoCo model: explicit inertials, two hinges a joint, no gravity, no contacts.

Two hinges in series turn a link by one axis after the other; a joint of ours turns by one rotation vector and never
twists. The two part with the product of both angles: at the same angles, tips of a limp tree of 1,000 links in a gusty
7 m/s are 1.1 % of their motion apart, most of what separates `multibody` from MuJoCo there.
"""

from __future__ import annotations

import mujoco
import numpy as np

from windswept.motion.model import Model
from windswept.plants.air import reconfiguration


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


class MujocoPlant:
    """A plant in MuJoCo, blown at by our drag.

    Args:
        model: the plant's constants.
        time_step: MuJoCo's own, s.
    """

    def __init__(self, model: Model, time_step: float) -> None:
        self.model = model
        self.tree = mujoco_tree(model, time_step)
        self.data = mujoco.MjData(self.tree)
        mujoco.mj_forward(self.tree, self.data)
        skeleton, drag = model.skeleton, model.drag
        self._order = np.array([self._site_body(link) for link in range(model.link_count)])
        self._lever = (drag.centre * skeleton.length)[:, None]
        xx, yy, zz, xy, xz, yz = drag.leaf.T
        self._leaf = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)

    def _site_body(self, link: int) -> int:
        return int(self.tree.site(f"tip{link}").bodyid[0])

    def _rotated(self, vector: np.ndarray) -> np.ndarray:
        """(L, 3) vectors of the links, turned as their bodies are."""
        matrix = self.data.xmat[self._order].reshape(-1, 3, 3)
        return np.einsum("lij,lj->li", matrix, vector)

    def tips(self) -> np.ndarray:
        """(L, 3) far end of every link, m."""
        return self.data.xpos[self._order] + self._rotated(self.model.skeleton.vector)

    def step(self, wind: np.ndarray) -> None:
        """One step of MuJoCo in (B, 3) air velocities at the probes, m/s."""
        skeleton, data = self.model.skeleton, self.data
        direction = self._rotated(skeleton.vector) / skeleton.length[:, None]
        centre = data.xpos[self._order] + self._lever * direction
        spin, at = data.cvel[self._order, :3], data.subtree_com[self.tree.body_rootid[self._order]]
        velocity = data.cvel[self._order, 3:] + np.cross(spin, centre - at)
        air = wind[self.model.link_probe]
        folded = reconfiguration(self.model.material, np.linalg.norm(air, axis=1)).astype(np.float64)
        u = air - velocity
        speed = np.linalg.norm(u, axis=1)[:, None]
        across = u - direction * np.sum(direction * u, axis=1)[:, None]
        leaf = np.einsum("lij,lj->li", self._leaf, u)
        force = speed * (folded[:, None] * leaf + self.model.drag.wood[:, None] * across)
        data.xfrc_applied[self._order, :3] = force
        data.xfrc_applied[self._order, 3:] = np.cross(centre - data.xipos[self._order], force)
        mujoco.mj_step(self.tree, data)
