"""``--multibody``: plants near the camera with all their links coupled."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

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


def test_the_card_couples_links_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = write_scene(tmp_path, away=5.0)
    options = ("--size", "320x240", "--at", 1, "--multibody", "--json")
    assert run("render", scene, "-o", tmp_path / "cpu.png", "--no-levels", *options) == 0
    assert run("render", scene, "-o", tmp_path / "card.png", "--gpu", *options) == 0
    cpu, card = (json.loads(line) for line in capsys.readouterr().out.splitlines())
    assert card["stepped"] == card["links"] == cpu["stepped"]
    assert "steps_per_second" not in card
    pictures = []
    for name in ("cpu", "card"):
        with Image.open(tmp_path / f"{name}.png") as image:
            pictures.append(np.asarray(image).astype(int))
    assert np.abs(pictures[0] - pictures[1]).mean() < 0.1
