"""Simulation levels of detail: fewer and fewer oscillators move the same plant, each level with its error.

::

    Model --simplify--> Hierarchy     merge tree: which branches may move together, and with what error
    Hierarchy --build_ladder--> Ladder    a row of levels, from every link down to a plant that stands still
    (Ladder, Eye) --choose--> level of every placement
    (State, Level) --carry_over--> State at another level
"""

from windswept.levels.carry_over import carry_over, joint_motion_of
from windswept.levels.choose import Eye, choose, fill_registers
from windswept.levels.cut_level import cut_level
from windswept.levels.hierarchy import Hierarchy, simplify
from windswept.levels.ladder import Ladder, build_ladder
from windswept.levels.measure import measure, with_measured_errors

__all__ = [
    "Eye",
    "Hierarchy",
    "Ladder",
    "build_ladder",
    "carry_over",
    "choose",
    "cut_level",
    "fill_registers",
    "joint_motion_of",
    "measure",
    "simplify",
    "with_measured_errors",
]
