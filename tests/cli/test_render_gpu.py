"""``windswept render --gpu``: the simulation on the card, and on the CPU where the card has too little room."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PIL import Image

from windswept.cli import main
from windswept.errors import GraphicsError
from windswept.gpu.springs import simulation


def test_a_picture_of_a_plant_that_is_simulated_on_the_card(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "hazel.png"
    main(["render", "hazel", "-o", str(picture), "--size", "96x64", "--at", "0.5", "--gpu", "--json"])
    report = json.loads(capsys.readouterr().out)
    assert report["plants"] == sum(report["placements_by_level"]) == 1
    assert report["simulated_s"] == 0.5
    assert "steps_per_second" not in report
    with Image.open(picture) as image:
        assert image.size == (96, 64)


def test_too_little_memory_is_said_and_the_cpu_goes_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_arguments: object) -> None:
        raise GraphicsError("the simulation needs 9 MB")

    monkeypatch.setattr(simulation, "rung_arrays", full)
    picture = tmp_path / "hazel.png"
    main(["render", "hazel", "-o", str(picture), "--size", "96x64", "--at", "0.1", "--gpu", "--json"])
    said = capsys.readouterr()
    assert "needs 9 MB; simulating on the CPU" in said.err
    assert json.loads(said.out)["steps_per_second"] > 0
    assert picture.exists()


def test_underbrush_is_simulated_on_the_cpu_and_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene, picture = tmp_path / "tuft.toml", tmp_path / "tuft.png"
    scene.write_text(
        '[[plant]]\nsource = "common_poppy"\nposition = [0.0, 0.0]\n'
        "[camera]\neye = [0.0, -1.5, 0.6]\ntarget = [0.0, 0.0, 0.3]\n"
    )
    main(["render", str(scene), "-o", str(picture), "--size", "96x64", "--at", "0.1", "--gpu"])
    assert "underbrush and force fields are not simulated on the card" in capsys.readouterr().err
    assert picture.exists()
