"""Damping by branching: a crown tuned to its trunk decays faster than any of its branches by itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from windswept.plants.weber_penn import grow
from windswept.studies.branching_plot import draw_branching
from windswept.studies.multibody_branching import (
    DAMPING_RATIO,
    airless,
    damping_ratio,
    free_sway,
    trunk_alone,
    tuned_to_trunk,
)


def test_a_crown_damps_itself(tmp_path: Path) -> None:
    tree = tuned_to_trunk(airless(grow("scots_pine", 0)))
    crown, trunk = free_sway(tree, 6.0), free_sway(trunk_alone(tree), 6.0)
    assert damping_ratio(crown) > 2.0 * DAMPING_RATIO
    assert damping_ratio(trunk) == pytest.approx(DAMPING_RATIO, rel=0.15)
    # Joints that swing each for itself cannot show it.
    assert damping_ratio(free_sway(tree, 6.0, decoupled=True)) == pytest.approx(DAMPING_RATIO, rel=0.15)
    picture = tmp_path / "sway.png"
    sways = {"crown": (crown.periods, crown.displacement), "trunk": (trunk.periods, trunk.displacement)}
    draw_branching(sways, {"crown": 0.05, "trunk": 0.02}, DAMPING_RATIO, picture)
    assert np.frombuffer(picture.read_bytes()[16:20], ">u4")[0] == 1400
