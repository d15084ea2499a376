"""What a meadow's rows say of its blades, wherever these go."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from windswept.gpu.meadow.meadow_rows import meadow_rows
from windswept.plants.underbrush import underbrush_names
from windswept.scene.load_scene import build_scene
from windswept.scene.simulation import Simulation

SLOPE = {"kind": "hills", "size_m": 40.0, "relief_m": 25.0, "hill_length_m": 20.0}


def blown(source: str, **more: Any) -> Simulation:
    """Tufts of a species after half a second of a gale."""
    stand = {
        "count": 12,
        "area": {"rectangle": [-2.0, -2.0, 2.0, 2.0]},
        "source": [{"source": source, "spacing_m": 0.1}],
    }
    camera = {"eye": [0.0, -4.0, 1.0], "target": [0.0, 0.0, 0.2]}
    scene = build_scene("m.toml", {"stand": [stand], "camera": camera, "wind": {"speed_m_s": 18.0}} | more)
    return Simulation(scene, picture_height=1000).advance(0.5)


def farthest(simulation: Simulation) -> np.ndarray:
    """(S,) distance of the outermost joint of every set from the middle of its chunk's ball, over the radius."""
    assert simulation.meadow is not None
    rows = meadow_rows(simulation.meadow.beds)
    out, first = [], 0
    for bed in simulation.meadow.beds:
        for pose in bed.pose(0.0):
            ball = rows.chunk_ball[rows.chunk[first : first + len(pose.joint)]].astype(np.float64)
            away = np.linalg.norm(pose.joint - ball[:, None, :3], axis=2) / ball[:, 3:]
            out.append(away.max())
            first += len(pose.joint)
    return np.array(out)


@pytest.mark.parametrize("source", underbrush_names())
def test_no_blade_leaves_its_chunks_ball(source: str) -> None:
    # Carried blades go where their stalks go: petals of a poppy by half a metre.
    away = farthest(blown(source))
    assert away.max() < 1.0
    assert away.min() > 0.2


def test_no_blade_leaves_its_chunks_ball_on_a_slope() -> None:
    assert farthest(blown("meadow_fescue", ground=SLOPE)).max() < 1.0
