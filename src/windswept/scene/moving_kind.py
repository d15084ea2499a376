"""All placements of one kind of plant in motion, each at the simulation level that the camera asks for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.levels import (
    Eye,
    Ladder,
    build_ladder,
    carry_over,
    choose,
    fill_registers,
    joint_motion_of,
    simplify,
)
from windswept.motion import Model, build_model, finest_level, pose_links, rest_state
from windswept.motion.lanes import WIDTH
from windswept.plants.plant import Floats, Plant
from windswept.plants.pose import Pose
from windswept.scene.level_set import LevelSet
from windswept.scene.scene import Placements
from windswept.scene.terrain import Terrain
from windswept.wind.wind import Wind

BLEND_TIME = 0.5
"""How long a placement takes from one level to another, s; it begins no other change meanwhile."""


@dataclass(frozen=True, slots=True)
class Blend:
    """A placement on its way from one level to another: both are simulated, and the joint angles blend."""

    source: int
    target: int
    start: float
    """s"""

    def weight(self, time: float) -> float:
        """Share of the target at a time, s: smooth in value and slope."""
        x = min(max((time - self.start) / BLEND_TIME, 0.0), 1.0)
        return x * x * (3.0 - 2.0 * x)


class MovingKind:
    """Motion of the P placements of one plant.

    Args:
        plant: that they share.
        placements: where they stand.
        terrain: they stand on.
        levels: whether they may be simulated at coarser levels than 0.
        ladder: of the plant; None builds it when it is needed.
    """

    def __init__(
        self,
        plant: Plant,
        placements: Placements,
        terrain: Terrain,
        levels: bool = False,
        ladder: Ladder | None = None,
    ) -> None:
        self.plant, self.placements = plant, placements
        self.model: Model = build_model(plant) if ladder is None else ladder.hierarchy.model
        self.ladder = build_ladder(simplify(self.model)) if levels and ladder is None else ladder
        rungs = (finest_level(self.model),) if self.ladder is None else self.ladder.levels
        everyone = np.arange(placements.count, dtype=np.int32)
        self.sets = [
            LevelSet(rung, placements, terrain, everyone[: 0 if k else None]) for k, rung in enumerate(rungs)
        ]
        self.at = np.zeros(placements.count, np.int32)
        """(P,) level of every placement, or the one it is blending to."""
        self.wanted = self.at.copy()
        """(P,) coarsest level that the camera allows each."""
        self.blends: dict[int, Blend] = {}
        self.radius = float(np.linalg.norm(plant.link_tip, axis=1).max())
        """Of a ball round the root that holds the plant, m."""

    @property
    def stepped_count(self) -> int:
        """Links and groups that are stepped, over all placements."""
        return sum(len(s.members) * (s.level.link_count + s.level.group_count) for s in self.sets)

    def change_levels(self, eye: Eye, time: float, at_once: bool = False) -> None:
        """Ends blends that are over and begins those that the camera asks for.

        Args:
            eye: who looks.
            time: now, s.
            at_once: without blending: for the first moment of a scene.
        """
        if self.ladder is None:
            return
        for placement, blend in list(self.blends.items()):
            if time >= blend.start + BLEND_TIME:
                self.sets[blend.source].remove(placement)
                del self.blends[placement]
        away = np.linalg.norm(self.placements.position - eye.position, axis=1) - self.radius
        self.wanted = choose(self.ladder, eye, np.maximum(away, 0.1), self.wanted)
        given = fill_registers(self.wanted)
        for changing in np.flatnonzero(given != self.at).tolist():
            if changing not in self.blends:
                self._go(changing, int(given[changing]), time, at_once)

    def _go(self, placement: int, target: int, time: float, at_once: bool) -> None:
        """Takes a placement into another level's set with the motion it has."""
        assert self.ladder is not None
        source = int(self.at[placement])
        leaving = self.sets[source]
        angles, velocities = joint_motion_of(
            self.model, leaving.level, leaving.state, leaving.slot(placement)
        )
        joints, groups = carry_over(self.ladder.hierarchy, angles, velocities, self.sets[target].level)
        self.sets[target].add(placement, joints, groups)
        self.at[placement] = target
        if at_once:
            leaving.remove(placement)
        else:
            self.blends[placement] = Blend(source, target, time)

    def sample_winds(self, wind: Wind, start: float, stop: float) -> None:
        """Samples the wind at both ends of an interval, s."""
        for level_set in self.sets:
            if level_set.members:
                level_set.sample_winds(wind, start, stop)

    def step(self, count: int, taken: int, interval: int) -> None:
        """Takes ``count`` inner steps of the interval, of which ``taken`` were taken before."""
        for level_set in self.sets:
            level_set.step(count, taken, interval)

    def pose(self, time: float, ahead: float) -> Pose:
        """Where every link of every placement is.

        Args:
            time: now, s.
            ahead: seconds since the last inner step.
        """
        link = np.empty((self.placements.count, self.model.link_count, 8), np.float32)
        for level_set in self.sets:
            if level_set.members:
                link[level_set.members] = pose_links(self.model, level_set.level, level_set.state, ahead).link
        if self.blends:
            link[list(self.blends)] = self._blended(time, ahead).link
        return Pose(link)

    def _blended(self, time: float, ahead: float) -> Pose:
        """Poses of the placements on their way, with the angles of both levels blended."""
        finest = finest_level(self.model)
        mixed = rest_state(finest, len(self.blends))
        for index, (placement, blend) in enumerate(self.blends.items()):
            share = blend.weight(time)
            tile, lane = divmod(index, WIDTH)
            for weight, rung in ((1.0 - share, blend.source), (share, blend.target)):
                level_set = self.sets[rung]
                angles, velocities = joint_motion_of(
                    self.model, level_set.level, level_set.state, level_set.slot(placement)
                )
                mixed.joints[tile, :, ::2, lane] += weight * (angles + ahead * velocities)
        return pose_links(self.model, finest, mixed)

    def wind_speeds(self) -> Floats:
        """(P,) mean wind speed in the crown of every placement, m/s."""
        speeds = np.zeros(self.placements.count, np.float32)
        for level_set in self.sets:
            if level_set.members and level_set.winds is not None:
                speeds[level_set.members] = np.linalg.norm(level_set.winds[1], axis=2).mean(axis=1)
        return speeds
