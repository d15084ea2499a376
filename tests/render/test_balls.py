"""Balls of the force field in the picture: where they are, that they roll, and that they are seen."""

from __future__ import annotations

import re
from dataclasses import replace
from importlib.resources import files
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from windswept.gpu import layouts
from windswept.gpu.balls import VERTICES
from windswept.render.balls import balls_now
from windswept.render.staging import frame_now, stage
from windswept.scene.load_scene import build_scene
from windswept.scene.simulation import Simulation

RADIUS, SPEED = 0.5, 2.0


@pytest.fixture(scope="module")
def rolling() -> Simulation:
    stops = [{"time_s": 0.0, "position": [-2.0, 0.0]}, {"time_s": 2.0, "position": [2.0, 0.0]}]
    ball: dict[str, Any] = {"kind": "ball", "radius_m": RADIUS, "stop": stops}
    data = {
        "plant": [{"source": "white_clover", "position": [0.0, 1.0]}],
        "camera": {"eye": [0.0, -6.0, 1.0], "target": [0.0, 0.0, 0.5]},
        "ground": {"size_m": 20.0},
        "field": {
            "area": [-3.0, -3.0, 3.0, 3.0],
            "cell_m": 0.5,
            "height_m": 2.0,
            "layer_m": 0.5,
            "agent": [ball],
        },
    }
    return Simulation(build_scene("ball.toml", data))


def test_a_ball_rolls_and_does_not_slide(rolling: Simulation) -> None:
    """The point that touches the ground stands still: v + omega x (-r up) = 0."""
    turns = []
    for moment in (0.5, 0.51):
        rolling.time = moment
        (row,) = balls_now(rolling.scene, rolling.time)
        np.testing.assert_allclose(row[:4], [-2.0 + SPEED * moment, 0.0, RADIUS, RADIUS], atol=1e-6)
        turns.append(Rotation.from_quat(row[4:]))
    omega = (turns[1] * turns[0].inv()).as_rotvec() / 0.01
    np.testing.assert_allclose(np.cross(omega, [0.0, 0.0, -RADIUS]), [-SPEED, 0.0, 0.0], atol=1e-3)


def test_there_is_no_ball_after_its_last_stop(rolling: Simulation) -> None:
    rolling.time = 3.0
    assert len(balls_now(rolling.scene, rolling.time)) == 0


def test_it_is_seen_and_throws_a_shadow(rolling: Simulation) -> None:
    renderer = stage(rolling, (160, 96))
    rolling.time = 1.0
    frame = frame_now(rolling)
    with_ball, without = (
        renderer.draw(frame),
        renderer.draw(replace(frame, balls=np.zeros((0, 8), np.float32))),
    )
    changed = with_ball.astype(int) - without.astype(int)
    red = changed[..., 0] - changed[..., 1] > 40
    assert 0.01 < red.mean() < 0.2
    assert (changed[..., :3].sum(axis=2) < -60).mean() > 0.001


def test_the_shader_draws_as_many_corners() -> None:
    source = (files("windswept.gpu") / "shaders" / "balls.wgsl").read_text()
    rings, sides = (int(re.findall(rf"const {name} = (\d+)u;", source)[0]) for name in ("RINGS", "SIDES"))
    assert 6 * rings * sides == VERTICES
    fields = re.findall(
        r"^    (\w+): (vec4f),", source.split("struct BallRow")[1].split("}")[0], re.MULTILINE
    )
    assert np.dtype([(name, *layouts.REALS) for name, _ in fields]) == layouts.BALL
