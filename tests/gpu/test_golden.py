"""Every kind of object that is drawn looks as it did; a bent branch is in test_bend.py."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from golden_picture import check_golden, skip_other_drivers
from windswept.geometry.detail import DetailRules
from windswept.gpu.meadow.blade_list import BladeRules
from windswept.render.staging import frame_now, stage
from windswept.scene.load_scene import load_scene
from windswept.scene.simulation import Simulation

SIZE = (176, 112)
AIR = """
seed = 3
[wind]
speed_m_s = 6.0
roughness_m = 0.05
"""
FOREST_EDGE = """
[ground]
kind = "hills"
size_m = 200.0
relief_m = 9.0
hill_length_m = 80.0

[[stand]]
count = 60
[stand.area]
rectangle = [-45.0, 15.0, 45.0, 80.0]
[[stand.source]]
source = "scots_pine"
spacing_m = 4.0
[[stand.source]]
source = "quaking_aspen"
spacing_m = 4.0

[camera]
eye = [-20.0, -22.0, 2.0]
target = [0.0, 40.0, 7.0]
"""
BALL_IN_FLOWERS = """
[ground]
size_m = 30.0

[field]
area = [-1.5, -1.5, 1.5, 1.5]
cell_m = 0.12
layer_m = 0.12
height_m = 1.2

[[field.agent]]
kind = "ball"
radius_m = 0.3
[[field.agent.stop]]
time_s = 0.0
position = [-1.4, 0.2]
[[field.agent.stop]]
time_s = 1.0
position = [0.4, -0.2]

[[stand]]
count = 160
[stand.area]
rectangle = [-1.5, -1.5, 1.5, 1.5]
[[stand.source]]
source = "tufted_hair_grass"
weight = 4
spacing_m = 0.1
[[stand.source]]
source = "common_poppy"
weight = 2
spacing_m = 0.1
[[stand.source]]
source = "oxeye_daisy"
spacing_m = 0.1

[camera]
eye = [0.2, -2.8, 1.3]
target = [0.0, 0.0, 0.2]
"""


def drawn(source: str, seconds: float, size: tuple[int, int] = SIZE) -> np.ndarray:
    """(height, width, 4) a scene after some seconds, in full detail."""
    simulation = Simulation(load_scene(source, 1)).advance(seconds)
    return stage(simulation, size, DetailRules(), BladeRules()).draw(frame_now(simulation))


def test_a_hazel_at_rest_looks_as_it_did(tmp_path: Path) -> None:
    skip_other_drivers()
    check_golden(drawn("hazel", 0.0, (160, 120)), "hazel", tmp_path)


@pytest.mark.parametrize(
    ("name", "scene"), [("forest_edge_on_hills", FOREST_EDGE), ("ball_in_flowers", BALL_IN_FLOWERS)]
)
def test_a_scene_in_motion_looks_as_it_did(name: str, scene: str, tmp_path: Path) -> None:
    skip_other_drivers()
    file = tmp_path / "scene.toml"
    file.write_text(AIR + scene)
    check_golden(drawn(str(file), 1.0), name, tmp_path)
