"""The thesis' table and pictures, made on a small tree."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from windswept.levels import build_ladder, simplify
from windswept.levels.cut_level import cut_level
from windswept.motion import build_model
from windswept.studies.beaudoin import PAPER, beaudoin, oscillator_count, tolerance_for
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.level_costs import levels_bytes, plant_bytes
from windswept.studies.merges import links_needed


@pytest.mark.slow
def test_the_table_stands_beside_the_papers_and_ours_errs_less(tmp_path: Path) -> None:
    rows = beaudoin(2000, seconds=2.0, folder=tmp_path)
    assert [row["paper_branches"] for row in rows] == [count for count, _ in PAPER]
    for row, (count, _) in zip(rows[:-2], PAPER, strict=False):
        assert row["branches"] == pytest.approx(2000 * count / PAPER[0][0], rel=0.25)
    assert rows[0]["rms_over_motion"] == 0.0
    assert rows[0]["speedup"] == 1.0
    for row in rows[1:]:
        assert 0.0 < row["rms_over_motion"] < row["printed_rms_over_motion"]
        assert row["max_m"] <= row["bound_m"]
        assert row["p95_m"] <= row["max_m"]
    for name in ("beaudoin_levels.png", "beaudoin_strip.png"):
        picture = np.asarray(Image.open(tmp_path / name))
        assert picture.shape[1] == len(PAPER) * 360
        assert picture.std() > 20.0


def test_a_wanted_count_is_met_as_nearly_as_the_tree_allows() -> None:
    hierarchy = simplify(build_model(plant_with_links(1000)))
    for count in (500, 100, 10):
        level = cut_level(hierarchy, tolerance_for(hierarchy, count))
        assert 0.6 * count <= oscillator_count(level) <= count


def test_our_merges_need_fewer_links_and_less_memory_than_the_plant() -> None:
    plant = plant_with_links(2000)
    ladder = build_ladder(simplify(build_model(plant)))
    needed = links_needed(ladder, 2.0)
    assert 3.0 * needed.ours < needed.printed
    assert levels_bytes(ladder) < plant_bytes(plant, ladder.levels[0])
