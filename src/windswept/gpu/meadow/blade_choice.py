"""BladeChoice: the blades that a frame poses and draws, chosen on the card; ``blade_list`` is the plain formula."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.gpu.buffers import STORAGE, UNIFORM, UNIFORM_STRIDE, filled, room
from windswept.gpu.failures import card_errors
from windswept.gpu.kernel import Kernel
from windswept.gpu.layouts import COUNTS, NONE, WORD
from windswept.gpu.meadow.blade_list import BladeRules, Sharpness
from windswept.gpu.meadow.choice_layouts import CHOICE_LOOK, CHUNK_ROW, MOST_SECTION_NUMBERS
from windswept.gpu.meadow.layouts import MEADOW_PASS
from windswept.gpu.meadow.meadow_rows import LEVELS, MeadowRows

MOST_DEPTH = 8
"""Blades that hang on one another: MOST_DEPTH of ``blade_choice.wgsl``."""
MOST_GROUPS = 65_535
"""Workgroups along x that every adapter takes."""
LAST = 3 * MOST_DEPTH + 5 * MOST_SECTION_NUMBERS
"""Place of the number of all joints in ``plan``."""
NOW = MEADOW_PASS.itemsize // 2
"""Place of the seconds since the last step in a row of ``passes``, bytes."""
_WORKGROUP = 64
_PASS = np.dtype("V256")
"""Of ``passes``: a row for every depth, then one for every number of sections."""
assert _PASS.itemsize == UNIFORM_STRIDE


class BladeChoice:
    """Chooses blades of a meadow; nothing is read back.

    Args:
        device: the card.
        rows: the meadow.
        rules: what may be spent on a picture.
        joints: posed joints that there is room for.

    Raises:
        ValueError: blades hang on one another too deep, or have too many different numbers of sections.
        GraphicsError: the card has too little memory.
    """

    def __init__(self, device: Any, rows: MeadowRows, rules: BladeRules, joints: int) -> None:
        self._device, self._rules, self._joints = device, rules, joints
        self.depths = int(rows.depth.max(initial=0)) + 1
        """Rows of ``plan`` that are dispatched, one after the other."""
        self.section_numbers: list[int] = np.unique(rows.sections).tolist()
        """In the order of the draws in ``plan``."""
        if self.depths > MOST_DEPTH or len(self.section_numbers) > MOST_SECTION_NUMBERS:
            raise ValueError(
                f"{self.depths} blades on one another and {len(self.section_numbers)} numbers of sections: "
                f"at most {MOST_DEPTH} and {MOST_SECTION_NUMBERS} can be drawn"
            )
        self._chunks = len(rows.chunk_set)
        self._seen_from: Sharpness | None = None
        with card_errors("the choice of blades"):
            self._resources = self._buffers(rows)
            self._see, self._mark, self._count, self._plan, self._place, self._carry = (
                Kernel(device, "blade_choice", entry, self._resources)
                for entry in ("see", "mark", "count", "plan_all", "place", "carry")
            )

    def _buffers(self, rows: MeadowRows) -> dict[str, Any]:
        """Everything that is read and written, by the names that the shader gives it."""
        device, blades = self._device, len(rows.parent)
        slots = MOST_DEPTH + MOST_SECTION_NUMBERS
        return {
            "look": room(device, CHOICE_LOOK, 1, UNIFORM),
            "chunks": filled(device, chunk_rows(rows)),
            "members": filled(device, _member_rows(rows)),
            "seen": room(device, np.dtype(COUNTS), self._chunks),
            "firsts": room(device, WORD, self._chunks),
            "carriers": room(device, WORD, blades),
            "items": room(device, np.dtype(COUNTS), blades),
            "plan": room(device, WORD, LAST + 1, STORAGE | wgpu.BufferUsage.INDIRECT),
            "passes": room(device, _PASS, slots, STORAGE | wgpu.BufferUsage.UNIFORM),
        }

    @property
    def items(self) -> Any:
        """Buffer of what is posed, as ``BladeList.items``."""
        return self._resources["items"]

    @property
    def plan(self) -> Any:
        """Buffer of indirect arguments: 3 numbers a depth, then from 3 * MOST_DEPTH on 5 a number of sections."""
        return self._resources["plan"]

    @property
    def passes(self) -> Any:
        """Buffer of ``MEADOW_PASS``, every UNIFORM_STRIDE bytes: one a depth, then one a number of sections."""
        return self._resources["passes"]

    @property
    def chosen_count(self) -> int:
        """Blades that were chosen last, read back."""
        rows = np.frombuffer(self._device.queue.read_buffer(self.passes), np.uint32)
        return int(rows.reshape(-1, UNIFORM_STRIDE // 4)[:MOST_DEPTH, 1].sum())

    def record(self, encoder: Any, sharpness: Sharpness, ahead: float, timestamps: dict[str, Any]) -> None:
        """Records the choice into a command encoder; an eye that stands has chosen already.

        Args:
            encoder: takes it; it must be submitted before the next call.
            sharpness: who looks.
            ahead: seconds since the last step, for the poses.
            timestamps: what the pass is begun with.
        """
        if self._seen_from is not None and sharpness.same_as(self._seen_from):
            self._tell(ahead)
            return
        self._seen_from = sharpness
        self._device.queue.write_buffer(self._resources["look"], 0, self._look(sharpness, ahead))
        encoder.clear_buffer(self._resources["carriers"])
        encoder.clear_buffer(self._resources["plan"])
        encoder.clear_buffer(self._resources["passes"])
        groups = min(self._chunks, MOST_GROUPS), -(-self._chunks // MOST_GROUPS)
        compute_pass = encoder.begin_compute_pass(**timestamps)
        self._see.record(compute_pass, -(-self._chunks // _WORKGROUP))
        self._mark.record(compute_pass, *groups)
        self._count.record(compute_pass, *groups)
        self._plan.record(compute_pass, 1)
        self._place.record(compute_pass, *groups)
        self._carry.record(compute_pass, *groups)
        compute_pass.end()

    def _tell(self, ahead: float) -> None:
        """Writes the seconds since the last step where the poses read them."""
        number = np.array([ahead], np.float32)
        for depth in range(self.depths):
            self._device.queue.write_buffer(self.passes, depth * UNIFORM_STRIDE + NOW, number)

    def _look(self, sharpness: Sharpness, ahead: float) -> NDArray[np.void]:
        """(1,) ``CHOICE_LOOK``."""
        row = np.zeros(1, CHOICE_LOOK)
        rules = self._rules
        row["eye"] = *sharpness.eye.tolist(), sharpness.pixels
        row["planes"] = sharpness.planes
        row["rules"] = rules.width_pixels, *rules.section_pixels, rules.reach
        row["now"] = ahead, sharpness.pixels, rules.width_pixels, rules.reach
        row["counts"] = self._chunks, self.depths, len(self.section_numbers), self._joints
        row["sections"].reshape(-1)[: len(self.section_numbers)] = self.section_numbers
        return row


def chunk_rows(rows: MeadowRows) -> NDArray[np.void]:
    """(C,) ``CHUNK_ROW``, those on the ground first, then those on them, and so on."""
    out = np.zeros(len(rows.chunk_set), CHUNK_ROW)
    depth = rows.depth[rows.chunk_first[:-1]]
    out["ball"] = rows.chunk_ball
    out["size"][:, :2] = rows.set_size[rows.chunk_set]
    out["rows"][:, 0], out["rows"][:, 1] = rows.chunk_first[:-1], np.diff(rows.chunk_first)
    out["rows"][:, 2], out["rows"][:, 3] = rows.chunk_set * LEVELS, depth
    out["sections"][:, :LEVELS] = rows.sections[rows.chunk_set]
    return out[np.argsort(depth, kind="stable")]


def _member_rows(rows: MeadowRows) -> NDArray[np.uint32]:
    """(N, 2) parent of every blade or NONE, and the bits of its chance."""
    parent = np.where(rows.parent < 0, NONE, rows.parent).astype(np.uint32)
    return np.column_stack([parent, rows.chance.astype(np.float32).view(np.uint32)])
