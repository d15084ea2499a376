"""A scene in motion: every kind of plant stepped in one wind, at the levels that the camera asks for."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from windswept.errors import InputError
from windswept.forms.words import shown
from windswept.levels import Eye
from windswept.motion import TIME_STEP
from windswept.plants.plant import Floats, Plant
from windswept.plants.pose import Pose
from windswept.scene.eye_at import eye_at
from windswept.scene.grow_kinds import grow_kinds
from windswept.scene.meadow import Meadow, plant_meadow
from windswept.scene.meadow_bed import Bed
from windswept.scene.moving_kind import MovingKind
from windswept.scene.scene import Scene
from windswept.wind.field import Field, start_field, step_field

WIND_INTERVAL = 4
"""Inner steps between two samples of the wind: 30 a second; in between it changes linearly."""


class Simulation:
    """Runs a scene; the same whatever the frame rate.

    Args:
        scene: what stands where, in which wind.
        plants: one for each of the scene's kinds; None grows them.
        levels: whether plants far from the camera are simulated at coarser levels.
        pixels: error that may be seen when they are, at ``picture_height``.
        picture_height: of the picture, pixels.
        say: told of each plant that is grown and compiled.
        multibody: whether plants at level 0 are moved by `multibody`; with levels it is the first of them, and
            errors are against it.
        beds: the scene's underbrush at rest; None plants it.
        aspect: width of the picture over its height.

    Raises:
        InputError: no scene, not a plant for each kind, or a number that is not above 0.
    """

    def __init__(
        self,
        scene: Scene,
        plants: list[Plant] | None = None,
        levels: bool = False,
        pixels: float = 1.0,
        picture_height: int = 720,
        say: Callable[[str], None] = lambda line: None,
        multibody: bool = False,
        beds: tuple[Bed, ...] | None = None,
        aspect: float = 16.0 / 9.0,
    ) -> None:
        _check_arguments(scene, plants, pixels, picture_height, aspect)
        self.scene = scene
        self.wind = scene.wind
        """May be replaced while the simulation runs, as the viewer's sliders do."""
        self.eye: Eye | None = None
        """Who looks; None for the scene's own camera."""
        self._pixels, self._picture_height, self._aspect = pixels, picture_height, aspect
        grown = grow_kinds(scene, say) if plants is None else plants
        self.kinds = [
            MovingKind(plant, placements, scene.terrain, levels, multibody=multibody)
            for plant, placements in zip(grown, scene.placements, strict=True)
        ]
        planted = plant_meadow(scene, picture_height, say) if beds is None else beds
        self.meadow = Meadow(planted) if planted else None
        """The scene's underbrush; None where there is none."""
        self.field = None if scene.field is None else start_field(scene.field, scene.wind)
        """The scene's force field; None where there is none."""
        self.time = 0.0
        """Seconds since rest."""
        self.step_count = 0
        """Inner steps taken since rest."""
        self.change_levels(at_once=True)
        self._sample_winds()

    def advance(self, seconds: float) -> Simulation:
        """Lets ``seconds`` pass: as many fixed inner steps as fit.

        Raises:
            InputError: a time that is below 0 s, or not finite.
        """
        if not 0.0 <= seconds < math.inf:
            raise InputError("advance", "seconds", seconds, "a time of 0 s or more")
        self.time += seconds
        # A frame rate's rounding must not lose a step that is due.
        due = math.floor(self.time / TIME_STEP + 1e-6)
        while self.step_count < due:
            taken = self.step_count % WIND_INTERVAL
            if taken == 0 and self.step_count:
                self.change_levels()
                self._sample_winds()
            count = min(due - self.step_count, WIND_INTERVAL - taken)
            for kind in self.kinds:
                kind.step(count, taken, WIND_INTERVAL)
            if self.meadow is not None:
                self.meadow.step(count)
            self.step_count += count
        return self

    @property
    def pose(self) -> list[Pose]:
        """Where every link is at this moment, in the plants' own frames: ``pose[k]`` is of ``scene.kinds[k]``.

        Underbrush is no kind and has no poses here; `world_links` gives places in the world.
        """
        ahead = self.time - self.step_count * TIME_STEP
        return [kind.pose(self.time, ahead) for kind in self.kinds]

    @property
    def wind_speeds(self) -> list[Floats]:
        """(P,) mean wind speed in the crown of every placement, m/s, kind by kind."""
        return [kind.wind_speeds() for kind in self.kinds]

    @property
    def link_count(self) -> int:
        """Links of all placements."""
        return sum(kind.model.link_count * kind.placements.count for kind in self.kinds)

    @property
    def stepped_count(self) -> int:
        """Links and groups that are stepped, over all placements."""
        return sum(kind.stepped_count for kind in self.kinds)

    @property
    def clamped_count(self) -> int:
        """How often a force or speed that was no number, or too large to be meant, had to be held back."""
        held = 0 if self.field is None else self.field.clamps.total
        return held + (0 if self.meadow is None else self.meadow.clamped_count)

    @property
    def placements_by_level(self) -> list[int]:
        """How many placements are at each level, over all kinds."""
        everyone = [kind.at for kind in self.kinds]
        return np.bincount(np.concatenate([np.zeros(0, np.int32), *everyone])).tolist()

    def change_levels(self, at_once: bool = False) -> None:
        """Lets every placement go to the level that the camera asks for."""
        now = self.step_count * TIME_STEP
        eye = self.eye or eye_at(self.scene.camera, now, self._picture_height, self._aspect, self._pixels)
        for kind in self.kinds:
            kind.change_levels(eye, now, at_once)

    def _sample_winds(self) -> None:
        """Winds at both ends of the interval that begins now."""
        start, stop = self.step_count * TIME_STEP, (self.step_count + WIND_INTERVAL) * TIME_STEP
        for kind in self.kinds:
            kind.sample_winds(self.wind, start, stop)
        if self.field is not None:
            self._advance_field(self.field, stop)
        if self.meadow is not None:
            self.meadow.sample_air(self.wind, self.field, stop)

    def _advance_field(self, field: Field, stop: float) -> None:
        """Adds what the field makes of the wind at both ends of the interval that ends at ``stop``, s."""
        for kind in self.kinds:
            kind.add_field(field, 0)
        field.wind = self.wind
        step_field(field, stop - field.time)
        for kind in self.kinds:
            kind.add_field(field, 1)


def _check_arguments(
    scene: Scene, plants: list[Plant] | None, pixels: float, picture_height: int, aspect: float
) -> None:
    """Refuses what a simulation cannot start from."""
    if not isinstance(scene, Scene):
        raise InputError("Simulation", "scene", shown(scene), "a Scene, as load_scene gives it")
    if plants is not None and len(plants) != len(scene.kinds):
        expected = f"one for each of the scene's {len(scene.kinds)} kinds, or None"
        raise InputError("Simulation", "plants", f"{len(plants)} plants", expected)
    numbers = {"pixels": pixels, "picture_height": picture_height, "aspect": aspect}
    for name, value in numbers.items():
        if not 0.0 < value < math.inf:
            raise InputError("Simulation", name, value, "a finite number above 0")
