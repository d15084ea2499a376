from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from windswept.cli import main
from windswept.gpu.device import shared_device
from windswept.studies import bench_bend, skjermo, skjermo_pictures, skjermo_plot


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """The study with trees of 128 branches, one of each size."""
    for module in (bench_bend, skjermo):
        monkeypatch.setattr(module, "STEMS", 128)
        monkeypatch.setattr(module, "PAPER", {256: 600.0})
    monkeypatch.setattr(skjermo, "DRAWN", (1,))
    monkeypatch.setattr(skjermo, "SIZE", (96, 64))
    monkeypatch.setattr(skjermo, "CARD_SECONDS", 0.05)
    monkeypatch.setattr(skjermo, "STEPS", 8)


@pytest.mark.parametrize("count", [1024, 4096])
def test_scenes_have_exactly_the_asked_branches(count: int) -> None:
    assert bench_bend.rows_of_trees(count).branch_count == count


def test_bytes_count_each_parent_once() -> None:
    branches = bench_bend.rows_of_trees(1024)
    parents = len(set(branches.parent.tolist()))
    assert bench_bend.bytes_per_branch(branches) * 1024 == pytest.approx(
        4 * (1024 * (15 + 4 + 15) + 15 * parents)
    )


def test_rows_stand_beside_the_papers(small: None, capsys: pytest.CaptureFixture[str]) -> None:
    main(["reproduce", "skjermo", "--json"])
    rows = json.loads(capsys.readouterr().out)
    bent = [row for row in rows if row["what"] == "bend"]
    assert {(row["mode"], row["branches"], row["paper_per_second"]) for row in bent} == {
        ("lagged", 256, 600.0),
        ("ordered", 256, 600.0),
    }
    assert len(bent) == 4
    assert all(row["per_second"] > 0.0 for row in rows)
    for row in bent:
        assert row["gap_max_m"] < 1e-5 if row["mode"] == "ordered" else 1e-4 < row["gap_max_m"] < 0.2
    # The lag is a property of the motion, not of who computes it.
    lags = [row["gap_max_m"] for row in bent if row["mode"] == "lagged"]
    assert lags[0] == pytest.approx(lags[1], rel=0.01)
    assert shared_device().adapter.info["device"] in bent[-1]["on"]


def test_figure_8_shows_every_rate_and_the_papers(tmp_path: Path) -> None:
    def row(what: str, on: str, branches: int, per_second: float, paper: float | None) -> dict[str, object]:
        mode, vertices = "lagged", 63 * branches * (what == "frames")
        return {"what": what, "mode": mode, "on": on, "branches": branches, "vertices": vertices} | {
            "per_second": per_second,
            "paper_per_second": paper,
            "paper_on": "an old card",
        }

    rows = [row("bend", on, 65_536, rate, 600.0) for on, rate in (("a CPU", 1e3), ("a card", 2e4))]
    rows += [row("frames", "a card", count, 2e6 / count, None) for count in (1024, 4096)]
    colours = {name: getattr(skjermo_plot, name) for name in ("PAPER", "CPU", "CARD", "FRAMES", "WOOD")}
    dots = {}
    for name, more in (("without", []), ("with", [row("wood", "a card", 2_000, 50.0, None)])):
        skjermo_plot.draw_frames(rows + more, tmp_path / f"{name}.png")
        pixels = picture(tmp_path / f"{name}.png")[:, :, :3]
        assert pixels.shape[:2] == skjermo_plot.SIZE[::-1]
        left, top, right, bottom = skjermo_plot.FRAME
        inside = pixels[top:bottom, left:right]
        near = {key: np.abs(inside - colour).max(axis=2) < 12 for key, colour in colours.items()}
        dots[name] = {key: np.argwhere(where).mean(axis=0) for key, where in near.items() if where.any()}
    assert set(dots["without"]) == {"PAPER", "CPU", "CARD", "FRAMES"}
    assert set(dots["with"]) == set(colours)
    heights = [dots["with"][name][0] for name in ("CARD", "CPU", "PAPER", "WOOD")]
    assert heights == sorted(heights)
    assert dots["with"]["FRAMES"][1] < dots["with"]["CPU"][1]


def test_a_file_where_the_folder_should_be_is_refused_before_any_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "taken").write_text("a file")
    with pytest.raises(SystemExit) as stopped:
        main(["reproduce", "skjermo", "-o", str(tmp_path / "taken")])
    assert stopped.value.code == 2
    assert "taken" in capsys.readouterr().err


def test_the_wood_leans_in_the_gust(tmp_path: Path) -> None:
    lines: list[str] = []
    skjermo_pictures.draw_wood(tmp_path, lines.append, trees=3, size=(128, 96))
    still, blown, strip = (picture(tmp_path / f"skjermo_{name}.png") for name in ("wood", "gust", "strip"))
    assert still.shape == blown.shape == (96, 128, 3)
    assert (np.abs(still - blown).max(axis=2) > 40).mean() > 0.01
    assert strip.shape == (48, 128, 3)
    assert len(lines) == 1


def picture(path: Path) -> np.ndarray:
    with Image.open(path) as image:
        return np.asarray(image).astype(int)
