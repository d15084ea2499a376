"""Meadow: all underbrush of a scene in motion, stepped beside its trees."""

from __future__ import annotations

from collections.abc import Callable

from windswept.motion.blades import PackedField, step_in_field
from windswept.scene.meadow_air import MeadowAir
from windswept.scene.meadow_bed import Bed, Ground, plant_beds
from windswept.scene.scene import Scene
from windswept.scene.sight import sight_of
from windswept.wind.field import Field
from windswept.wind.wind import Wind


def plant_meadow(
    scene: Scene, picture_height: int = 720, say: Callable[[str], None] = lambda line: None
) -> tuple[Bed, ...]:
    """The underbrush of a scene, at rest; nothing where there is none.

    Args:
        scene: whose colonies to plant.
        picture_height: of the picture, pixels: blades that will be finer than a pixel are planted fewer and wider.
        say: told of every species before its tables are computed.
    """
    grid = None if scene.field is None else scene.field.grid
    sight = sight_of(scene.camera, scene.duration, picture_height)
    return plant_beds(scene.colonies, Ground(scene.terrain, grid, sight, scene.seed), say)


class Meadow:
    """Blades of all beds.

    Args:
        beds: as they were planted.
    """

    def __init__(self, beds: tuple[Bed, ...]) -> None:
        self.beds = beds
        self._air = MeadowAir(beds)
        self._felt: tuple[PackedField, ...] = ()

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
        """Takes the air and the pushes that blades feel until the next call, as ``MeadowAir.sample``."""
        self._felt = self._air.sample(wind, field, time)

    def step(self, count: int) -> None:
        """Takes ``count`` inner steps."""
        for bed in self.beds:
            for blades, state in zip(bed.blades, bed.states, strict=True):
                if state is not None:
                    step_in_field(blades, state, self._felt[bed.air], count)
