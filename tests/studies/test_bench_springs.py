"""``bench springs`` and ``bench multibody`` beside MuJoCo, and without it."""

from __future__ import annotations

import sys
from typing import Any

import pytest

from windswept.studies import bench_multibody, bench_springs

FEW = ((60, 8),)
BENCHES = (
    (bench_springs.bench_springs, "springs.60x8"),
    (bench_multibody.bench_multibody, "multibody.60x8"),
)


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (bench_springs, bench_multibody):
        monkeypatch.setattr(module, "SIZES", FEW)
    monkeypatch.setattr(bench_springs, "triad_bandwidth", lambda: 1e9)


@pytest.mark.parametrize(("bench", "name"), BENCHES)
def test_figures_stand_beside_mujocos(bench: Any, name: str) -> None:
    figures = bench()
    theirs, ours = figures[f"{name}.mujoco_ns_per_link_step"], figures[f"{name}.ns_per_link_step"]
    assert figures[f"{name}.times_mujoco"] == pytest.approx(theirs / ours)


@pytest.mark.parametrize(("bench", "name"), BENCHES)
def test_without_mujoco_its_figures_are_left_out_and_a_line_says_so(
    bench: Any, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    said: list[str] = []
    figures = bench(said.append)
    assert figures[f"{name}.ns_per_link_step"] > 0.0
    assert not any("mujoco" in key for key in figures)
    assert sum("pip install mujoco" in line for line in said) == 1
