"""The constants of a plant as the multibody kernels read them, and those of the method.

Numba freezes what kernels read as globals into cached machine code: numbers of the method are passed as `Rules`
(rules.py), and who changes a column's number here must delete the kernels' ``__pycache__/*.nb?``.
"""

from __future__ import annotations

import numpy as np

from windswept.motion.level import Level
from windswept.motion.model import Model, joint_lag
from windswept.motion.multibody.held_mass import held_mass
from windswept.plants.plant import Floats

COLUMN_COUNT = 24
"""Columns of the packed constants; the kernels read them by the numbers below."""
AXIS_1, AXIS_2, DIRECTION, REACH, LEVER = 0, 3, 6, 9, 10
DRAG_LEAF, DRAG_WOOD, MASS, MOMENT, INERTIA = 11, 17, 18, 19, 20
STIFFNESS_1, STIFFNESS_2, LAG = 21, 22, 23

STOP_ANGLE, STOP_STIFFNESS = 1.5, 30.0
"""Where a joint's stop begins, rad, and how much stiffer it is than the wood, which has long left the linear law."""
STOP_EDGE = 1.5001
"""Where a joint that was free when a step began stands at most when it ends, rad: a hair within its stop.

A stop acts in steps that begin in it, so what a joint enters deeper by in its first step would be energy for nothing.
"""
MOST_ANGLE = 2.0
"""No joint goes further, rad. One that would keeps its rate, and its links what they carry: its springs alone store
less than they were given, so energy falls."""
PULL_KNEE = 4.0
"""Inertia that the air's pull stiffens a link by in a step, over the link's own, at which half as much is added again.

Once is what the trapezoidal rule asks for; but a pull that is all that holds a link then flips it from side to side for
ever, as the rule does with any stiff spring, while at twice the flip dies by an eighth a step. In gentle air nothing is
added: the second share goes with the fourth power of the step.
"""
REST_THRESHOLD = 1e-9
"""Angles, rates and velocities below this are put to rest: dying motion must not end in denormals."""
SETTLING = 38.0
"""Times the step, to the fourth: how far beyond a step's middle forces are taken, as a share of the step, half at most.

Links then forget what they carry that no motion of their joints accounts for. It damps every mode too: with e that
share and h the step, a mode of angular frequency w keeps exp(-2 w^2 e h t) of its energy, as with a damping ratio of
w e h: 0.05 % at 1 Hz and 120 steps a second, where e is a hundredth, and 0.26 % at 5 Hz. That is little beside the
wood's own and the air's, but in a plant without both it is all the damping there is.
"""
RATE_LEAD = 0.5
"""How far a joint's rate goes on from the middle of a step, as a share of what it gained up to there.

At 1, as the trapezoidal rule has it, the rates of stiff joints flip sign from step to step for ever, and with them
the pose that the next step is reckoned in. Rates are that guess alone: angles and carried velocities move by the rates
at the middle, and without air the energy does not depend on the guess. At 0.5 they lag behind the links' true motion
by a sixth of a step's acceleration.
"""
MOST_WARPED = 2.0
"""Angle of a plant's first mode in a step, rad, beyond which its frequency is no longer kept (Nyquist is pi)."""


def warped_step(model: Model) -> float:
    """The step to reckon with so that the plant's first mode turns by its true angle in ``time_step``, s.

    The trapezoidal rule turns a mode by 2 atan(omega H / 2) in a step H: too slow by (omega h)^2 / 12. With
    H = (2 / omega) tan(omega h / 2) the first mode is exact and all above it are nearer to the truth.
    """
    frequency = model.stem_frequency[model.skeleton.stem[model.skeleton.parent < 0]].min()
    angle = min(frequency * model.time_step, MOST_WARPED)
    return float(model.time_step * np.tan(0.5 * angle) / (0.5 * angle))


def forces_at(model: Model) -> float:
    """How far into a step forces are taken, s: a hair beyond its middle, which keeps the energy exactly."""
    return warped_step(model) * (0.5 + min((SETTLING * model.time_step) ** 4, 0.5))


def pack_multibody(model: Model) -> Floats:
    """(L, COLUMN_COUNT) joint axes and link direction at rest, distance from the parent's joint (m), distance of the
    drag centre (m), drag tensor of leaves and coefficient of wood (kg/m), mass (kg), first moment (kg m), inertia
    across the link through its joint (kg m^2), stiffness of both springs (N m/rad), damping over stiffness (s).
    """
    skeleton, rods, drag = model.skeleton, model.rods, model.drag
    inner = skeleton.parent >= 0
    packed = np.zeros((model.link_count, COLUMN_COUNT), np.float32)
    packed[:, AXIS_1 : AXIS_1 + 3] = skeleton.axes[:, 0]
    packed[:, AXIS_2 : AXIS_2 + 3] = skeleton.axes[:, 1]
    packed[:, DIRECTION : DIRECTION + 3] = skeleton.vector / skeleton.length[:, None]
    packed[inner, REACH] = (skeleton.attach * skeleton.length[skeleton.parent])[inner]
    packed[:, LEVER] = drag.centre * skeleton.length
    packed[:, DRAG_LEAF : DRAG_LEAF + 6] = drag.leaf
    packed[:, DRAG_WOOD] = drag.wood
    packed[:, MASS] = rods.mass
    packed[:, MOMENT] = rods.moment * skeleton.length
    packed[:, INERTIA] = rods.inertia
    packed[:, STIFFNESS_1 : STIFFNESS_2 + 1] = 1.0 / rods.compliance
    packed[:, LAG] = joint_lag(model)
    return packed


def pack_level(model: Model, level: Level) -> Floats:
    """(A, COLUMN_COUNT) the same for the active links of a level, with the mass of the groups that they hold."""
    packed = pack_multibody(model)[level.link]
    packed[:, (MASS, MOMENT, INERTIA)] += held_mass(model, level)
    return packed
