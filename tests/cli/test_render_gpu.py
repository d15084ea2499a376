"""``windswept render --gpu``: the simulation on the card, and on the CPU where the card has too little room."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import wgpu
from PIL import Image

from windswept.cli import main
from windswept.errors import GraphicsError
from windswept.gpu import failures, posing
from windswept.gpu.blades import leaning
from windswept.gpu.device import TIMESTAMPS, shared_device
from windswept.gpu.springs import simulation


def test_a_picture_of_a_plant_that_is_simulated_on_the_card(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "hazel.png"
    main(["render", "hazel", "-o", str(picture), "--size", "96x64", "--at", "0.5", "--gpu", "--json"])
    report = json.loads(capsys.readouterr().out)
    assert report["plants"] == sum(report["placements_by_level"]) == 1
    assert report["simulated_s"] == 0.5
    assert report["refused"] == 0
    assert "steps_per_second" not in report
    with Image.open(picture) as image:
        assert image.size == (96, 64)


def test_plants_without_room_are_told_of(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(posing, "MOST_BYTES", 64)
    picture = tmp_path / "hazel.png"
    main(["render", "hazel", "-o", str(picture), "--size", "96x64", "--at", "0.1", "--gpu", "--json"])
    said = capsys.readouterr()
    assert "1 plants found no room on the card" in said.err
    report = json.loads(said.out)
    assert (report["refused"], report["held_levels"]) == (1, 0)


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


MEADOW = """
[[plant]]
source = "common_poppy"
position = [0.0, 0.0]

[field]
area = [-1.0, -1.0, 1.0, 1.0]
cell_m = 0.1
layer_m = 0.1
height_m = 0.8

[[field.agent]]
kind = "ball"
radius_m = 0.2
stop = [{ time_s = 0.0, position = [-1.0, 0.0] }, { time_s = 1.0, position = [1.0, 0.0] }]

[camera]
eye = [0.0, -1.5, 0.6]
target = [0.0, 0.0, 0.3]
"""


def rendered(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> tuple[dict[str, Any], str]:
    """Report and stderr of a meadow in a force field with ``--gpu``."""
    scene, picture = tmp_path / "tuft.toml", tmp_path / "tuft.png"
    scene.write_text(MEADOW)
    main(["render", str(scene), "-o", str(picture), "--size", "96x64", "--at", "0.5", "--gpu", "--json"])
    said = capsys.readouterr()
    assert picture.exists()
    return json.loads(said.out), said.err


def test_underbrush_and_force_fields_run_on_the_card(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report, said = rendered(tmp_path, capsys)
    assert "CPU" not in said
    assert "steps_per_second" not in report
    assert (report["tufts"], report["plants"], report["clamped"]) == (1, 0, 0)
    assert report["blades"] > 10
    if TIMESTAMPS in shared_device().features:
        assert {"lean", "choose", "blades", "picture"} <= set(report["stage_ms"])


def test_blades_without_memory_on_the_card_are_stepped_by_the_cpu(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuses(*_arguments: object, **_named: object) -> None:
        raise wgpu.GPUOutOfMemoryError("")

    monkeypatch.setattr(leaning, "filled", refuses)
    report, said = rendered(tmp_path, capsys)
    assert "too little memory for the blades' motion" in said
    assert said.count("simulating on the CPU") == 1
    assert report["steps_per_second"] > 0


def test_a_card_that_is_lost_on_the_way_leaves_the_film_to_the_cpu(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def lost(*_arguments: object) -> None:
        raise wgpu.GPUError("the device is lost")

    monkeypatch.setattr(leaning.Leaning, "step", lost)
    monkeypatch.setattr(failures.shared_device, "cache_clear", lambda: None, raising=False)
    report, said = rendered(tmp_path, capsys)
    assert "the graphics card was lost while stepping plants" in said
    assert said.count("starting again on the CPU") == 1
    assert report["steps_per_second"] > 0
