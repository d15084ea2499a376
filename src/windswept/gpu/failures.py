"""A card that fails: whatever a driver says becomes one clear line."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import wgpu

from windswept.errors import GraphicsError
from windswept.gpu.device import shared_device

MEND = "simulate and pose on the CPU instead, or place fewer plants"
LOSS_SIGNS = ("device is lost", "Could not map buffer")
"""What wgpu says of a call to a lost device, and of a buffer that was to be read when it was lost."""


@contextmanager
def card_errors(doing: str) -> Iterator[None]:
    """Turns a lost device and too little memory into a GraphicsError; any other error is a bug and passes through.

    A lost device is forgotten, so that the next one who asks for the shared device gets a new one.

    Args:
        doing: what the card was asked for, as in "stepping plants".
    """
    try:
        yield
    except wgpu.GPUOutOfMemoryError as error:
        raise GraphicsError(f"the graphics card has too little memory for {doing}: {MEND}") from error
    except (wgpu.GPUError, RuntimeError) as error:
        if not any(sign in str(error) for sign in LOSS_SIGNS):
            raise
        shared_device.cache_clear()
        raise GraphicsError(f"the graphics card was lost while {doing}: {MEND}") from error
