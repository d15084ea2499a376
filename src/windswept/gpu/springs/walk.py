"""Walk: the kernels of a simulation in the order in which an interval of the wind needs them."""

from __future__ import annotations

from typing import Any

from windswept.gpu.kernel import Kernel
from windswept.gpu.seating import Seating
from windswept.gpu.springs.card_state import JOIN, JOIN_GROUPS, SHIFT, STEP, WIND, CardState
from windswept.gpu.springs.turns import links_in_turns
from windswept.gpu.stage_times import StageTimes
from windswept.motion.lanes import WIDTH

STAGES = ("levels", "wind", "simulate", "pose")
WORKGROUP = 64
TURNS_PER_LINK = 5
"""Turns of the loops of ``springs.wgsl`` for a link and step, see turns.py: its own, its groups', its ends' twice, its
modes'."""
WHOLE_TURNS = 1
"""The same of the kernels that are dispatched for whole plants only: of poses, of changes of level."""


class Walk:
    """Records what the card is to do.

    Args:
        device: the card.
        card: what it does it with.
        rungs: levels of all kinds.
        placements: of all kinds.
    """

    def __init__(self, device: Any, card: CardState, rungs: int, placements: int) -> None:
        self._device, self._card, self._rungs = device, card, rungs
        self._crowd = -(-placements // WORKGROUP)
        self.times = StageTimes(device, STAGES)

        def kernel(module: str, entry: str, constants: dict[str, float] | None = None) -> Kernel:
            return Kernel(device, module, entry, card.resources, constants)

        self._wish = kernel("choose", "wish", {"REGISTER": WIDTH})
        self._rank = kernel("choose", "rank", {"REGISTER": WIDTH})
        self._give = kernel("choose", "give", {"REGISTER": WIDTH})
        self._compact = kernel("members", "compact", {"MOST_JOINS": card.arrays.joins_each})
        self._settle = kernel("members", "settle")
        self._plan = kernel("plan", "plan")
        self._movers = self._new_movers()
        self._sample = kernel("wind", "sample")
        self._crown = kernel("crown", "crown_speed")
        self._steppers = self._new_steppers()
        self._posers: list[Kernel] = []

    def _new_steppers(self) -> list[Kernel]:
        """Kernels that step a block, one after the other: of large plants, each walks a share of the links."""
        arrays, resources = self._card.arrays, self._card.resources
        rungs = arrays.rungs[~arrays.coupled]
        share = links_in_turns(self._device, rungs, TURNS_PER_LINK)
        return [
            Kernel(self._device, "springs", "step_block", resources, {"FIRST": first, "MOST": share})
            for first in range(0, int(rungs["links"][:, 1].max(initial=1)), share)
        ]

    def _new_movers(self) -> list[tuple[Kernel, int]]:
        """Kernels that take along what moves with placements that change slot or level, and what dispatches each."""
        noted: dict[str, float] = {"LONGEST": self._card.arrays.longest}
        movers: list[tuple[str, str, dict[str, float], int]] = [
            ("members", "shift", {}, SHIFT),
            ("shift_state", "shift_state", {}, SHIFT),
            ("carry_over", "join", noted, JOIN),
            ("fit_groups", "fit_groups", noted, JOIN_GROUPS),
        ]
        return [
            (Kernel(self._device, module, entry, self._card.resources, constants), row)
            for module, entry, constants, row in movers
        ]

    def rebind_wind(self) -> None:
        """Takes the buffers of a wind with more sources."""
        self._sample.bind(self._card.resources)

    def plan(self, encoder: Any) -> None:
        """Lists the blocks of the members as they stand."""
        compute_pass = encoder.begin_compute_pass()
        self._plan.record(compute_pass, 1)
        compute_pass.end()

    def change_levels(self, encoder: Any) -> None:
        """Ends blends that are over, begins those that the eye asks for, and closes the ranks."""
        planned = self._card.resources["dispatches"]
        encoder.clear_buffer(self._card.resources["tally"])
        compute_pass = encoder.begin_compute_pass(**self.times.around("levels"))
        self._wish.record(compute_pass, self._crowd)
        self._rank.record(compute_pass, self._rungs)
        self._give.record(compute_pass, self._crowd)
        self._compact.record(compute_pass, self._rungs)
        self._settle.record(compute_pass, self._crowd)
        self._plan.record(compute_pass, 1)
        for mover, row in self._movers:
            mover.record_planned(compute_pass, planned, row)
        compute_pass.end()

    def sample_wind(self, encoder: Any) -> None:
        """Samples the wind at both ends of an interval, at every probe of every member."""
        planned = self._card.resources["dispatches"]
        compute_pass = encoder.begin_compute_pass(**self.times.around("wind"))
        self._sample.record_planned(compute_pass, planned, WIND)
        self._crown.record_planned(compute_pass, planned, STEP)
        compute_pass.end()

    def step(self, encoder: Any) -> None:
        """Takes the inner steps that the moment says are due."""
        compute_pass = encoder.begin_compute_pass(**self.times.around("simulate"))
        for stepper in self._steppers:
            stepper.record_planned(compute_pass, self._card.resources["dispatches"], STEP)
        compute_pass.end()

    def pose(self, encoder: Any, seating: Seating) -> None:
        """Writes where the links of the placements that have seats are now."""
        seats = {"seats": seating.seats, "ranks": seating.ranks, "poses": seating.poses}
        resources = self._card.resources | seats
        if not self._posers:
            entries = ("note_origin", "note_goal", "pose_seated")
            self._posers = [Kernel(self._device, "pose_links", entry, resources) for entry in entries]
        compute_pass = encoder.begin_compute_pass(**self.times.around("pose"))
        for kernel in self._posers:
            kernel.bind(resources)
            kernel.record_planned(compute_pass, seating.dispatches, 0)
        compute_pass.end()
