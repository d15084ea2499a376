"""Leaning: blades that move on the card, as ``step_in_field`` moves them on the CPU."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.gpu.blades.layouts import AIR_GRID, AIR_LIMIT, LEAN_PASS
from windswept.gpu.blades.lean_rows import LeanRows, air_grids, lean_rows, shares_of
from windswept.gpu.buffers import UNIFORM, GrowingBuffer, filled, room
from windswept.gpu.failures import card_errors
from windswept.gpu.kernel import Kernel
from windswept.gpu.layouts import ROW, WORD
from windswept.gpu.stage_times import StageTimes
from windswept.motion.blades import Blades, BladeState, PackedField
from windswept.motion.blades.blades import STATE_COUNT
from windswept.motion.lanes import WIDTH
from windswept.plants.plant import Floats

MOST_GROUPS = 65_535
"""Workgroups along x that every adapter takes; each takes more blocks where there are more."""
_NUMBER = np.dtype("<f4")


class _Share:
    """Blades whose constants the card binds at once."""

    def __init__(
        self,
        device: Any,
        shared: dict[str, Any],
        first: int,
        blocks: NDArray[np.void],
        constants: Floats,
    ) -> None:
        self._device, self._first = device, first
        self._groups = min(len(blocks), MOST_GROUPS)
        self._own = {
            "blocks": filled(device, blocks),
            "constants": filled(device, constants),
            "lean_pass": room(device, LEAN_PASS, 1),
        }
        self._kernel = Kernel(device, "lean", "step_blades", shared | self._own)

    @property
    def bytes(self) -> int:
        """Memory of what is its own."""
        return sum(buffer.size for buffer in self._own.values())

    def bind(self, shared: dict[str, Any]) -> None:
        """Takes other buffers of what all share."""
        self._kernel.bind(shared | self._own)

    def record(self, compute_pass: Any, count: int) -> None:
        """Records ``count`` steps."""
        due = np.zeros(1, LEAN_PASS)
        due["steps"] = count, self._first, 0, 0
        self._device.queue.write_buffer(self._own["lean_pass"], 0, due)
        self._kernel.record(compute_pass, self._groups)


class Leaning:
    """Sets of blades of one kind each, at rest to begin with. Nothing is read back but where it says so.

    Args:
        device: the card.
        sets: what stands where; sets that no wind moves are better left out.
        airs: (S,) number of the field that each set feels; None where there is one for all.
        limit: bytes that a buffer may have; None for what the adapter takes.

    Raises:
        GraphicsError: the card has too little memory.
    """

    def __init__(
        self,
        device: Any,
        sets: Sequence[Blades],
        airs: Sequence[int] | None = None,
        limit: int | None = None,
    ) -> None:
        self._device = device
        self._sets = tuple(sets)
        rows = lean_rows(sets, [0] * len(sets) if airs is None else airs)
        self._nodes = GrowingBuffer(device, ROW)
        with card_errors("the blades' motion"):
            self._resources = self._buffers(rows)
            self._shares = [
                _Share(device, self._resources, *share)
                for share in shares_of(rows, limit or device.limits["max-storage-buffer-binding-size"])
            ]
        self._edges = np.cumsum([0, *rows.tiles]) * STATE_COUNT * WIDTH
        self.times = StageTimes(device, ("lean",))
        self.step_count = 0
        """Steps taken since rest."""

    def _buffers(self, rows: LeanRows) -> dict[str, Any]:
        """Everything that a step reads and writes, by the names that the shader gives it."""
        device = self._device
        return {
            "kinds": filled(device, rows.kinds),
            "nodes": self._nodes.buffer,
            "leans": room(device, _NUMBER, sum(rows.tiles) * STATE_COUNT * WIDTH),
            "clamped": room(device, WORD, 1),
            "grids": room(device, AIR_GRID, AIR_LIMIT, UNIFORM),
        }

    @property
    def leans(self) -> Any:
        """Buffer of ``BladeState.lanes`` of all sets, one after the other."""
        return self._resources["leans"]

    @property
    def bytes(self) -> int:
        """Memory of all buffers."""
        return sum(buffer.size for buffer in self._resources.values()) + sum(
            share.bytes for share in self._shares
        )

    @card_errors("stepping blades")
    def write_air(self, *fields: PackedField) -> None:
        """Takes the air that blades feel from now on, in the order of ``airs``.

        Args:
            fields: as `pack_field` packs them; they go to the card as they are.

        Raises:
            ValueError: more than AIR_LIMIT fields.
            GraphicsError: the card has too little memory, or was lost.
        """
        if len(fields) > AIR_LIMIT:
            raise ValueError(f"{len(fields)} fields of air: at most {AIR_LIMIT} blow at one time")
        self._nodes.reserve(sum(field.nodes.size for field in fields) // 4)
        if self._nodes.buffer is not self._resources["nodes"]:
            self._resources["nodes"] = self._nodes.buffer
            for share in self._shares:
                share.bind(self._resources)
        first = 0
        for field in fields:
            self._nodes.write(field.nodes, first)
            first += field.nodes.size // 4
        self._device.queue.write_buffer(self._resources["grids"], 0, air_grids(fields))

    def step(self, count: int) -> None:
        """Takes ``count`` inner steps in the air as it was last written.

        Raises:
            GraphicsError: the card was lost.
        """
        with card_errors("stepping blades"):
            encoder = self._device.create_command_encoder()
            compute_pass = encoder.begin_compute_pass(**self.times.around("lean"))
            for share in self._shares:
                share.record(compute_pass, count)
            compute_pass.end()
            self._device.queue.submit([encoder.finish()])
        self.step_count += count

    @card_errors("taking leans over")
    def write(self, states: Sequence[BladeState]) -> None:
        """Goes on from states of all sets."""
        for first, state in zip(self._edges, states, strict=False):
            self._device.queue.write_buffer(self.leans, 4 * int(first), np.ascontiguousarray(state.lanes))

    @card_errors("stepping blades")
    def wait(self) -> None:
        """Returns when the card has done everything that it was told."""
        self._device.queue.read_buffer(self._resources["clamped"])

    @property
    def states(self) -> list[BladeState]:
        """Motion of every set, read back; waits for the card, so not for every frame."""
        with card_errors("reading leans"):
            numbers = np.frombuffer(self._device.queue.read_buffer(self.leans), np.float32)
        return [
            BladeState(
                numbers[first:end].reshape(-1, STATE_COUNT, WIDTH).copy(), blades.count, self.step_count
            )
            for blades, (first, end) in zip(self._sets, pairwise(self._edges.tolist()), strict=True)
        ]

    @property
    @card_errors("reading leans")
    def clamped_count(self) -> int:
        """As of ``BladeState``, over all sets, read back."""
        return int(np.frombuffer(self._device.queue.read_buffer(self._resources["clamped"]), np.uint32)[0])
