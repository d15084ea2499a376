"""balls_now: where the balls of a scene's force field are, as the renderer takes them."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from windswept.plants.plant import Floats
from windswept.scene.scene import Scene
from windswept.wind.field import Ball

MOMENT = 1e-3
"""Over which a ball's direction is taken, s."""


def balls_now(scene: Scene, time: float) -> Floats:
    """(n, 8) middle and radius, m, and quaternion of every ball that is on its path: it rolls and does not slide."""
    agents = () if scene.field is None else scene.field.agents
    rows = []
    for ball in (agent for agent in agents if isinstance(agent, Ball) and agent.path.covers(time)):
        x, y = ball.path.place(time)
        vx, vy = ball.path.velocity(time - MOMENT, time + MOMENT)
        speed = max(float(np.hypot(vx, vy)), 1e-9)
        turn = ball.path.length(time) / ball.radius
        rolled = Rotation.from_rotvec(turn * np.array([-vy, vx, 0.0]) / speed).as_quat()
        middle = float(scene.terrain.height(x, y)) + ball.radius
        rows.append([x, y, middle, ball.radius, *rolled])
    return np.array(rows, np.float32).reshape(-1, 8)
