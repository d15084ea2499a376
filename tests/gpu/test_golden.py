"""A picture as it was when it was last looked at, on software Vulkan only: other drivers round otherwise.

Remake: ``WINDSWEPT_REMAKE_GOLDEN=1 .venv/bin/python -m pytest tests/gpu/test_golden.py``, then look at it.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from windswept.geometry.detail import DetailRules
from windswept.gpu.device import is_software
from windswept.render.offscreen import write_png
from windswept.render.staging import frame_now, stage
from windswept.scene.load_scene import load_scene
from windswept.scene.simulation import Simulation

GOLDEN = Path(__file__).with_name("golden_hazel.png")
SIZE = (160, 120)
LARGEST_MEAN = 1.0
"""Mean absolute difference of 8-bit channels: a leaf edge that falls otherwise here and there."""
FAR, LARGEST_SHARE = 40, 0.01
"""At most this share of pixels differs by more than so much in a channel."""


@pytest.fixture(scope="module")
def hazel(device: Any) -> np.ndarray:
    """(120, 160, 4) a hazel at rest, in full detail."""
    if not is_software(device):
        pytest.skip("golden pictures are compared on software Vulkan only")
    simulation = Simulation(load_scene("hazel", 1))
    return stage(simulation, SIZE, DetailRules()).draw(frame_now(simulation))


def test_a_hazel_looks_as_it_did(hazel: np.ndarray, tmp_path: Path) -> None:
    if os.environ.get("WINDSWEPT_REMAKE_GOLDEN"):
        write_png(hazel, GOLDEN)
    assert GOLDEN.stat().st_size < 60_000
    with Image.open(GOLDEN) as image:
        golden = np.asarray(image).astype(int)
    difference = np.abs(hazel[..., :3].astype(int) - golden)
    mean, share = difference.mean(), (difference.max(axis=2) > FAR).mean()
    if mean > LARGEST_MEAN or share > LARGEST_SHARE:
        shown = np.clip(4 * difference, 0, 255).astype(np.uint8)
        write_png(hazel, tmp_path / "drawn.png")
        write_png(shown, tmp_path / "difference.png")
        pytest.fail(
            f"mean {mean:.2f}, {share:.1%} of pixels far off: see {tmp_path}/difference.png and drawn.png"
        )
