"""What steady wind does to a plant: the static shapes that merged branches move in.

Under a uniform wind pressure p (the wind's speed squared and its direction, the same on the whole plant) every joint
turns by an angle that is linear in p, while it is small. The torque on a joint comes only from what lies beyond it,
so this *influence* is a constant of the link, the same whichever branches are merged: merging branches means letting
their joints listen to one shared pressure u(t) instead of each to an oscillator of its own. The quasi-static part of
the motion is then right by construction, however unlike in direction, length and stiffness the merged branches are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.motion import Model
from windswept.motion.rods import Doubles
from windswept.motion.sweeps import joint_motion, joint_torque
from windswept.plants.air import reconfiguration

REFERENCE_SPEED = 8.0
"""Wind speed whose leaf reconfiguration fixes the proportion of leaf to wood drag in the static shapes, m/s."""
_PAIRS = ((0, 3, 4), (3, 1, 5), (4, 5, 2))
"""Where row i, column j of a symmetric tensor stands in xx, yy, zz, xy, xz, yz."""


@dataclass(frozen=True, slots=True)
class Influence:
    """Static response of every link to a unit pressure vector on the whole plant; unit of pressure: (m/s)^2."""

    leaf_drag: Doubles
    """(L, 3, 3) drag tensor of each link's own leaves, before they fold, kg/m."""
    wood_drag: Doubles
    """(L, 3, 3) drag tensor of its wood, kg/m."""
    folded: float
    """Reconfiguration of the leaves in the wind that the static shapes are taken from."""
    angle: Doubles
    """(L, 2, 3) angle about each joint axis, rad s^2/m^2."""
    turn: Doubles
    """(L, 3, 3) rotation vector of each link, rad s^2/m^2."""
    displacement: Doubles
    """(L, 3, 3) displacement of each link's drag centre, s^2/m."""
    tip: Doubles
    """(L, 3, 3) displacement of each link's tip, s^2/m."""

    @property
    def drag(self) -> Doubles:
        """(L, 3, 3) force on each link's own leaves and wood per pressure, kg/m."""
        return self.folded * self.leaf_drag + self.wood_drag


def static_influence(model: Model) -> Influence:
    """Influence of a plant, by six walks over its links.

    Args:
        model: the plant at its finest level.
    """
    skeleton = model.skeleton
    tree = (skeleton.parent, 0, skeleton.attach, skeleton.vector, skeleton.axes)
    lever = model.drag.centre[:, None] * skeleton.vector
    leaf_drag = np.stack([model.drag.leaf[:, list(row)] for row in _PAIRS], axis=1)
    unit = skeleton.vector / skeleton.length[:, None]
    wood_drag = model.drag.wood[:, None, None] * (np.eye(3) - unit[:, :, None] * unit[:, None, :])
    folded = float(reconfiguration(model.material, np.array([REFERENCE_SPEED]))[0])
    drag = folded * leaf_drag + wood_drag
    count = model.link_count
    angle = np.empty((count, 2, 3))
    whole_turn, displacement, tip = (np.empty((count, 3, 3)) for _ in range(3))
    for axis in range(3):
        force = np.ascontiguousarray(drag[:, :, axis])
        torque = joint_torque(*tree, force.copy(), np.cross(lever, force))
        angle[:, :, axis] = torque * model.rods.compliance
        turn, base = joint_motion(*tree, np.ascontiguousarray(angle[:, :, axis]))
        whole_turn[:, :, axis] = turn
        displacement[:, :, axis] = base + np.cross(turn, lever)
        tip[:, :, axis] = base + np.cross(turn, skeleton.vector)
    return Influence(leaf_drag, wood_drag, folded, angle, whole_turn, displacement, tip)
