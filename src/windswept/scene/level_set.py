"""All placements of one kind that are simulated at the same level: a compact state, and who is in it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from windswept.motion import Level, Model, build_stepper, rest_state
from windswept.motion.lanes import WIDTH
from windswept.plants.plant import Floats, Ints
from windswept.scene.probes import Probes, field_at_probes, place_probes, wind_at_probes
from windswept.scene.scene import Placements
from windswept.scene.terrain import Terrain
from windswept.wind.field import Field
from windswept.wind.wind import Wind


class LevelSet:
    """Placements move in and out; the state of those that stay is not touched.

    Args:
        model: the plant's constants.
        level: what of the plant is stepped.
        placements: of the kind, all of them.
        terrain: they stand on.
        members: (M,) placements that are in the set from the beginning, at rest.
    """

    def __init__(
        self, model: Model, level: Level, placements: Placements, terrain: Terrain, members: Ints
    ) -> None:
        self.level = level
        self.stepper = build_stepper(model, level)
        self.members: list[int] = [int(m) for m in members]
        """Which placement each slot of the state is."""
        self.state = rest_state(level, len(self.members))
        self._moves = level.moves
        self._placements, self._terrain = placements, terrain
        self._probes: Probes | None = None
        self.winds: tuple[Floats, Floats] | None = None
        """(M, B, 3) wind at both ends of the interval under way, m/s."""

    @property
    def oscillators(self) -> int:
        """Links and groups that are stepped for each member."""
        return self.level.link_count + self.level.group_count

    def slot(self, placement: int) -> int:
        """Slot of a member."""
        return self.members.index(placement)

    def add(self, placement: int, *parts: Floats) -> None:
        """Takes a placement in with a state of its own.

        Args:
            placement: not yet a member.
            parts: its slice of every part of ``State``: (A, 4) joints, (G, 6) groups, (A, 6) carried where coupled.
        """
        slot = len(self.members)
        if slot == len(self.state.joints) * WIDTH:
            self.state.add_tile()
        self.members.append(placement)
        self.state.placement_count = len(self.members)
        self._put(slot, parts)
        self._probes = None

    def remove(self, placement: int) -> None:
        """Lets a member go; the last member takes its slot."""
        slot, last = self.slot(placement), len(self.members) - 1
        tile, lane = divmod(last, WIDTH)
        self._put(slot, [part[tile, :, :, lane] for part in self.state.parts])
        self._put(last, [np.float32(0.0)] * len(self.state.parts))
        self.members[slot] = self.members[last]
        self.members.pop()
        self.state.placement_count = last
        self._probes = None

    def _put(self, slot: int, parts: Sequence[Floats | np.float32]) -> None:
        tile, lane = divmod(slot, WIDTH)
        for part, one in zip(self.state.parts, parts, strict=True):
            part[tile, :, :, lane] = one

    def sample_winds(self, wind: Wind, start: float, stop: float) -> None:
        """Samples the wind at both ends of an interval, s."""
        if self._probes is None:
            chosen = Placements(self._placements.position[self.members], self._placements.yaw[self.members])
            self._probes = place_probes(self.level, chosen, self._terrain)
        self.winds = wind_at_probes(wind, self._probes, start), wind_at_probes(wind, self._probes, stop)

    def add_field(self, field: Field, end: int) -> None:
        """Adds a force field as it is at the beginning (0) or end (1) of the interval to the winds just sampled."""
        if self.winds is not None and self._probes is not None:
            self.winds[end][...] += field_at_probes(field, self._probes)

    def step(self, count: int, taken: int, interval: int) -> None:
        """Takes ``count`` inner steps of the interval, after ``taken`` taken before; what stands still takes none."""
        if self._moves and self.members and self.winds is not None:
            tiles = -(-len(self.members) // WIDTH)
            self.stepper.step(self.state.first_tiles(tiles), *self.winds, count, taken, interval)
