"""One compute entry point with the buffers that its shader declares, found by name."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import wgpu

from windswept.gpu.device import is_software
from windswept.gpu.wiring import (
    COMPUTE,
    READ,
    TEXTURE,
    UNIFORM,
    WRITE,
    compute_pipeline,
    group_layout,
    group_of,
    shader_text,
)

_DECLARATION = re.compile(r"@group\(0\) @binding\((\d+)\) var(?:<([\w, ]+)>)? (\w+):")
_KINDS = {
    "storage, read": {"buffer": READ},
    "storage, read_write": {"buffer": WRITE},
    "uniform": {"buffer": UNIFORM},
    "": {"texture": TEXTURE},
}


def declared_bindings(module: str) -> dict[str, tuple[int, dict[str, Any]]]:
    """Binding number and kind of every resource of a set of shaders, by the name that the shader gives it."""
    found = _DECLARATION.findall(shader_text(module))
    return {name: (int(place), _KINDS[access]) for place, access, name in found}


class Kernel:
    """A pipeline that is dispatched again and again.

    Args:
        device: the card.
        module: name of the shader set.
        entry: entry point.
        resources: buffers and texture views, by the names that shaders give them; what the set declares and the entry
            point does not use may be missing.
        constants: values of the shader's overrides.
    """

    def __init__(
        self,
        device: Any,
        module: str,
        entry: str,
        resources: Mapping[str, Any],
        constants: dict[str, float] | None = None,
    ) -> None:
        self._device = device
        # Mesa's software driver (22.3), once it has drawn a picture, notes a pass's beginning only at the pass's first
        # barrier. wgpu sets none before a first dispatch, unless the card holds the dispatch's size: so one of nothing
        # goes ahead of each, else its time would be missing.
        self._nothing = (
            device.create_buffer(size=12, usage=wgpu.BufferUsage.INDIRECT) if is_software(device) else None
        )
        declared = declared_bindings(module)
        self._declared = {name: declared[name] for name in declared if name in resources}
        self._layout = group_layout(device, COMPUTE, dict(self._declared.values()))
        self._pipeline = compute_pipeline(device, [self._layout], module, entry, constants)
        self.bind(resources)

    def bind(self, resources: Mapping[str, Any]) -> None:
        """Takes other resources from now on, as when a buffer had to grow."""
        places = {place: resources[name] for name, (place, _) in self._declared.items()}
        self._group = group_of(self._device, self._layout, places)

    def record(self, compute_pass: Any, *workgroups: int) -> None:
        """Records a dispatch of so many workgroups."""
        self._set(compute_pass)
        if self._nothing is not None:
            compute_pass.dispatch_workgroups_indirect(self._nothing, 0)
        compute_pass.dispatch_workgroups(*workgroups)

    def record_planned(self, compute_pass: Any, dispatches: Any, row: int) -> None:
        """Records a dispatch whose size the card has written to a row (of 4 bytes) of a buffer."""
        self._set(compute_pass)
        compute_pass.dispatch_workgroups_indirect(dispatches, 4 * row)

    def _set(self, compute_pass: Any) -> None:
        compute_pass.set_pipeline(self._pipeline)
        compute_pass.set_bind_group(0, self._group)
