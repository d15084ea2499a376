"""What moves: joint angles and velocities of P placements of one plant at one simulation level."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from windswept.motion.lanes import WIDTH
from windswept.motion.level import Level
from windswept.plants.plant import Floats


@dataclass(slots=True)
class State:
    """Motion of P placements of one plant, at a level with A active links and G groups. Stepped in place."""

    joints: Floats
    """(T, A, 4, WIDTH) tiles of WIDTH placements: angle and velocity about axis 1, then axis 2; rad, rad/s."""
    groups: Floats
    """(T, G, 6, WIDTH) pressure u (3) of every group and its rate (3); (m/s)^2 and (m/s)^2/s."""
    placement_count: int
    """P; the last tile's spare lanes move unseen."""
    step_count: int = 0
    """Inner steps taken since rest."""

    def angles(self, placement: int) -> Floats:
        """(A, 2) joint angles of one placement, rad."""
        return self.joints[placement // WIDTH, :, ::2, placement % WIDTH]

    def velocities(self, placement: int) -> Floats:
        """(A, 2) joint velocities of one placement, rad/s."""
        return self.joints[placement // WIDTH, :, 1::2, placement % WIDTH]

    def pressures(self, placement: int) -> Floats:
        """(G, 2, 3) pressure of every group of one placement and its rate."""
        return self.groups[placement // WIDTH, :, :, placement % WIDTH].reshape(-1, 2, 3)

    @property
    def parts(self) -> tuple[Floats, ...]:
        """All arrays that move, tiles first and lanes last."""
        return self.joints, self.groups

    def first_tiles(self, count: int) -> State:
        """A view of the first tiles: stepping it steps this state."""
        return State(self.joints[:count], self.groups[:count], self.placement_count, self.step_count)

    def add_tile(self) -> None:
        """Makes room for WIDTH more placements, at rest."""
        self.joints, self.groups = with_tile(self.joints), with_tile(self.groups)


@dataclass(slots=True)
class CoupledState(State):
    """State at a coupled level, that also says how the links moved at the end of the last step."""

    carried: Floats = field(default_factory=lambda: np.zeros((0, 0, 6, WIDTH), np.float32))
    """(T, A, 6, WIDTH) velocity of every link's joint (m/s) and rate of its direction (1/s)."""

    @property
    def parts(self) -> tuple[Floats, ...]:
        """All arrays that move, tiles first and lanes last."""
        return self.joints, self.groups, self.carried

    def first_tiles(self, count: int) -> CoupledState:
        """A view of the first tiles: stepping it steps this state."""
        joints, groups, carried = (part[:count] for part in self.parts)
        return CoupledState(joints, groups, self.placement_count, self.step_count, carried)

    def add_tile(self) -> None:
        """Makes room for WIDTH more placements, at rest."""
        self.joints, self.groups, self.carried = (with_tile(part) for part in self.parts)


def with_tile(part: Floats) -> Floats:
    """(T + 1, ...) a part of a state and one tile at rest."""
    return np.concatenate([part, np.zeros((1, *part.shape[1:]), np.float32)])


def rest_state(level: Level, placement_count: int) -> State:
    """State of plants at rest, with what coupled links carry where the level is coupled.

    Args:
        level: what of the plant is stepped.
        placement_count: P.
    """
    tiles = -(-placement_count // WIDTH)
    joints = np.zeros((tiles, level.link_count, 4, WIDTH), np.float32)
    groups = np.zeros((tiles, level.group_count, 6, WIDTH), np.float32)
    if level.coupled:
        carried = np.zeros((tiles, level.link_count, 6, WIDTH), np.float32)
        return CoupledState(joints, groups, placement_count, 0, carried)
    return State(joints, groups, placement_count)
