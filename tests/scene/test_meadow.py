"""The underbrush of a scene in motion: beds, wind, field, levels by distance."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from windswept.scene.load_scene import build_scene
from windswept.scene.meadow_air import MeadowAir
from windswept.scene.scene import Scene
from windswept.scene.simulation import Simulation
from windswept.wind.mean import MeanWind
from windswept.wind.wind import Wind, calm

CAMERA = {"eye": [0.0, -9.0, 1.5], "target": [0.0, 0.0, 0.5]}


def turf(count: int = 6, source: str = "meadow_fescue", half: float = 1.0, **more: Any) -> Scene:
    """Tufts of one species round the origin."""
    stand = {
        "count": count,
        "area": {"rectangle": [-half, -half, half, half]},
        "source": [{"source": source, "spacing_m": 0.1}],
    }
    return build_scene("turf.toml", {"stand": [stand], "camera": CAMERA} | more)


def leans(simulation: Simulation) -> np.ndarray:
    assert simulation.meadow is not None
    states = [state for bed in simulation.meadow.beds for state in bed.states if state is not None]
    return np.concatenate([state.lean for state in states])


def test_stands_and_plants_of_underbrush_become_colonies() -> None:
    plant = {"source": "oxeye_daisy", "position": [2.0, 0.0], "yaw_degrees": 90.0}
    scene = turf(plant=[plant])
    assert scene.kinds == ()
    assert {colony.source: colony.count for colony in scene.colonies} == {
        "oxeye_daisy": 1,
        "meadow_fescue": 6,
    }
    daisy = next(colony for colony in scene.colonies if colony.source == "oxeye_daisy")
    np.testing.assert_allclose(daisy.position[0, :2], [2.0, 0.0])
    np.testing.assert_allclose(daisy.yaw, np.pi / 2, rtol=1e-6)


def test_calm_air_leaves_every_blade_at_rest() -> None:
    simulation = Simulation(turf())
    simulation.wind = calm()
    simulation.step_count = 0
    simulation._sample_winds()
    simulation.advance(0.5)
    assert not leans(simulation).any()


def test_blades_lean_downwind_and_the_frame_rate_does_not_matter() -> None:
    ends = []
    for rate in (30, 144):
        simulation = Simulation(turf(wind={"speed_m_s": 6.0, "turbulence": 0.0}))
        for _ in range(rate):
            simulation.advance(1.0 / rate)
        ends.append(leans(simulation))
    np.testing.assert_array_equal(*ends)
    assert simulation.meadow is not None
    bed = simulation.meadow.beds[0]
    still = [blades.base for blades in bed.blades]
    tips = np.concatenate([pose.tip for pose in bed.pose(0.0)[:1]]) - still[0]
    rest = np.concatenate([pose.tip for pose in Simulation(turf()).meadow.beds[0].pose(0.0)[:1]]) - still[0]  # type: ignore[union-attr]
    assert ((tips - rest)[:, 0] > 0.0).all()


def test_a_ball_presses_down_what_it_rolls_over_and_nothing_else() -> None:
    stops = [{"time_s": 0.0, "position": [-3.0, 0.0]}, {"time_s": 2.0, "position": [3.0, 0.0]}]
    ball = {"kind": "ball", "radius_m": 0.3, "stop": stops}
    field = {"area": [-2.0, -2.0, 2.0, 2.0], "cell_m": 0.1, "layer_m": 0.1, "height_m": 0.8, "agent": [ball]}
    simulation = Simulation(turf(200, wind={"speed_m_s": 0.0}, field=field))
    simulation.advance(1.0)
    assert simulation.meadow is not None
    (bed,) = simulation.meadow.beds
    assert bed.in_field
    lean = np.linalg.norm(bed.states[0].lean, axis=1)  # type: ignore[union-attr]
    x, y, _ = np.abs(bed.blades[0].base).T
    assert lean[(x < 0.15) & (y < 0.15)].mean() > 0.3
    assert lean[y > 0.7].max() < 0.05
    assert simulation.clamped_count == 0


def test_a_tuft_outside_the_field_is_not_pushed_by_its_border() -> None:
    field = {"area": [-1.0, -1.0, 1.0, 1.0], "cell_m": 0.2, "layer_m": 0.2, "height_m": 1.0}
    plant = {"source": "meadow_fescue", "position": [5.0, 0.0]}
    simulation = Simulation(turf(plant=[plant], field=field))
    assert simulation.meadow is not None
    assert sorted(bed.in_field for bed in simulation.meadow.beds) == [False, True]


def test_the_field_reaches_the_trees() -> None:
    tree = {"source": "hazel", "position": [0.0, 0.0]}
    field = {
        "cell_m": 2.0,
        "height_m": 8.0,
        "primitive": [{"kind": "uniform", "velocity_m_s": [8.0, 0.0, 0.0], "start_s": -10.0}],
    }
    data = {"plant": [tree], "camera": CAMERA, "ground": {"size_m": 40.0}, "wind": {"speed_m_s": 0.0}}
    without, within = (Simulation(build_scene("t.toml", data | more)) for more in ({}, {"field": field}))
    assert without.wind_speeds[0][0] == pytest.approx(0.0)
    assert within.wind_speeds[0][0] > 4.0


def test_far_tufts_are_planted_fewer_and_wider_with_their_area_kept() -> None:
    near, far = (
        Simulation(turf(40, camera={"eye": [0.0, -away, 1.0], "target": [0.0, 0.0, 0.5]})).meadow
        for away in (2.0, 70.0)
    )
    assert near is not None
    assert far is not None
    assert far.blade_count < 0.2 * near.blade_count
    for kind in range(2):
        whole, merged = (
            sum(bed.blades[kind].count * bed.stands_for[kind] for bed in meadow.beds)
            for meadow in (near, far)
        )
        assert merged == pytest.approx(whole, rel=0.25), "which tufts are left out is chance"


def test_the_wind_grid_is_the_wind_at_its_nodes() -> None:
    scene = turf(wind={"speed_m_s": 5.0, "turbulence": 0.3})
    simulation = Simulation(scene)
    assert simulation.meadow is not None
    (air,) = MeadowAir(simulation.meadow.beds).sample(Wind(mean=MeanWind(3.0, 0.4)), None, 1.0)
    nodes = air.nodes.reshape(-1, 8)
    assert np.hypot(nodes[:, 0], nodes[:, 1]).max() < 3.0, "below 10 m it blows less"
    np.testing.assert_allclose(np.arctan2(nodes[:, 1], nodes[:, 0])[1:], 0.4, rtol=1e-5)
