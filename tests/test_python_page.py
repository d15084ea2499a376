"""docs/python.md: its example runs, and it names what is there."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import windswept

PAGE = (Path(__file__).parents[1] / "docs" / "python.md").read_text(encoding="utf-8")


def test_the_example_runs_and_says_what_it_promises(capsys: pytest.CaptureFixture[str]) -> None:
    [code] = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    names: dict[str, Any] = {}
    exec(compile(code, "docs/python.md", "exec"), names)
    assert len(capsys.readouterr().out.splitlines()) == 3
    plant, frequencies, base = names["plant"], names["frequencies"], names["base"]
    assert frequencies.shape == (3,)
    assert 0.05 < frequencies[0] <= frequencies[1] <= frequencies[2] < 5.0
    assert base.shape == names["tip"].shape == (1, plant.link_count, 3)
    assert 0.01 < names["sway"][0] < 0.5 * plant.height


def test_what_it_says_of_stems_is_so() -> None:
    plant = windswept.grow_source("hazel")
    for stem in (0, 3, len(plant.stem_parent) - 1):
        links = np.arange(plant.stem_link_start[stem], plant.stem_link_start[stem + 1])
        assert (plant.link_stem[links] == stem).all()
        np.testing.assert_allclose(plant.link_tip[links[:-1]], plant.link_base[links[1:]], atol=1e-5)


def test_every_public_name_is_on_it() -> None:
    untold = {"Plant", "Pose", "Scene", "grow", "load_species"}
    assert set(windswept.__all__) - untold <= set(re.findall(r"`(\w+)", PAGE))
