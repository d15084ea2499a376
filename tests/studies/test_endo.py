"""Endo's fields: what stands in them, and pictures after the paper's figures."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.scene.meadow import Meadow, plant_meadow
from windswept.studies.endo import EVERY_BLADE, FLOWER_STEMS, LEAVES, _count, endo, flower_field, tufts_for
from windswept.studies.endo_pictures import bending


def test_two_hundred_flowers_with_a_thousand_leaves() -> None:
    meadow = Meadow(plant_meadow(flower_field(), EVERY_BLADE))
    assert _count(meadow, FLOWER_STEMS) == pytest.approx(200, rel=0.1)
    assert _count(meadow, LEAVES) == pytest.approx(1000, rel=0.1)


def test_fields_have_the_blades_that_were_asked_for() -> None:
    assert tufts_for(10_000) == pytest.approx(10_000 / 70, rel=0.1)


def test_rows_beside_the_paper(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("windswept.studies.endo.TUFTS", 6)
    monkeypatch.setattr("windswept.studies.endo.FLOWERS", {"common_poppy": 2})
    monkeypatch.setattr("windswept.studies.endo.SIZE", (64, 64))
    grass, flowers, more = endo(counts=(800,))
    assert grass["paper_fps"] == flowers["paper_fps"] == [10.0, 20.0]
    assert more["paper_fps"] is None
    assert grass["tufts"] == 6
    assert flowers["flowers"] == 6
    assert more["blades"] == pytest.approx(800, rel=0.15)
    for row in (grass, flowers, more):
        assert 0 < row["blades_drawn"] <= row["blades"]
        assert min(row["frames_per_second"], row["steps_per_second"], row["ns_per_blade_step"]) > 0.0


def test_the_bending_blade_sinks_stage_by_stage() -> None:
    panels = np.split(bending(), 4, axis=1)
    green = [(panel[..., 1].astype(int) - panel[..., 0] > 30) for panel in panels]
    rows = [np.average(np.arange(mask.shape[0]), weights=mask.sum(axis=1)) for mask in green]
    assert rows == sorted(rows), "from above: each stage hangs lower"
