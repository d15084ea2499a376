"""CoupledSimulation: a scene in motion on the card with the links of plants coupled."""

from __future__ import annotations

from typing import Any

from windswept.gpu import layouts
from windswept.gpu.buffers import UNIFORM, filled, room, table
from windswept.gpu.failures import card_errors
from windswept.gpu.multibody.coupled_arrays import coupled_arrays
from windswept.gpu.multibody.coupled_rows import card_rows, state_of_rows
from windswept.gpu.multibody.walk import CoupledWalk
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.gpu.springs.walk import Walk
from windswept.motion.multibody import CoupledState
from windswept.plants.plant import Floats


class CoupledSimulation(GpuSimulation):
    """Runs a scene on the card as ``GpuSimulation`` does, with levels whose links are coupled.

    Made as one. Its kinds' ladders say which levels are coupled; where there is none, ``GrownKind.multibody`` does.
    """

    @card_errors("taking motion over")
    def put(self, states: list[CoupledState]) -> None:
        """Lets every placement go on from a state of `multibody`, kind by kind, where all stand at level 0."""
        queue, resources = self._device.queue, self.card.resources
        for first, state in zip(self._finest, states, strict=True):
            rung, row = self._arrays.rungs[first], self._coupled[first]
            slots = int(rung["room"][3])
            joints, carried = card_rows(state, min(slots, layouts.LANES), slots)
            queue.write_buffer(resources["state"], int(rung["room"][0]) * layouts.ROW.itemsize, joints)
            queue.write_buffer(resources["carried"], int(row["rows"][1]) * layouts.ROW.itemsize, carried)

    @property
    def states(self) -> list[CoupledState]:
        """State of every kind, read back, where all stand at level 0."""
        counts = [kind.placements.count for kind in self.kinds]
        return [self._state(rung, count) for rung, count in zip(self._finest, counts, strict=True)]

    @property
    def _finest(self) -> list[int]:
        """Rung of every kind's level 0."""
        return [int(first) for first in self._arrays.kinds["ladder"][:, 0]]

    def _state(self, number: int, placements: int) -> CoupledState:
        """State of a rung without groups, read back."""
        rung = self._arrays.rungs[number]
        first, slots = int(rung["room"][0]), int(rung["room"][3])
        links, lanes = int(rung["links"][1]), min(slots, layouts.LANES)
        carried_first = int(self._coupled[number]["rows"][1])

        def rows(name: str, start: int, count: int) -> Floats:
            return self.card.read(name, "<f4", 4 * start, 4 * count)

        joints = rows("state", first, slots * links).reshape(-1, links, lanes, 4)
        carried = rows("carried", carried_first, layouts.CARRIED_ROWS * slots * links).reshape(
            -1, links, 2, lanes, 4
        )
        return state_of_rows(joints, carried, placements, self.step_count)

    def _new_walk(self) -> Walk:
        """The kernels, once what coupled links need has its place on the card."""
        # Every walk of a step is a dispatch of its own.
        self.steps_at_once = 1
        arrays = coupled_arrays(self.kinds, self._arrays)
        self._coupled = arrays.coupled
        device: Any = self._device
        self.card.resources |= {
            "rods": filled(device, arrays.rods),
            "coupled": filled(
                device, table(arrays.coupled, layouts.RUNG_LIMIT, "simulation levels"), UNIFORM
            ),
            "carried": room(device, layouts.ROW, arrays.carried_rows),
            "records": room(device, layouts.ROW, arrays.record_rows),
            "slots": room(device, layouts.ROW, arrays.slot_rows),
        }
        return CoupledWalk(device, self.card, len(self._arrays.rungs), len(self._arrays.rooted))

    @property
    def bytes(self) -> dict[str, int]:
        """Memory of what coupled links need beyond the joints, by buffer."""
        return {name: int(self.card.resources[name].size) for name in ("rods", "carried", "records", "slots")}
