"""The paper's scene at its limit: 100,000 plants, none too near to another; and its plan can be drawn."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from windswept.studies.bench_spread import bench_spread
from windswept.studies.spread_plot import draw_meadow, grow_meadow


def test_a_hundred_thousand_plants_keep_apart() -> None:
    stems = np.concatenate(list(grow_meadow(100_000).stems.values()))
    assert 98_000 <= len(stems) <= 100_000
    x, y, radius = stems.T
    first, second = cKDTree(stems[:, :2]).query_pairs(2.0 * radius.max(), output_type="ndarray").T
    apart = np.hypot(x[first] - x[second], y[first] - y[second])
    assert np.min(apart - radius[first] - radius[second]) > -1e-6


def test_plan_is_a_picture(tmp_path: Path) -> None:
    from PIL import Image

    draw_meadow(grow_meadow(2_000), tmp_path / "plan.png")
    with Image.open(tmp_path / "plan.png") as picture:
        colours = np.unique(np.asarray(picture)[60:1000, 60:1000].reshape(-1, 3), axis=0)
    assert len(colours) > 1000


def test_bench_gives_its_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    import windswept.studies.bench_spread as bench

    monkeypatch.setattr(bench, "COUNTS", (1_000,))
    figures = bench_spread()
    assert set(figures) == {f"spread.1000.{name}" for name in ("seconds", "plants_per_second", "plants")}
    assert 900 <= figures["spread.1000.plants"] <= 1000
