"""Meadow: all underbrush of a scene in motion, stepped beside its trees."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from windswept.motion.blades import PackedField, pack_field, step_in_field
from windswept.motion.blades.blades import PLACE
from windswept.plants.plant import Floats
from windswept.scene.meadow_bed import Bed, Ground, plant_beds
from windswept.scene.scene import Scene
from windswept.scene.sight import sight_of
from windswept.wind.field import Field
from windswept.wind.mean import profile_factor
from windswept.wind.velocity import velocity
from windswept.wind.wind import Wind

FINEST_CELL = 1.0
"""Edge of a cell of the wind's grid, m, unless the meadow is so wide that it would have more than MOST_CELLS a side."""
MOST_CELLS = 160
LAYERS = 8
"""Heights at which the wind is known, from the ground to the highest blade's middle."""
LOWEST_TOP = 0.5
"""m."""


class Meadow:
    """Blades of all beds.

    Args:
        scene: whose colonies to plant; there is at least one.
        picture_height: of the picture, pixels: blades that will be finer than a pixel are planted fewer and wider.
        say: told of every species before its tables are computed.
    """

    def __init__(
        self, scene: Scene, picture_height: int = 720, say: Callable[[str], None] = lambda line: None
    ) -> None:
        grid = None if scene.field is None else scene.field.grid
        sight = sight_of(scene.camera, scene.duration, picture_height)
        self.beds: tuple[Bed, ...] = plant_beds(
            scene.colonies, Ground(scene.terrain, grid, sight, scene.seed), say
        )
        self._wind_grid = WindGrid([bed for bed in self.beds if not bed.in_field])
        self._air: PackedField | None = None
        self._force: PackedField | None = None

    @property
    def blade_count(self) -> int:
        """Blades of all beds."""
        return sum(bed.count for bed in self.beds)

    @property
    def stepped_count(self) -> int:
        """Blades that are stepped."""
        return sum(state.count for bed in self.beds for state in bed.states if state is not None)

    @property
    def clamped_count(self) -> int:
        """How often a blade felt a force that was no number or too large to be meant."""
        return sum(state.clamped_count for bed in self.beds for state in bed.states if state is not None)

    def sample_air(self, wind: Wind, field: Field | None, time: float) -> None:
        """Takes the air and the pushes that blades feel until the next call.

        Args:
            wind: over the meadow.
            field: the scene's force field at ``time``; None where there is none.
            time: s.
        """
        self._air = self._wind_grid.packed(wind, time, self._air)
        if field is not None:
            grid = field.plan.grid
            self._force = pack_field(field.velocity, field.push, grid.origin, grid.cell, self._force)

    def step(self, count: int) -> None:
        """Takes ``count`` inner steps."""
        for bed in self.beds:
            air = self._force if bed.in_field else self._air
            assert air is not None
            for blades, state in zip(bed.blades, bed.states, strict=True):
                if state is not None:
                    step_in_field(blades, state, air, count)


class WindGrid:
    """The wind over some beds, as the blades' kernel reads it.

    Args:
        beds: blades to be covered.
    """

    def __init__(self, beds: list[Bed]) -> None:
        places = [blades.constants[:, PLACE : PLACE + 3] for bed in beds for blades in bed.blades]
        columns = [place.transpose(1, 0, 2).reshape(3, -1) for place in places] or [
            np.zeros((3, 1), np.float32)
        ]
        low = np.min([column.min(axis=1) for column in columns], axis=0)
        high = np.max([column.max(axis=1) for column in columns], axis=0)
        self._edge = max(FINEST_CELL, float((high - low)[:2].max()) / MOST_CELLS)
        self._layer = max(float(high[2]), LOWEST_TOP) / (LAYERS - 1)
        self._origin = float(low[0]), float(low[1])
        self._nodes = tuple(int(np.ceil(reach / self._edge)) + 2 for reach in (high - low)[:2])
        x, y = (
            origin + self._edge * np.arange(n) for origin, n in zip(self._origin, self._nodes, strict=True)
        )
        points = np.stack([*np.meshgrid(x, y, indexing="ij"), np.zeros(self._nodes)], axis=-1)
        self._points: Floats = points.reshape(-1, 3).astype(np.float32)

    def packed(self, wind: Wind, time: float, into: PackedField | None) -> PackedField:
        """The wind at a time, s; in the memory of ``into`` if given."""
        profile = wind.profile
        height = np.full(len(self._points), profile.reference_height, np.float32)
        # At its reference height the profile is 1.
        ambient = velocity(wind, self._points, height, time).reshape(*self._nodes, 1, 3)
        share = profile_factor(profile, self._layer * np.arange(LAYERS)).astype(np.float32)
        edges = self._edge, self._edge, self._layer
        return pack_field(ambient * share[:, None], None, self._origin, edges, into)
