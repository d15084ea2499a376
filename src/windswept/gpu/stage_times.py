"""How long each stage of a frame takes on the card, by its own clock."""

from __future__ import annotations

from typing import Any

import numpy as np
import wgpu
from wgpu.backends.wgpu_native import lib

from windswept.gpu.device import TIMESTAMPS
from windswept.gpu.failures import card_errors


class StageTimes:
    """Timestamps at both ends of named passes; on cards without a clock it times nothing.

    Args:
        device: the card.
        stages: names, in the order in which they are reported.
    """

    def __init__(self, device: Any, stages: tuple[str, ...]) -> None:
        self._device, self._stages = device, stages
        self._recorded: set[str] = set()
        self.works = TIMESTAMPS in device.features
        """Whether this card has a clock."""
        if self.works:
            count = 2 * len(stages)
            self._queries = device.create_query_set(type="timestamp", count=count)
            usage = wgpu.BufferUsage.QUERY_RESOLVE | wgpu.BufferUsage.COPY_SRC
            self._ticks = device.create_buffer(size=8 * count, usage=usage)

    def around(self, stage: str) -> dict[str, Any]:
        """What a pass is begun with, so that the card notes when the stage begins and ends."""
        if not self.works:
            return {}
        self._recorded.add(stage)
        first = 2 * self._stages.index(stage)
        return {
            "timestamp_writes": {
                "query_set": self._queries,
                "beginning_of_pass_write_index": first,
                "end_of_pass_write_index": first + 1,
            }
        }

    @card_errors("timing its stages")
    def read(self) -> dict[str, float]:
        """Milliseconds that each stage took when it last ran; waits for the card, so not for every frame.

        Raises:
            GraphicsError: the card was lost.
        """
        if not self._recorded:
            return {}
        encoder = self._device.create_command_encoder()
        encoder.resolve_query_set(self._queries, 0, 2 * len(self._stages), self._ticks, 0)
        self._device.queue.submit([encoder.finish()])
        ticks = np.frombuffer(self._device.queue.read_buffer(self._ticks), np.uint64).reshape(-1, 2)
        # Cards count in ticks of their own, and may reset their clock between two stamps.
        tick = 1e-6 * lib.wgpuQueueGetTimestampPeriod(self._device.queue._internal)
        took = {
            name: tick * (int(end) - int(start))
            for name, (start, end) in zip(self._stages, ticks, strict=True)
        }
        return {name: took[name] for name in self._stages if name in self._recorded and took[name] >= 0.0}
