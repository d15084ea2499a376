"""``--multibody``: plants near the camera with all their links coupled."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from command_line import run, write_scene


def test_a_scene_is_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene, picture = write_scene(tmp_path, away=5.0), tmp_path / "a.png"
    assert run("render", scene, "-o", picture, "--size", "320x240", "--multibody", "--json") == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures["placements_by_level"] == [1]
    assert figures["stepped"] == figures["links"]
    assert picture.stat().st_size > 500


def test_springs_stand_below_multibody_with_their_error(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("levels", "coconut_palm", "--multibody", "--seconds", 1, "--json") == 0
    rows = json.loads(capsys.readouterr().out)["levels"]
    every_link = [row for row in rows if row["groups"] == 0]
    assert [row["motion"] for row in every_link] == ["multibody", "springs"]
    assert every_link[0] is rows[0]
    assert rows[0]["measured_max_m"] == 0.0
    springs = every_link[1]
    assert 0.0 < springs["measured_p95_m"] < springs["measured_max_m"] <= springs["bound_m"]


@pytest.mark.parametrize("command", [("render", "hazel", "-o", "x.png"), ("view", "hazel")])
def test_the_card_does_not_couple_links(
    command: tuple[str, ...],
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(*command, "--multibody", "--gpu") == 2
    error = capsys.readouterr().err
    assert len(error.strip().splitlines()) == 1
    assert "--multibody" in error
    assert not list(tmp_path.iterdir())
