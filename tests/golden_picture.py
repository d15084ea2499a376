"""Pictures as they were when they were last looked at, on software Vulkan only: other drivers round otherwise.

Remake: ``WINDSWEPT_REMAKE_GOLDEN=1 .venv/bin/python -m pytest tests/gpu -k "as_it_did"``, then look at them.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from windswept.gpu.device import is_software, shared_device
from windswept.render.offscreen import write_png

LARGEST_MEAN = 1.0
"""Mean absolute difference of 8-bit channels: a leaf edge that falls otherwise here and there."""
FAR, LARGEST_SHARE = 40, 0.01
"""At most this share of pixels differs by more than so much in a channel."""
MOST_BYTES = 60_000


def skip_other_drivers() -> None:
    """Skips a test on a card of its own."""
    if not is_software(shared_device()):
        pytest.skip("golden pictures are compared on software Vulkan only")


def check_golden(drawn: np.ndarray, name: str, kept: Path) -> None:
    """Compares (height, width, 4) with ``tests/golden/NAME.png``.

    Where they differ, what was drawn and four times the difference are left in the folder ``kept``.
    """
    golden_file = Path(__file__).parent / "golden" / f"{name}.png"
    if os.environ.get("WINDSWEPT_REMAKE_GOLDEN"):
        write_png(drawn, golden_file)
    assert golden_file.stat().st_size < MOST_BYTES
    with Image.open(golden_file) as image:
        golden = np.asarray(image).astype(int)
    difference = np.abs(drawn[..., :3].astype(int) - golden)
    mean, share = difference.mean(), (difference.max(axis=2) > FAR).mean()
    if mean > LARGEST_MEAN or share > LARGEST_SHARE:
        write_png(drawn, kept / "drawn.png")
        write_png(np.clip(4 * difference, 0, 255).astype(np.uint8), kept / "difference.png")
        pytest.fail(
            f"mean {mean:.2f}, {share:.1%} of pixels far off: see difference.png and drawn.png in {kept}"
        )
