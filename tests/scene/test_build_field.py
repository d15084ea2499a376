"""The field tables of a scene file: what they build, and one line for every mistake."""

import math
from typing import Any

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.forms.check_form import check_form
from windswept.forms.document import key_tables
from windswept.scene.build_field import build_field
from windswept.scene.field_form import FieldForm
from windswept.wind.field import (
    Ball,
    Box,
    Cylinder,
    FieldPlan,
    Helicopter,
    Line,
    Rain,
    Spheroid,
    Uniform,
    Walker,
)

STOPS = [{"time_s": 0.0, "position": [-5.0, 0.0]}, {"time_s": 4.0, "position": [5.0, 0.0]}]
BALL = {"kind": "ball", "stop": STOPS}
POST = {"kind": "post", "position": [3.0, 4.0], "radius_m": 0.5, "top_m": 6.0}
VORTEX = {"kind": "vortex", "position": [1, 2, 3], "strength_m2_s": 9.0}


def build(data: dict[str, Any]) -> FieldPlan:
    return build_field("test.toml", check_form("test.toml", FieldForm, data), 100.0, seed=7)


def test_left_out_it_covers_the_ground() -> None:
    plan = build({})
    assert plan.grid.origin == (-50.0, -50.0)
    assert plan.grid.shape == (101, 101, 16)
    assert plan.grid.cell == (1.0, 1.0, 1.0)
    assert plan.relaxation == 0.25


def test_area_and_cells() -> None:
    plan = build({"area": [-8, -4, 8.1, 4], "cell_m": 0.5, "layer_m": 0.25, "height_m": 2.0})
    assert plan.grid.origin == (-8.0, -4.0)
    assert plan.grid.shape == (34, 17, 9)


def test_everything_that_can_stand_flow_and_move() -> None:
    plan = build(
        {
            "primitive": [
                {"kind": "uniform", "velocity_m_s": [1, 2, 0], "start_s": 3.0},
                {"kind": "sink", "position": [1, 2, 3], "strength_m2_s": 4.0, "axis": "y", "core_m": 2.0},
                VORTEX | {"drift_m_s": [1.0, 0.0, 0.0], "end_s": 9.0},
            ],
            "obstacle": [
                {"kind": "sphere", "position": [1, 2], "radius_m": 3.0, "bottom_m": 1.0},
                {
                    "kind": "crown",
                    "position": [1, 2],
                    "radius_m": 3.0,
                    "bottom_m": 4.0,
                    "top_m": 12.0,
                    "openness": 0.4,
                },
                POST,
                {"kind": "box", "position": [1, 2], "size_m": [4.0, 6.0], "top_m": 3.0, "yaw_degrees": 90.0},
            ],
            "agent": [
                BALL | {"radius_m": 0.4},
                {"kind": "person", "stop": STOPS, "mass_kg": 50.0},
                {"kind": "helicopter", "stop": STOPS, "radius_m": 4.0},
                {"kind": "rain", "rate_mm_h": 10.0, "start_s": 2.0},
            ],
        }
    )
    assert plan.primitives == (
        Uniform((1.0, 2.0, 0.0), 3.0),
        Line((1.0, 2.0, 3.0), source=-4.0, core=2.0, axis=(0.0, 1.0, 0.0)),
        Line((1.0, 2.0, 3.0), vortex=9.0, drift=(1.0, 0.0, 0.0), end=9.0),
    )
    assert plan.obstacles == (
        Spheroid((1.0, 2.0, 4.0), 3.0, 3.0),
        Spheroid((1.0, 2.0, 8.0), 3.0, 4.0, 0.4),
        Cylinder((3.0, 4.0), 0.5, 6.0),
        Box((1.0, 2.0), (4.0, 6.0), 3.0, math.pi / 2),
    )
    ball, walker, helicopter, rain = plan.agents
    assert isinstance(ball, Ball)
    assert ball.radius == 0.4
    np.testing.assert_array_equal(ball.path.places, [[-5.0, 0.0], [5.0, 0.0]])
    assert isinstance(walker, Walker)
    assert walker.mass == 50.0
    assert isinstance(helicopter, Helicopter)
    assert helicopter.rotor_radius == 4.0
    assert helicopter.mass == 2000.0
    assert rain == Rain(10.0, seed=10, start=2.0)


BAD: dict[str, tuple[dict[str, Any], str]] = {
    "unknown key": ({"cel_m": 1.0}, "cel_m: expected a known key: did you mean cell_m?"),
    "unknown kind": ({"agent": [{"kind": "dog"}]}, "agent[0].kind = 'dog': expected one of"),
    "no cell": ({"cell_m": 0.0}, "cell_m = 0.0: expected a number from 0.05 to 100"),
    "no number": ({"height_m": math.nan}, "height_m = nan: expected a number from 0.1"),
    "upside down": ({"area": [5, 0, -5, 9]}, "field.area = [5.0, 0.0, -5.0, 9.0]: expected west below east"),
    "off the ground": ({"area": [0, 0, 60, 9]}, "expected an area on the ground, x and y from -50 to 50"),
    "too fine": ({"cell_m": 0.05}, "field.cell_m = 0.05: expected at least "),
    "no velocity": (
        {"primitive": [{"kind": "uniform"}]},
        "field.primitive[0].velocity_m_s: expected this key to be given for a uniform",
    ),
    "no strength": (
        {"primitive": [{"kind": "sink", "position": [0, 0, 0]}]},
        "field.primitive[0].strength_m2_s: expected this key to be given for a sink",
    ),
    "negative source": (
        {"primitive": [VORTEX | {"kind": "source", "strength_m2_s": -2.0}]},
        'field.primitive[0].strength_m2_s = -2.0: expected a number of 0 or more, or kind = "sink"',
    ),
    "ends first": (
        {"primitive": [VORTEX | {"start_s": 4.0, "end_s": 4.0}]},
        "field.primitive[0].end_s = 4.0: expected a time after start_s = 4",
    ),
    "key of another kind": (
        {"obstacle": [POST | {"size_m": [1.0, 2.0]}]},
        "field.obstacle[0].size_m: expected no such key of a post: it takes bottom_m, radius_m, top_m",
    ),
    "no radius": (
        {"obstacle": [{"kind": "sphere", "position": [0, 0]}]},
        "field.obstacle[0].radius_m: expected this key to be given for a sphere",
    ),
    "no top": (
        {"obstacle": [{"kind": "box", "position": [0, 0], "size_m": [1.0, 1.0]}]},
        "field.obstacle[0].top_m: expected this key to be given for a box",
    ),
    "top below bottom": (
        {"obstacle": [POST | {"bottom_m": 7.0}]},
        "field.obstacle[0].top_m = 6.0: expected a height above bottom_m = 7",
    ),
    "thin as nothing": (
        {"obstacle": [POST | {"radius_m": 0.0}]},
        "obstacle[0].radius_m = 0.0: expected a number",
    ),
    "one stop": (
        {"agent": [BALL | {"stop": STOPS[:1]}]},
        "field.agent[0].stop = 1: expected two stops or more",
    ),
    "stops out of order": (
        {"agent": [BALL | {"stop": [STOPS[1], STOPS[0]]}]},
        "field.agent[0].stop[1].time_s = 0.0: expected a time after 4",
    ),
    "dry rain": ({"agent": [{"kind": "rain"}]}, "field.agent[0].rate_mm_h: expected this key to be given"),
    "force of 10^6": (
        {"agent": [BALL | {"pressure_n_m2": 1e6}]},
        "pressure_n_m2 = 1000000.0: expected a number",
    ),
    "rolling rain": (
        {"agent": [{"kind": "rain", "rate_mm_h": 3.0, "stop": STOPS}]},
        "field.agent[0].stop: expected no such key of a rain: it takes",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_mistake_is_told_in_one_line(name: str) -> None:
    data, message = BAD[name]
    with pytest.raises(InputError) as caught:
        build(data)
    text = str(caught.value)
    assert message in text
    assert text.startswith("test.toml: ")
    assert "\n" not in text
    assert len(text) < 300


def test_every_key_has_its_line_in_the_document() -> None:
    text = key_tables(FieldForm)
    for heading in ("[[primitive]]", "[[obstacle]]", "[[agent]]", "[[agent.stop]]"):
        assert f"### {heading}" in text
    assert "| `openness` | a number from 0 to 0.95 | `0.0` |" in text


def test_too_fine_says_what_would_do() -> None:
    with pytest.raises(InputError) as caught:
        build({"cell_m": 0.05})
    coarser = float(caught.value.expected.split()[2])
    assert math.prod(build({"cell_m": coarser}).grid.shape) > 1 << 22
