"""What of a plant is stepped: all its links, or some of them and groups of branches that move together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.motion.modal import Modes
from windswept.motion.model import Model
from windswept.motion.rods import Doubles
from windswept.motion.shapes import SHAPE_COUNT
from windswept.plants.plant import Floats, Ints, Material

GROUP_CONSTANT_COUNT = 40
"""Columns of ``Level.group_constants``; the kernel reads them by the numbers below."""
CENTRE, FORCE_LEAF, FORCE_WOOD, COUPLE, SWAY = 0, 3, 9, 15, 24
LEAF_FACTOR, WOOD_FACTOR, GROUP_MOBILITY, GROUP_STEP = 33, 34, 35, 36


@dataclass(frozen=True, slots=True)
class Level:
    """One simulation level of a plant with L links: A active links, G groups, B wind probes.

    A *group* is a set of branches on one link (or on the ground) that share one oscillator: a pressure vector u(t)
    in (m/s)^2, in the frame of the link that carries them, that follows the wind's pressure with the group's
    frequency and damping. Every joint of the group turns by its own static shape under u; see shapes.py.
    """

    material: Material
    time_step: float
    """s"""
    link: Ints
    """(A,) which link of the plant each active link is, ascending."""
    parent: Ints
    """(A,) active parent, -1 at a root."""
    depth: Ints
    """(A,) links between this one and the root."""
    constants: Floats
    """(A, CONSTANT_COUNT) see model.py."""
    probe: Ints
    """(A,) wind probe of each active link."""
    probe_position: Floats
    """(B, 3) m."""
    group_start: Ints
    """(A + 2,) groups on the ground are the range from [0] to [1], those on active link a from [a + 1] to [a + 2]."""
    group_constants: Floats
    """(G, GROUP_CONSTANT_COUNT) centre of pressure from the carrier's joint (3, m), drag tensors of leaves and of
    wood (6 each, like ``Drag.leaf``), couple and sway of the centre per pressure (3 x 3 each, row by row), factors
    of leaf and wood drag in the pressure, mobility, step (4)."""
    group_frequency: Doubles
    """(G,) angular frequency of each group's oscillator, rad/s."""
    group_probe: Ints
    """(G,) wind probe of each group."""
    group_first: Ints
    """(G,) first link of the plant that each group moves."""
    group_stop: Ints
    """(G,) end of the group's range of links."""
    shapes: Floats
    """(L, 2, 9) what each joint's angles are under its group's u, see shapes.py; all levels of a plant share it."""
    shape_limit: float
    """Pressure up to which the shapes hold, (m/s)^2; beyond it they go on in proportion."""
    modes: Modes
    """Of the whole plant, as far as active links take part."""
    coupled: bool = False
    """Whether links drive one another: stepped by `multibody` instead of `springs`."""

    @property
    def link_count(self) -> int:
        """Number of active links, A."""
        return len(self.link)

    @property
    def group_count(self) -> int:
        """Number of groups, G."""
        return len(self.group_probe)

    @property
    def moves(self) -> bool:
        """Whether wind moves anything of it: a plant that stands still is one group under no pressure."""
        return bool(self.link_count or self.group_constants.any())

    @property
    def groups_swing(self) -> bool:
        """Whether it has groups with inertia: who follows the wind at once has none, nor who stands still."""
        return bool(self.group_constants[:, GROUP_STEP : GROUP_STEP + 4].any())

    @property
    def listens(self) -> Ints:
        """(L,) what turns each joint of the plant: active link a >= 0, or group g as -1 - g."""
        what = np.empty(len(self.shapes), np.int32)
        what[self.link] = np.arange(self.link_count)
        sizes = self.group_stop - self.group_first
        within = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        groups = np.arange(self.group_count)
        what[np.repeat(self.group_first, sizes) + within] = np.repeat(-1 - groups, sizes)
        return what

    @property
    def group_carrier(self) -> Ints:
        """(G,) link of the plant that carries each group, -1 for the ground."""
        return np.repeat(np.append(-1, self.link), np.diff(self.group_start)).astype(np.int32)


def finest_level(model: Model) -> Level:
    """Level 0: every link is stepped."""
    count = model.link_count
    links = np.arange(count, dtype=np.int32)
    return Level(
        material=model.material,
        time_step=model.time_step,
        link=links,
        parent=model.skeleton.parent,
        depth=model.skeleton.depth,
        constants=model.constants,
        probe=model.link_probe,
        probe_position=model.probe_position,
        group_start=np.zeros(count + 2, np.int32),
        group_constants=np.zeros((0, GROUP_CONSTANT_COUNT), np.float32),
        group_frequency=np.zeros(0),
        group_probe=np.zeros(0, np.int32),
        group_first=np.zeros(0, np.int32),
        group_stop=np.zeros(0, np.int32),
        shapes=np.zeros((count, 2, SHAPE_COUNT), np.float32),
        shape_limit=1.0,
        modes=model.modes,
    )
