"""Culling: what is seen or throws shadows, in what detail, and where it is posed, chosen on the card."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.errors import GraphicsError
from windswept.geometry.detail import DetailRules
from windswept.gpu import layouts
from windswept.gpu.buffers import UNIFORM, filled, room, table
from windswept.gpu.culling.layouts import BANDS, CHOICE, CLASSES, GROUP, MESH_LIMIT, NEEDS, SIGHT
from windswept.gpu.culling.standing_rows import kind_rows, rank_rows, shortening, standing_rows
from windswept.gpu.draw_list import View
from windswept.gpu.draw_plan import MOST_GROUPS, DrawPlan
from windswept.gpu.failures import card_errors
from windswept.gpu.frame import FLUTTER_SPEED, LARGEST_FLUTTER, PosedPlants
from windswept.gpu.kernel import Kernel
from windswept.gpu.plant_buffers import Kind
from windswept.gpu.posing import Counts
from windswept.gpu.seating import Seating

BAND_COLUMNS = 5
"""COLUMNS of ``cull.wgsl``."""
SEAT = np.dtype(layouts.COUNTS)


class Culling:
    """Writes a draw plan, and seats for the poses of those that are drawn.

    Args:
        device: the card.
        kinds: what it holds.
        rules: what may be spent on a picture.
        plan: takes what is drawn.
    """

    def __init__(self, device: Any, kinds: tuple[Kind, ...], rules: DetailRules, plan: DrawPlan) -> None:
        self._device, self._kinds, self._rules, self._plan = device, kinds, rules, plan
        self._placed: tuple[Any, ...] = ()
        self._count = 0
        self.shortened = 0
        """Bits by which needs are shortened before they are added up."""
        rows, prefixes = kind_rows(kinds)
        self._ranks = filled(device, rank_rows(kinds))
        self._resources: dict[str, Any] = {
            "sight": room(device, SIGHT, 1, UNIFORM),
            "kinds": filled(device, table(rows, layouts.KIND_LIMIT, "kinds of plants"), UNIFORM),
            "meshes": filled(device, table(plan.meshes.astype(np.uint32), MESH_LIMIT, "meshes"), UNIFORM),
            "prefixes": filled(device, prefixes),
            "bands": room(device, layouts.WORD, BAND_COLUMNS * BANDS),
            "plan": plan.words,
            "batches": plan.batches,
        }
        self._kernels: list[Kernel] = []
        self._is_stale = False

    def place(self, plants: tuple[PosedPlants, ...]) -> bool:
        """Takes placements, unless they are those that it has; says whether they are others.

        Raises:
            GraphicsError: the card has too little memory.
        """
        placed = tuple(part for posed in plants for part in (posed.position, posed.yaw, posed.extra_look))
        if len(placed) == len(self._placed) and all(map(_is, placed, self._placed)):
            return False
        rows = standing_rows(plants)
        if len(rows) > GROUP * MOST_GROUPS:
            raise GraphicsError(
                f"the card draws up to {GROUP * MOST_GROUPS} placements, and there are {len(rows)}"
            )
        self._placed, self._count = placed, len(rows)
        self.shortened = shortening(plants, self._kinds)
        self._plan.reserve(self._count)
        with card_errors("the choice of plants"):
            self._resources |= {
                "standing": filled(self._device, rows),
                "choices": room(self._device, CHOICE, self._count),
                "totals": room(self._device, NEEDS, CLASSES * self._groups),
                "seats": room(self._device, SEAT, 1 + self._count),
                "placements": self._plan.placements,
            }
        self._is_stale = True
        return True

    def record(
        self, encoder: Any, view: View, rooms: Counts, speeds: Any, timestamps: dict[str, Any]
    ) -> None:
        """Records the choice into a command encoder.

        Args:
            encoder: takes it; it must be submitted before the next call.
            view: camera and shadow volume.
            rooms: how much can be posed.
            speeds: buffer of the mean wind speed in every placement's crown.
            timestamps: what the pass is begun with.
        """
        self._device.queue.write_buffer(self._resources["sight"], 0, self._sight(view, rooms))
        encoder.clear_buffer(self._resources["bands"])
        see, admit, count, plan_all, place = self._bound(speeds)
        compute_pass = encoder.begin_compute_pass(**timestamps)
        see.record(compute_pass, self._groups)
        admit.record(compute_pass, 1)
        count.record(compute_pass, self._groups)
        plan_all.record(compute_pass, 1)
        place.record(compute_pass, self._groups)
        compute_pass.end()

    def seating(self, poses: Any) -> Seating:
        """Seats of those that are drawn, in a buffer of poses."""
        return Seating(self._resources["seats"], self._ranks, poses, self._plan.words)

    @property
    def bytes(self) -> int:
        """Memory of all buffers."""
        buffers = [self._ranks, *self._resources.values()]
        return sum(item.size for item in buffers if isinstance(item, wgpu.GPUBuffer))

    @property
    def _groups(self) -> int:
        return -(-self._count // GROUP)

    def _bound(self, speeds: Any) -> list[Kernel]:
        """The kernels, over the buffers as they are now."""
        if self._resources.get("speeds") is not speeds:
            self._resources["speeds"], self._is_stale = speeds, True
        if not self._kernels:
            flutter = {"LARGEST_FLUTTER": LARGEST_FLUTTER, "FLUTTER_SPEED": FLUTTER_SPEED}
            self._kernels = [
                Kernel(self._device, module, entry, self._resources, constants)
                for module, constants, entries in (
                    ("cull", {}, ("see", "admit", "count")),
                    ("cull_places", flutter, ("plan_all", "place")),
                )
                for entry in entries
            ]
        elif self._is_stale:
            for kernel in self._kernels:
                kernel.bind(self._resources)
        self._is_stale = False
        return self._kernels

    def _sight(self, view: View, rooms: Counts) -> NDArray[np.void]:
        """(1,) ``SIGHT``."""
        row = np.zeros(1, SIGHT)
        rules = self._rules
        pixels = view.screen_height / (2.0 * np.tan(0.5 * view.camera.fov_y))
        row["eye"] = *view.camera.eye, pixels
        row["planes"] = view.planes
        row["sun"] = *view.sun, view.shadow_texel
        row["shadow"] = *view.shadow_centre, view.shadow_radius
        row["stem_pixels"] = rules.stem_pixels
        row["leaf_pixels"] = rules.leaf_pixels, 1.0 / rules.leaf_scale_limit**2, *rules.leaf_mesh_pixels
        row["counts"] = self._count, self._groups, self.shortened, 0
        row["room"] = rooms
        return row


def _is(one: Any, other: Any) -> bool:
    return one is other
