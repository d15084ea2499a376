"""A card that is lost before the first picture: a simulation on it starts again on the CPU; otherwise one line."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from windswept.cli import main
from windswept.gpu import device, failures, renderer
from windswept.gpu.frame import Frame
from windswept.gpu.renderer import Renderer
from windswept.gpu.springs import simulation


@pytest.fixture(autouse=True)
def _lost_at_the_first_draw(monkeypatch: pytest.MonkeyPatch) -> None:
    """Devices of this test's own, of which the first is destroyed when it is to draw."""
    own: Any = cache(device.shared_device.__wrapped__)
    for module in (simulation, renderer, failures):
        monkeypatch.setattr(module, "shared_device", own)
    draw, first = Renderer.draw, own()

    def draw_or_lose(self: Renderer, frame: Frame) -> NDArray[np.uint8]:
        if self.canvas.device is first:
            first.destroy()
        return draw(self, frame)

    monkeypatch.setattr(Renderer, "draw", draw_or_lose)


@pytest.mark.parametrize("ending", ["png", "webp"])
def test_a_simulation_on_the_card_starts_again_on_the_cpu(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], ending: str
) -> None:
    film = tmp_path / f"hazel.{ending}"
    span = ["--at", "0.1"] if ending == "png" else ["--duration", "0.1"]
    main(["render", "hazel", "-o", str(film), "--size", "48x32", *span, "--gpu", "--json"])
    said = capsys.readouterr()
    assert "the graphics card was lost while" in said.err
    assert said.err.count("starting again on the CPU") == 1
    assert json.loads(said.out)["steps_per_second"] > 0
    assert film.exists()


def test_a_picture_of_a_simulation_on_the_cpu_ends_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "hazel.png"
    with pytest.raises(SystemExit) as end:
        main(["render", "hazel", "-o", str(picture), "--size", "48x32", "--at", "0.1"])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert said.count("windswept: the graphics card was lost while drawing pictures") == 1
    assert "Traceback" not in said
    assert not picture.exists()
