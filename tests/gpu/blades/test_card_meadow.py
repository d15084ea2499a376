"""The whole chain of blades on the card, from wind and force field over leans to poses, beside the CPU's."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from windswept.gpu.meadow.blade_list import BladeRules
from windswept.gpu.meadow.layouts import POSED_JOINT
from windswept.gpu.meadow.meadow_rows import LEVELS
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.motion import TIME_STEP
from windswept.render.staging import frame_now, stage
from windswept.scene.load_scene import build_scene
from windswept.scene.scene import Scene
from windswept.scene.simulation import Simulation

STOPS = [
    {"time_s": 0.0, "position": [-1.2, 0.5]},
    {"time_s": 3.0, "position": [1.2, 0.6]},
    {"time_s": 9.0, "position": [-1.2, 0.4]},
]


def windy_meadow() -> Scene:
    """Tufts half inside a field through which a ball rolls, in turbulence and gusts."""
    area = {"rectangle": [-1.0, -1.0, 1.0, 1.0]}
    names = ("common_poppy", "meadow_fescue", "white_clover")
    stand = {
        "count": 36,
        "area": area,
        "source": [{"source": name, "spacing_m": 0.12} for name in names],
    }
    gusts = [
        {"start_s": start, "position": [-10.0, 0.0], "speed_m_s": 9.0, "strength_m_s": 6.0}
        for start in (0.0, 4.0, 7.0)
    ]
    field = {
        "area": [-1.3, 0.0, 1.3, 1.3],
        "cell_m": 0.1,
        "layer_m": 0.1,
        "height_m": 0.8,
        "agent": [{"kind": "ball", "radius_m": 0.2, "stop": STOPS}],
    }
    return build_scene(
        "meadow.toml",
        {
            "seed": 4,
            "stand": [stand],
            "field": field,
            "wind": {"speed_m_s": 5.0, "turbulence": 0.3, "gust": gusts},
            "camera": {"eye": [0.0, -4.0, 1.0], "target": [0.0, 0.0, 0.2]},
        },
    )


@pytest.fixture(scope="module")
def both() -> tuple[Simulation, GpuSimulation]:
    """The meadow on the CPU and on the card."""
    scene = windy_meadow()
    simulation = Simulation(scene, picture_height=100_000)
    assert simulation.meadow is not None
    return simulation, GpuSimulation(scene, [], beds=simulation.meadow.beds)


def posed_on_card(renderer: Any, card: GpuSimulation) -> dict[int, tuple[np.ndarray, np.ndarray]]:
    """First joint of every blade, in order, and all posed joints, set by set."""
    renderer.draw(frame_now(card))
    meadow, queue = renderer.meadow, renderer.canvas.device.queue
    items = np.frombuffer(queue.read_buffer(meadow.choice.items), np.uint32).reshape(-1, 4)
    items = items[: meadow.drawn_count]
    assert len(items) == card.meadow.blade_count  # type: ignore[union-attr]
    joints = np.frombuffer(queue.read_buffer(meadow._posed), POSED_JOINT)["place"][:, :3]
    order = items[np.argsort(items[:, 0])]
    return {s: (order[order[:, 2] // LEVELS == s, 1], joints) for s in np.unique(order[:, 2] // LEVELS)}


def gaps(simulation: Simulation, card: GpuSimulation, renderer: Any) -> tuple[float, float]:
    """Largest difference of a lean, and of a joint over the length of its blade and of what carries it."""
    assert simulation.meadow is not None
    assert card.meadow is not None
    ours, posed = iter(card.meadow.leaning.states), posed_on_card(renderer, card)
    ahead = simulation.time - simulation.step_count * TIME_STEP
    lean, joint, number = 0.0, 0.0, 0
    for bed in simulation.meadow.beds:
        reach: list[float] = []
        for blades, state, pose in zip(bed.blades, bed.states, bed.pose(ahead), strict=True):
            if state is not None:
                mine = next(ours)
                lean = max(lean, float(np.abs(mine.lean - state.lean).max()))
                np.testing.assert_array_equal(mine.broken, state.broken)
            own = float(blades.kind.table.length.sum() * blades.size.max())
            reach.append(own + (reach[blades.parent_kind] if blades.parent_kind >= 0 else 0.0))
            first, joints = posed[number]
            got = joints[first[:, None] + np.arange(pose.joint.shape[1])]
            joint = max(joint, float(np.linalg.norm(got - pose.joint, axis=2).max()) / reach[-1])
            number += 1
    return lean, joint


def test_ten_gusty_seconds_with_a_ball_from_wind_to_poses(device: Any, both: Any) -> None:
    simulation, card = both
    renderer = stage(card, (64, 48), blade_rules=BladeRules(1e-6, (1e-6, 1e-7), 1e4))
    assert {bed.air for bed in simulation.meadow.beds} == {0, 1}
    far, pushed = 0.0, 0
    for _ in range(10):
        simulation.advance(1.003)
        card.advance(1.003)
        lean, joint = gaps(simulation, card, renderer)
        # Asked are 1e-3 of a blade's length.
        assert lean < 5e-6
        assert joint < 1e-3
        pushed += bool(simulation.field.push.any())
        far = max(far, *(np.abs(state.lean).max() for state in card.meadow.leaning.states))
    assert far > 0.9
    assert 0 < pushed < 10
    assert card.clamped_count == simulation.clamped_count
