"""All placements of one kind of plant in motion, each at the simulation level that the camera asks for."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from windswept.levels import (
    Eye,
    Ladder,
    NodeBalls,
    build_ladder,
    carry_over,
    choose,
    fill_registers,
    joint_motion_of,
    measured_ladder,
    near_cut,
    node_balls,
    seen_distance,
    simplify,
)
from windswept.motion import Model, build_model, finest_level, pose_links, rest_state
from windswept.motion.lanes import WIDTH
from windswept.plants.plant import Floats, Plant
from windswept.plants.pose import Pose
from windswept.scene.level_set import LevelSet
from windswept.scene.probes import turn_about_z
from windswept.scene.scene import Placements
from windswept.scene.terrain import Terrain
from windswept.wind.field import Field
from windswept.wind.wind import Wind

BLEND_TIME = 0.5
"""How long a placement takes from one level to another, s; it begins no other change meanwhile."""
NEAR = 2.0
"""A plant whose ball is nearer than this many of its radii is cut branch by branch where that is cheaper: where it is
the only one of its kind at its level, and has a register of lanes to itself."""
NEAR_STEP = 0.1
"""A cut branch by branch is made anew when the eye has come or gone by this share of its distance."""
NEAR_GAIN = 0.8
"""It is used when it has at most this share of the oscillators of the shared level that the plant would have."""


@dataclass(frozen=True, slots=True)
class Blend:
    """A placement on its way from one level to another: both are simulated, and the joint angles blend."""

    source: LevelSet
    target: LevelSet
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
        multibody: whether those at level 0 are moved by `multibody`; a ladder that is given says so itself.
    """

    def __init__(
        self,
        plant: Plant,
        placements: Placements,
        terrain: Terrain,
        levels: bool = False,
        ladder: Ladder | None = None,
        multibody: bool = False,
    ) -> None:
        self.plant, self.placements = plant, placements
        self.model: Model = build_model(plant) if ladder is None else ladder.hierarchy.model
        if levels and ladder is None:
            ladder = measured_ladder(build_ladder(simplify(self.model), multibody))
        self.ladder = ladder
        self._finest = finest_level(self.model)
        rungs = (replace(self._finest, coupled=multibody),) if ladder is None else ladder.levels
        everyone = np.arange(placements.count, dtype=np.int32)
        self.sets = [
            LevelSet(self.model, rung, placements, terrain, everyone[: 0 if k else None])
            for k, rung in enumerate(rungs)
        ]
        """Placements by shared level."""
        self.near: dict[int, LevelSet] = {}
        """Placements that have a level of their own, cut branch by branch."""
        self.at = np.zeros(placements.count, np.int32)
        """(P,) shared level of every placement, or the one it is blending to; what it would be for one in ``near``."""
        self.wanted = self.at.copy()
        """(P,) coarsest level that the camera allows each."""
        self.blends: dict[int, Blend] = {}
        self.radius = float(np.linalg.norm(plant.link_tip, axis=1).max())
        """Of a ball round the root that holds the plant, m."""
        self._terrain = terrain
        self._balls: NodeBalls | None = None
        self._cut_from: dict[int, tuple[int, Floats, float]] = {}

    @property
    def live_sets(self) -> list[LevelSet]:
        """All sets that placements are simulated in, those that blends are leaving included."""
        own = {id(s): s for blend in self.blends.values() for s in (blend.source, blend.target)}
        own |= {id(s): s for s in (*self.sets, *self.near.values())}
        return [s for s in own.values() if s.members]

    @property
    def stepped_count(self) -> int:
        """Links and groups that are stepped, over all placements."""
        return sum(len(s.members) * s.oscillators for s in self.live_sets)

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
            if time >= blend.start + BLEND_TIME - 1e-9:
                blend.source.remove(placement)
                del self.blends[placement]
        away = seen_distance(eye, self.placements.position, self.radius)
        self.wanted = choose(self.ladder, eye, away, self.wanted)
        given = fill_registers(self.wanted)
        alone = np.bincount(given, minlength=len(self.sets)) == 1
        own = np.zeros(len(away), bool)
        own[list(self.near)] = True
        near = alone[given] & (away < NEAR * self.radius * np.where(own, 1.0 + eye.dead_band, 1.0))
        for placement in np.flatnonzero((given != self.at) | own | near).tolist():
            if placement not in self.blends:
                self._change(
                    placement, int(given[placement]), eye if near[placement] else None, time, at_once
                )

    def _change(self, placement: int, rung: int, near: Eye | None, time: float, at_once: bool) -> None:
        """Takes a placement to a shared level, or to one of its own where a near eye makes that cheaper."""
        leaving = self.near.get(placement, self.sets[self.at[placement]])
        self.at[placement] = rung
        target = self.sets[rung]
        if near is None:
            self._cut_from.pop(placement, None)
        elif self._stale(placement, rung, near):
            target = self._near_set(placement, rung, near) or target
        elif placement in self.near:
            return
        if target is leaving:
            return
        self.near.pop(placement, None)
        if target is not self.sets[rung]:
            self.near[placement] = target
        self._go(placement, leaving, target, time, at_once)

    def _stale(self, placement: int, rung: int, eye: Eye) -> bool:
        """Whether the eye has moved or zoomed so far that a placement's own cut, or lack of one, is out of date."""
        if placement not in self._cut_from:
            return True
        before_rung, before, pixel = self._cut_from[placement]
        distance = np.linalg.norm(self.placements.position[placement] - eye.position)
        moved = np.linalg.norm(before - eye.position) > NEAR_STEP * distance
        return bool(before_rung != rung or moved or abs(_pixel(eye) / pixel - 1.0) > NEAR_STEP)

    def _near_set(self, placement: int, rung: int, eye: Eye) -> LevelSet | None:
        """A set with a level cut for one placement, or None where that is not cheaper than its shared level."""
        assert self.ladder is not None
        if self._balls is None:
            self._balls = node_balls(self.ladder.hierarchy)
        self._cut_from[placement] = rung, np.array(eye.position, np.float32), _pixel(eye)
        towards = (eye.position - self.placements.position[placement])[None, None]
        seen_from = turn_about_z(towards, -self.placements.yaw[placement : placement + 1])[0, 0]
        own = LevelSet(
            self.model,
            near_cut(self.ladder, self._balls, eye, seen_from, self.sets[rung].level.coupled),
            self.placements,
            self._terrain,
            np.zeros(0, np.int32),
        )
        return own if own.oscillators <= NEAR_GAIN * self.sets[rung].oscillators else None

    def _go(self, placement: int, leaving: LevelSet, target: LevelSet, time: float, at_once: bool) -> None:
        """Takes a placement into another set with the motion it has."""
        assert self.ladder is not None
        angles, velocities = joint_motion_of(
            self.model, leaving.level, leaving.state, leaving.slot(placement)
        )
        target.add(placement, *carry_over(self.ladder.hierarchy, angles, velocities, target.level))
        if at_once:
            leaving.remove(placement)
        else:
            self.blends[placement] = Blend(leaving, target, time)

    def sample_winds(self, wind: Wind, start: float, stop: float) -> None:
        """Samples the wind at both ends of an interval, s."""
        for level_set in self.live_sets:
            level_set.sample_winds(wind, start, stop)

    def add_field(self, field: Field, end: int) -> None:
        """Adds a force field as it is at the beginning (0) or end (1) of the interval to the winds just sampled."""
        for level_set in self.live_sets:
            level_set.add_field(field, end)

    def step(self, count: int, taken: int, interval: int) -> None:
        """Takes ``count`` inner steps of the interval, of which ``taken`` were taken before."""
        for level_set in self.live_sets:
            level_set.step(count, taken, interval)

    def pose(self, time: float, ahead: float) -> Pose:
        """Where every link of every placement is.

        Args:
            time: now, s.
            ahead: seconds since the last inner step.
        """
        link = np.empty((self.placements.count, self.model.link_count, 8), np.float32)
        for level_set in self.live_sets:
            link[level_set.members] = pose_links(self.model, level_set.level, level_set.state, ahead).link
        if self.blends:
            link[list(self.blends)] = self._blended(time, ahead).link
        return Pose(link)

    def _blended(self, time: float, ahead: float) -> Pose:
        """Poses of the placements on their way, with the angles of both levels blended."""
        mixed = rest_state(self._finest, len(self.blends))
        for index, (placement, blend) in enumerate(self.blends.items()):
            share = blend.weight(time)
            tile, lane = divmod(index, WIDTH)
            for weight, one in ((1.0 - share, blend.source), (share, blend.target)):
                angles, velocities = joint_motion_of(self.model, one.level, one.state, one.slot(placement))
                mixed.joints[tile, :, ::2, lane] += weight * (angles + ahead * velocities)
        return pose_links(self.model, self._finest, mixed)

    def wind_speeds(self) -> Floats:
        """(P,) mean wind speed in the crown of every placement, m/s."""
        speeds = np.zeros(self.placements.count, np.float32)
        for level_set in self.live_sets:
            if level_set.winds is not None:
                speeds[level_set.members] = np.linalg.norm(level_set.winds[1], axis=2).mean(axis=1)
        return speeds


def _pixel(eye: Eye) -> float:
    """Error that may be seen at a metre's distance, m."""
    return float(eye.metres(np.ones(1))[0])
