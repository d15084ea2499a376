"""CardMeadow: all underbrush of a scene in motion on the card, as ``scene.Meadow`` is on the CPU."""

from __future__ import annotations

from typing import Any

from windswept.gpu.blades.leaning import Leaning
from windswept.scene.meadow_air import MeadowAir
from windswept.scene.meadow_bed import Bed
from windswept.wind.field import Field
from windswept.wind.wind import Wind


class CardMeadow:
    """Blades of all beds.

    Args:
        device: the card.
        beds: as they were planted; their own states stay as they are.

    Raises:
        GraphicsError: the card has too little memory.
    """

    def __init__(self, device: Any, beds: tuple[Bed, ...]) -> None:
        self.beds = beds
        self._air = MeadowAir(beds)
        moving = [
            (blades, bed.air)
            for bed in beds
            for blades, state in zip(bed.blades, bed.states, strict=True)
            if state is not None
        ]
        self.leaning = Leaning(device, [blades for blades, _ in moving], [air for _, air in moving])
        self.stepped_count = sum(blades.count for blades, _ in moving)
        """Blades that are stepped."""

    @property
    def blade_count(self) -> int:
        """Blades of all beds."""
        return sum(bed.count for bed in self.beds)

    @property
    def clamped_count(self) -> int:
        """How often a blade felt a force that was no number or too large to be meant, read back."""
        return self.leaning.clamped_count

    def sample_air(self, wind: Wind, field: Field | None, time: float) -> None:
        """Sends the air and the pushes that blades feel until the next call, as ``MeadowAir.sample``."""
        self.leaning.write_air(*self._air.sample(wind, field, time))

    def step(self, count: int) -> None:
        """Takes ``count`` inner steps."""
        self.leaning.step(count)
