"""The meadow's frame on the card is measured stage by stage."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.gpu.device import TIMESTAMPS, shared_device
from windswept.studies.bench_gpu_meadow import meadow_figures
from windswept.studies.endo import grass_field


def test_a_field_of_grass_is_measured() -> None:
    figures = meadow_figures(grass_field(6), (64, 36), repeats=1)
    (blades,) = {int(name.split(".")[2]) for name in figures}
    named = {name.removeprefix(f"gpu.meadow.{blades}."): value for name, value in figures.items()}
    assert blades > 200
    assert 0 < named["drawn"] <= blades
    assert named["frames_per_second"] * named["frame.ms"] == pytest.approx(1e3)
    assert all(np.isfinite(value) for value in named.values())
    if TIMESTAMPS in shared_device().features:
        assert {"lean.ms", "choose.ms", "blades.ms", "picture.ms"} <= set(named)
