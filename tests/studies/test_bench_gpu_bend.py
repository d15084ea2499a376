"""Passes of `bend` on the card are timed many at once, each once."""

from __future__ import annotations

import json
from collections.abc import Callable
from types import SimpleNamespace

import pytest

from windswept.cli import main
from windswept.gpu.bend.layouts import BENT_BRANCH, BRANCH, BREEZE
from windswept.gpu.buffers import UNIFORM_STRIDE
from windswept.studies import bench_bend, bench_gpu_bend
from windswept.wind.wind import calm


class Clock:
    """A card that takes passes and says that all of them together took so long."""

    def __init__(self, told: dict[str, float]) -> None:
        self.times = SimpleNamespace(read=lambda: told)
        self.taken: list[int] = []

    def step(self, _wind: object, _time: float, passes: int) -> None:
        self.taken.append(passes)

    def wait(self) -> None:
        pass


def test_the_command_measures_both_passes(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(bench_bend, "STEMS", 128)
    monkeypatch.setattr(bench_gpu_bend, "PAPER", {256: 600.0})
    monkeypatch.setattr(bench_gpu_bend, "REPEATS", 1)
    main(["bench", "gpu_bend", "--json"])
    figures = json.loads(capsys.readouterr().out)
    named = {name.removeprefix("gpu.bend.256."): value for name, value in figures.items()}
    for before in ("", "ordered_"):
        assert 256 * named[f"{before}ns_per_branch"] * named[f"{before}per_second"] == pytest.approx(
            1e9, rel=1e-3
        )
    assert named["times_paper"] == pytest.approx(named["per_second"] / 600.0, rel=1e-3)
    branches = bench_bend.rows_of_trees(256)
    parents = len(set(branches.parent.tolist()) - {-1})
    assert named["bytes_per_branch"] == pytest.approx(96 + 64 + 64 * parents / 256, rel=1e-3)
    rows = 256 * (BRANCH.itemsize + 2 * BENT_BRANCH.itemsize)
    uniforms = BREEZE.itemsize + (1 + branches.level_count) * UNIFORM_STRIDE
    assert named["bytes"] == pytest.approx(rows + uniforms, rel=1e-3)


@pytest.mark.parametrize(
    ("software", "told", "expected"),
    [
        (False, {"bend": 50.0}, 0.05 / bench_gpu_bend.PASSES),
        (False, {}, 2.0 / bench_gpu_bend.PASSES),
        (True, {"bend": 50.0}, 2.0 / bench_gpu_bend.SOFTWARE_PASSES),
    ],
)
def test_a_pass_by_the_cards_clock_or_the_one_on_the_wall(
    monkeypatch: pytest.MonkeyPatch, software: bool, told: dict[str, float], expected: float
) -> None:
    monkeypatch.setattr(bench_gpu_bend, "is_software", lambda device: software)
    card = Clock(told)

    def two_seconds(run: Callable[[], object], _repeats: int) -> float:
        run()
        return 2.0

    monkeypatch.setattr(bench_gpu_bend, "median_seconds", two_seconds)
    assert bench_gpu_bend._seconds(card, card.step, calm()) == pytest.approx(expected)
    passes = bench_gpu_bend.SOFTWARE_PASSES if software else bench_gpu_bend.PASSES
    assert set(card.taken) == {passes}
