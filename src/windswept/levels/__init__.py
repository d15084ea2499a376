"""Simulation levels of detail: fewer and fewer oscillators move the same plant, each level with its error.

::

    Model --simplify--> Hierarchy     merge tree: which branches may move together, and with what error
    Hierarchy --build_ladder--> Ladder    a row of levels, from every link down to a plant that stands still
    (Ladder, Eye) --choose--> level of every placement
    (State, Level) --carry_over--> State at another level
"""

from windswept.levels.carry_over import carry_over, joint_motion_of
from windswept.levels.choose import Eye, away_from, choose, fill_registers, outside_view, seen_distance
from windswept.levels.cut_level import cut_level
from windswept.levels.hierarchy import Hierarchy, simplify
from windswept.levels.ladder import Ladder, build_ladder
from windswept.levels.measure import bound_errors, measure, measured_ladder, with_measured_errors
from windswept.levels.near_cut import NodeBalls, near_cut, node_balls

__all__ = [
    "Eye",
    "Hierarchy",
    "Ladder",
    "NodeBalls",
    "away_from",
    "bound_errors",
    "build_ladder",
    "carry_over",
    "choose",
    "cut_level",
    "fill_registers",
    "joint_motion_of",
    "measure",
    "measured_ladder",
    "near_cut",
    "node_balls",
    "outside_view",
    "seen_distance",
    "simplify",
    "with_measured_errors",
]
