"""CoupledSimulation: a scene in motion on the card with the links of every plant coupled."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from windswept.gpu import layouts
from windswept.gpu.buffers import UNIFORM, filled, room, table
from windswept.gpu.device import shared_device
from windswept.gpu.failures import card_errors
from windswept.gpu.multibody.coupled_arrays import coupled_arrays
from windswept.gpu.multibody.coupled_rows import card_rows, state_of_rows
from windswept.gpu.multibody.layouts import CARRIED
from windswept.gpu.multibody.walk import CoupledWalk
from windswept.gpu.springs.kinds import GrownKind
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.gpu.springs.walk import Walk
from windswept.motion.multibody import CoupledState
from windswept.plants.plant import Floats
from windswept.scene.meadow_bed import Bed
from windswept.scene.scene import Scene


class CoupledSimulation(GpuSimulation):
    """Runs a scene on the card, every placement at level 0 by `multibody`; otherwise as ``GpuSimulation``.

    Args:
        scene: what stands where, in which wind.
        kinds: its plants, grown and compiled; their ladders are not used.
        room: bytes that a buffer may have; None for what the adapter takes.
        beds: its underbrush, planted.

    Raises:
        GraphicsError: no adapter, or one with too little memory.
    """

    def __init__(
        self, scene: Scene, kinds: list[GrownKind], room: int | None = None, beds: tuple[Bed, ...] = ()
    ) -> None:
        limit = shared_device().limits["max-storage-buffer-binding-size"]
        self._room = limit if room is None else min(room, limit)
        super().__init__(scene, [replace(kind, ladder=None) for kind in kinds], room=self._room, beds=beds)
        # Every walk of a step is a dispatch of its own.
        self.steps_at_once = 1

    @card_errors("taking motion over")
    def put(self, states: list[CoupledState]) -> None:
        """Lets every placement go on from a state of `multibody`, kind by kind."""
        queue, resources = self._device.queue, self.card.resources
        for rung, row, state in zip(self._arrays.rungs, self._coupled, states, strict=True):
            slots = int(rung["room"][3])
            joints, carried = card_rows(state, min(slots, layouts.LANES), slots)
            queue.write_buffer(resources["state"], int(rung["room"][0]) * layouts.ROW.itemsize, joints)
            queue.write_buffer(resources["carried"], int(row["rows"][1]) * layouts.ROW.itemsize, carried)

    @property
    def states(self) -> list[CoupledState]:
        """State of every kind, read back."""
        return [self._state(k, kind.placements.count) for k, kind in enumerate(self.kinds)]

    def _state(self, kind: int, placements: int) -> CoupledState:
        """State of one kind, read back."""
        rung = self._arrays.rungs[kind]
        first, slots = int(rung["room"][0]), int(rung["room"][3])
        links, lanes = int(rung["links"][1]), min(slots, layouts.LANES)
        carried_first = int(self._coupled[kind]["rows"][1])

        def rows(name: str, start: int, count: int) -> Floats:
            return self.card.read(name, "<f4", 4 * start, 4 * count)

        joints = rows("state", first, slots * links).reshape(-1, links, lanes, 4)
        carried = rows("carried", carried_first, CARRIED * slots * links).reshape(-1, links, 2, lanes, 4)
        return state_of_rows(joints, carried, placements, self.step_count)

    def _new_walk(self) -> Walk:
        """The kernels, once what coupled links need has its place on the card."""
        arrays = coupled_arrays(self.kinds, self._arrays.rungs, self._room)
        self._coupled = arrays.coupled
        device: Any = self._device
        self.card.resources |= {
            "rods": filled(device, arrays.rods),
            "coupled": filled(device, table(arrays.coupled, layouts.KIND_LIMIT, "kinds of plants"), UNIFORM),
            "carried": room(device, layouts.ROW, arrays.carried_rows),
            "records": room(device, layouts.ROW, arrays.record_rows),
            "slots": room(device, layouts.ROW, arrays.slot_rows),
        }
        return CoupledWalk(device, self.card, len(self._arrays.rungs), len(self._arrays.rooted))

    @property
    def bytes(self) -> dict[str, int]:
        """Memory of what coupled links need beyond the joints, by buffer."""
        return {name: int(self.card.resources[name].size) for name in ("rods", "carried", "records", "slots")}
