"""The graphics device: found once a process, with one clear line where there is none."""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
from functools import cache
from typing import Any

import wgpu

from windswept.errors import GraphicsError

DRIVER_LINE = "apt-get install -y --no-install-recommends mesa-vulkan-drivers"
"""Installs a software Vulkan driver on Debian and Ubuntu."""
TIMESTAMPS = "timestamp-query"
"""Feature with which the card says how long each stage takes."""
_RAISED_LIMITS = ("max-storage-buffer-binding-size", "max-buffer-size")


@cache
def shared_device() -> Any:
    """The one ``wgpu.GPUDevice`` of this process.

    Raises:
        GraphicsError: no adapter, or the driver refused.
    """
    adapter = _best_adapter()
    limits = {name: adapter.limits[name] for name in _RAISED_LIMITS}
    features = [TIMESTAMPS] if TIMESTAMPS in adapter.features else []
    try:
        return adapter.request_device_sync(
            label="windswept", required_limits=limits, required_features=features
        )
    except RuntimeError as error:
        raise GraphicsError(f"the graphics driver of {_name(adapter)} failed: {error}") from error


def adapter_summary() -> str:
    """One line on the adapter that pictures are drawn with.

    Raises:
        GraphicsError: no adapter.
    """
    adapter = _best_adapter()
    return f"{_name(adapter)}, {adapter.info['adapter_type']}, {adapter.info['backend_type']}"


def adapter_limits() -> dict[str, int | bool]:
    """What decides how much of a scene fits on the adapter, and whether it tells how long its stages take.

    Returns:
        ``binds_bytes`` and ``buffer_bytes``: what a shader sees of one buffer, and what one may have; ``has_clock``.

    Raises:
        GraphicsError: no adapter.
    """
    adapter = _best_adapter()
    binds, buffer = (int(adapter.limits[name]) for name in _RAISED_LIMITS)
    return {"binds_bytes": binds, "buffer_bytes": buffer, "has_clock": TIMESTAMPS in adapter.features}


def is_software(device: Any) -> bool:
    """Whether the device draws on the CPU, where triangles are dear."""
    return bool(device.adapter.info["adapter_type"] == "CPU")


def _name(adapter: Any) -> str:
    return adapter.info["device"] or adapter.info["description"]


@cache
def _best_adapter() -> Any:
    """The adapter wgpu prefers; enumerated first, since asking for one that is not there panics."""
    if "XDG_RUNTIME_DIR" not in os.environ:
        # Mesa asks for one; it is gone when the process ends.
        os.environ["XDG_RUNTIME_DIR"] = folder = tempfile.mkdtemp(prefix="windswept-runtime-")
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    missing = f"no graphics adapter found; a software one comes with: {DRIVER_LINE}"
    if not wgpu.gpu.enumerate_adapters_sync():
        raise GraphicsError(missing)
    try:
        return wgpu.gpu.request_adapter_sync(power_preference="high-performance")
    except RuntimeError as error:
        # WGPU_BACKEND_TYPE may rule out every adapter that was listed.
        raise GraphicsError(missing) from error
