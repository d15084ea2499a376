"""GpuSimulation: a scene in motion on the card, as ``scene.Simulation`` is on the CPU."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.gpu import layouts
from windswept.gpu.blades import CardMeadow
from windswept.gpu.device import shared_device
from windswept.gpu.failures import card_errors
from windswept.gpu.frame import CardMotion
from windswept.gpu.seating import Seating
from windswept.gpu.springs.air import air_rows
from windswept.gpu.springs.card_field import CardField
from windswept.gpu.springs.card_state import CardState
from windswept.gpu.springs.kinds import GrownKind
from windswept.gpu.springs.pose_seats import seats_for_all
from windswept.gpu.springs.rung_arrays import rung_arrays
from windswept.gpu.springs.seats import first_seats
from windswept.gpu.springs.turns import check_walked_whole, steps_in_turns
from windswept.gpu.springs.walk import TURNS_PER_LINK, WHOLE_TURNS, Walk
from windswept.levels import Eye, outside_view
from windswept.motion import TIME_STEP
from windswept.plants.plant import Floats, Ints
from windswept.plants.pose import Pose
from windswept.scene.eye_at import eye_at
from windswept.scene.meadow_bed import Bed
from windswept.scene.moving_kind import BLEND_TIME
from windswept.scene.scene import Scene
from windswept.scene.simulation import WIND_INTERVAL
from windswept.wind.field import start_field, step_field

Stage = Callable[[Any], None]
"""Records its part into a command encoder."""


class GpuSimulation:
    """Runs a scene on the card; the same whatever the frame rate. Nothing is read back but where it says so.

    Args:
        scene: what stands where, in which wind.
        kinds: its plants, grown and compiled; of levels with coupled links, which need ``CoupledSimulation``, none.
        pixels: error that may be seen, at ``picture_height``.
        picture_height: of the picture, pixels.
        room: bytes that a buffer may have; None for what the adapter takes.
        beds: its underbrush, planted.
        aspect: width of the picture over its height.

    Raises:
        GraphicsError: no adapter, or one with too little memory.
    """

    def __init__(
        self,
        scene: Scene,
        kinds: list[GrownKind],
        pixels: float = 1.0,
        picture_height: int = 720,
        room: int | None = None,
        beds: tuple[Bed, ...] = (),
        aspect: float = 16.0 / 9.0,
    ) -> None:
        self.scene, self.kinds = scene, kinds
        self.wind = scene.wind
        """May be replaced while the simulation runs."""
        self.eye: Eye | None = None
        """Who looks; None for the scene's own camera. Of its measures, the card knows ``outside_view``."""
        self.time = 0.0
        """Seconds since rest."""
        self.step_count = 0
        """Inner steps taken since rest."""
        self._ladders = any(kind.ladder for kind in kinds)
        self._pixels, self._picture_height, self._aspect = pixels, picture_height, aspect
        self._device = shared_device()
        limit = self._device.limits["max-storage-buffer-binding-size"]
        self._arrays = rung_arrays(kinds, limit if room is None else min(room, limit))
        check_walked_whole(self._device, self._arrays.rungs, WHOLE_TURNS)
        self.steps_at_once = steps_in_turns(self._device, self._arrays.rungs, TURNS_PER_LINK)
        """Inner steps that one submission takes, at most."""
        seats = first_seats(kinds, self._arrays, self._eye_now())
        self.field = None if scene.field is None else start_field(scene.field, scene.wind)
        """The scene's force field, on the CPU; None where there is none."""
        self.meadow = CardMeadow(self._device, beds) if beds else None
        """The scene's underbrush; None where there is none."""
        with card_errors("the plants' motion"):
            self.card = CardState(self._device, self._arrays, seats, scene.terrain.heights)
            self._card_field = CardField(self._device, self.field if kinds else None)
            self.card.resources |= self._card_field.resources
            self._walk = self._new_walk()
            self.card.write_moment(self._moment(0, 0))
            self._write_wind()
            self._record(self._walk.plan, self._walk.sample_wind)

    def advance(self, seconds: float) -> GpuSimulation:
        """Lets ``seconds`` pass: as many fixed inner steps as fit.

        Raises:
            GraphicsError: the card was lost.
        """
        self.time += seconds
        # A frame rate's rounding must not lose a step that is due.
        due = math.floor(self.time / TIME_STEP + 1e-6)
        with card_errors("stepping plants"):
            while self.step_count < due:
                taken = self.step_count % WIND_INTERVAL
                count = min(due - self.step_count, WIND_INTERVAL - taken, self.steps_at_once)
                self.card.write_moment(self._moment(taken, taken + count))
                self._record(
                    *(self._begin_interval() if taken == 0 and self.step_count else ()), self._walk.step
                )
                if self.meadow is not None:
                    self.meadow.step(count)
                self.step_count += count
        return self

    def motion(self) -> CardMotion:
        """How all placements move now, for a ``Frame`` to pose whom it draws: valid until the simulation advances."""
        with card_errors("posing plants"):
            self.card.write_moment(self._moment(0, 0))
        return CardMotion(self._walk.pose, self.card.resources["speeds"])

    @property
    def pose(self) -> list[Pose]:
        """Where every link of every kind is at this moment, read back."""
        motion = self.motion()
        with card_errors("posing plants"):
            self._record(lambda encoder: motion.pose(encoder, self._seats_for_all))
            data = self._device.queue.read_buffer(self._seats_for_all.poses)
        rows = np.frombuffer(data, np.float32).reshape(-1, 8)
        poses, first = [], 0
        for kind in self.kinds:
            shape = (kind.placements.count, kind.model.link_count, 8)
            size = shape[0] * shape[1]
            poses.append(Pose(rows[first : first + size].reshape(shape)))
            first += size
        return poses

    @cached_property
    def _seats_for_all(self) -> Seating:
        return seats_for_all(self._device, self.kinds)

    @property
    def wind_speeds(self) -> list[Floats]:
        """(P,) mean wind speed in the crown of every placement, m/s, kind by kind, read back."""
        speeds = self.card.read("speeds", "<f4")[: len(self._arrays.rooted)]
        return self._by_kind(speeds)

    @property
    def levels_now(self) -> list[Ints]:
        """(P,) level of every placement, or the one it is blending to, kind by kind, read back."""
        at = self.card.read("motions", layouts.MOTION)["at"][: len(self._arrays.rooted), 0]
        place = self._arrays.rungs["groups"][at, 3].astype(np.int32)
        return self._by_kind(place)

    @property
    def placements_by_level(self) -> list[int]:
        """How many placements are at each level, over all kinds, read back."""
        return np.bincount(np.concatenate([np.zeros(0, np.int32), *self.levels_now])).tolist()

    @property
    def stepped_count(self) -> int:
        """Links and groups that are stepped, over all placements, read back."""
        rungs = self._arrays.rungs
        oscillators = rungs["links"][:, 1].astype(np.int64) + rungs["groups"][:, 1]
        return int((self.card.read("populations", "<u4") * oscillators).sum())

    @property
    def refused_count(self) -> int:
        """Placements that had to stay at their level for want of room, the last time levels changed; read back."""
        return int(self.card.read("tally", "<u4")[2])

    @property
    def clamped_count(self) -> int:
        """As of ``scene.Simulation``, read back."""
        held = 0 if self.field is None else self.field.clamps.total
        return held + (0 if self.meadow is None else self.meadow.clamped_count)

    @property
    def link_count(self) -> int:
        """Links of all placements."""
        return self._arrays.pose_rows

    @property
    def stage_milliseconds(self) -> dict[str, float]:
        """How long each stage took on the card when it last ran; empty on a card without a clock."""
        blades = {} if self.meadow is None else self.meadow.leaning.times.read()
        return self._walk.times.read() | blades

    def _by_kind(self, values: NDArray[Any]) -> list[NDArray[Any]]:
        """(P,) values of all placements, kind by kind."""
        firsts = self._arrays.kinds["ladder"][:, 2]
        return np.split(values, firsts)[1:]

    def _new_walk(self) -> Walk:
        """The kernels, over what is on the card."""
        assert not self._arrays.coupled.any()
        return Walk(self._device, self.card, len(self._arrays.rungs), len(self._arrays.rooted))

    def _begin_interval(self) -> list[Stage]:
        """What comes before the steps of an interval: changes of level, then the winds at both ends."""
        self._write_wind()
        return [*([self._walk.change_levels] if self._ladders else []), self._walk.sample_wind]

    def _write_wind(self) -> None:
        """Tells the card of the wind, and what the force field makes of it, in the interval that begins now."""
        start, stop = self.step_count * TIME_STEP, (self.step_count + WIND_INTERVAL) * TIME_STEP
        if self.card.write_air(air_rows(self.wind, self.scene.terrain, start, stop)):
            self._walk.rebind_wind()
        if self.field is not None:
            self.field.wind = self.wind
            step_field(self.field, stop - self.field.time)
            if self.kinds:
                self._card_field.advance(self.field)
        if self.meadow is not None:
            self.meadow.sample_air(self.wind, self.field, stop)

    def _record(self, *stages: Stage) -> None:
        """Hands stages to the card."""
        encoder = self._device.create_command_encoder()
        for stage in stages:
            stage(encoder)
        self._device.queue.submit([encoder.finish()])

    def _eye_now(self) -> Eye:
        """Who looks at this moment."""
        return self.eye or eye_at(
            self.scene.camera,
            self.step_count * TIME_STEP,
            self._picture_height,
            self._aspect,
            self._pixels,
        )

    def _moment(self, first: int, end: int) -> NDArray[np.void]:
        """``MOMENT``, with the inner steps of the interval that are to be taken."""
        eye = self._eye_now()
        row = np.zeros(1, layouts.MOMENT)
        row["eye"] = *eye.position, float(eye.metres(np.ones(1))[0])
        if eye.forward is not None and outside_view in eye.measures:
            corner = math.atan(math.tan(0.5 * eye.fov_y) * math.hypot(1.0, eye.aspect))
            row["view"] = *eye.forward, corner
        row["time"] = 1.0 + eye.dead_band, self.time - self.step_count * TIME_STEP, TIME_STEP, 0.0
        row["steps"] = self.step_count, first, end, WIND_INTERVAL
        blend = round(BLEND_TIME / TIME_STEP)
        row["counts"] = len(self._arrays.rungs), len(self.kinds), len(self._arrays.rooted), blend
        return row
