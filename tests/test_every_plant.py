"""Every built-in species and grammar grows, stands ten seconds of gusty wind of 15 m/s, and can be drawn."""

import numpy as np
import pytest

from windswept.plants.plant import Plant
from windswept.plants.sources import grow_source, source_names
from windswept.plants.validate import validate
from windswept.scene.camera import View
from windswept.scene.load_scene import build_scene
from windswept.scene.scene import Scene
from windswept.scene.simulation import Simulation

pytestmark = pytest.mark.slow

STORM = {"speed_m_s": 15.0, "turbulence": 0.3, "gust": [{"start_s": 2.0, "strength_m_s": 8.0}]}


def storm_over(source: str) -> Scene:
    """A scene with one plant in the wind."""
    tables = {
        "plant": [{"source": source, "position": [0.0, 0.0]}],
        "wind": STORM,
        "camera": {"eye": [0.0, -30.0, 2.0], "target": [0.0, 0.0, 6.0]},
    }
    return build_scene("storm.toml", tables)


def reach(plant: Plant) -> np.ndarray:
    """(L,) longest way from the root to every link's base along the wood, m."""
    length = np.linalg.norm(plant.link_tip - plant.link_base, axis=1)
    way = np.zeros(plant.link_count)
    for link in np.flatnonzero(plant.link_parent >= 0):
        up = plant.link_parent[link]
        way[link] = way[up] + plant.link_attach[link] * length[up]
    return way


@pytest.mark.parametrize("source", source_names())
def test_grows_and_stands_a_storm(source: str) -> None:
    plant = grow_source(source)
    validate(plant)
    again = grow_source(source)
    for name in ("link_base", "link_tip", "link_radius_base", "leaf_position", "leaf_normal"):
        assert getattr(plant, name).tobytes() == getattr(again, name).tobytes()
    simulation = Simulation(storm_over(source), [plant])
    moved = 0.0
    for _ in range(5):
        pose = simulation.advance(2.0).pose[0]
        position, rotation = pose.position[0], pose.rotation[0]
        assert np.isfinite(position).all()
        assert np.abs(np.linalg.norm(rotation, axis=1) - 1.0).max() < 1e-3
        assert (np.linalg.norm(position - plant.link_base[0], axis=1) <= 1.001 * reach(plant) + 1e-3).all()
        moved = max(moved, float(np.abs(position - plant.link_base).max()))
    assert 1e-4 < moved / plant.height < 2.0


@pytest.mark.parametrize("source", source_names())
def test_is_drawn(source: str) -> None:
    from windswept.render.staging import frame_now, stage

    plant = grow_source(source)
    simulation = Simulation(storm_over(source), [plant]).advance(1.0)
    far = 3.0 * max(plant.height, 0.3)
    middle = np.array([0.0, 0.0, 0.5 * plant.height])
    eye = middle - np.array([0.0, far, 0.0])
    renderer = stage(simulation, (96, 96))
    with_plant = renderer.draw(frame_now(simulation, View(eye, middle, 0.6)))
    assert with_plant.shape == (96, 96, 4)
    assert with_plant[..., :3].std() > 5.0
