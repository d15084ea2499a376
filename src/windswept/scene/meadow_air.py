"""MeadowAir: the air that the blades of a meadow feel, sampled once an interval of the wind."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from windswept.motion.blades import PackedField, pack_field
from windswept.motion.blades.blades import PLACE
from windswept.plants.plant import Floats
from windswept.scene.meadow_bed import Bed
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


class MeadowAir:
    """The wind over the beds outside the scene's force field, and the field.

    Args:
        beds: of the meadow.
    """

    def __init__(self, beds: Sequence[Bed]) -> None:
        self._grid = WindGrid([bed for bed in beds if not bed.in_field])
        self._in_field = any(bed.in_field for bed in beds)
        self._wind: PackedField | None = None
        self._force: PackedField | None = None

    def sample(self, wind: Wind, field: Field | None, time: float) -> tuple[PackedField, ...]:
        """The wind's air, then that of the field with its pushes if a bed stands in it: each feels ``bed.air`` of them.

        Args:
            wind: over the meadow.
            field: the scene's force field at ``time``; None where there is none.
            time: s.

        Returns:
            Fields in memory that the next call uses again.
        """
        self._wind = self._grid.packed(wind, time, self._wind)
        if field is None or not self._in_field:
            return (self._wind,)
        grid = field.plan.grid
        self._force = pack_field(field.velocity, field.push, grid.origin, grid.cell, self._force)
        return self._wind, self._force


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
