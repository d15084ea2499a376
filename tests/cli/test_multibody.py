"""``--multibody``: plants near the camera with all their links coupled."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

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


def drawn_by_both(
    folder: Path, capsys: pytest.CaptureFixture[str], away: float, *options: object
) -> tuple[dict[str, Any], dict[str, Any], float]:
    """What the CPU and the card say of a scene under multibody, and how far their pictures part, in 255ths."""
    scene = write_scene(folder, away)
    more = ("--size", "320x240", "--at", 1, "--multibody", "--json", *options)
    assert run("render", scene, "-o", folder / "cpu.png", *more) == 0
    assert run("render", scene, "-o", folder / "card.png", "--gpu", *more) == 0
    cpu, card = (json.loads(line) for line in capsys.readouterr().out.splitlines())
    pictures = []
    for name in ("cpu", "card"):
        with Image.open(folder / f"{name}.png") as image:
            pictures.append(np.asarray(image).astype(int))
    return cpu, card, float(np.abs(pictures[0] - pictures[1]).mean())


def test_the_card_couples_links_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cpu, card, apart = drawn_by_both(tmp_path, capsys, 5.0, "--no-levels")
    assert card["stepped"] == card["links"] == cpu["stepped"]
    assert "steps_per_second" not in card
    assert apart < 1e-3


def test_the_card_leaves_multibody_far_from_the_camera_as_the_cpu_does(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cpu, card, apart = drawn_by_both(tmp_path, capsys, 40.0, "--level-colours")
    assert card["placements_by_level"] == cpu["placements_by_level"]
    assert len(card["placements_by_level"]) > 1
    assert card["stepped"] == cpu["stepped"] < card["links"]
    assert apart < 1e-3
