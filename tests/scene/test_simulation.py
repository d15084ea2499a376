"""A scene in motion: frame-rate independence, calm, determinism, gusts that travel, neighbours out of step."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import random_tree
from windswept.plants.plant import Plant
from windswept.scene.load_scene import load_scene
from windswept.scene.scene import Placements, PlantKind, Scene
from windswept.scene.simulation import Simulation
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind
from windswept.wind.wind import Wind, calm


def row_of_trees(wind: Wind, count: int = 6, spacing: float = 10.0) -> tuple[Scene, list[Plant]]:
    """The same tree ``count`` times along +x, each turned another way."""
    position = np.zeros((count, 3), np.float32)
    position[:, 0] = spacing * np.arange(count)
    yaw = np.linspace(0.0, 5.0, count).astype(np.float32)
    scene = replace(
        load_scene("hazel"),
        wind=wind,
        kinds=(PlantKind("handmade", 0),),
        placements=(Placements(position, yaw),),
    )
    return scene, [random_tree(0)]


def tops(simulation: Simulation) -> np.ndarray:
    """(P, 3) displacement of the highest joint of every placement, in the world's axes."""
    kind, pose = simulation.kinds[0], simulation.pose[0]
    top = int(np.argmax(kind.plant.link_base[:, 2]))
    moved = pose.position[:, top] - kind.plant.link_base[top]
    yaw = kind.placements.yaw
    cosine, sine = np.cos(yaw), np.sin(yaw)
    x, y = moved[:, 0], moved[:, 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, moved[:, 2]], axis=1)


@pytest.fixture(scope="module")
def breezy() -> Wind:
    return load_scene("hazel").wind


@pytest.mark.parametrize("levels", [False, True])
def test_frame_rate_does_not_matter(breezy: Wind, levels: bool) -> None:
    ends, poses, amplitude = [], [], 0.0
    for rate in (30, 60, 144):
        scene, plants = row_of_trees(breezy)
        simulation = Simulation(scene, plants, levels=levels)
        for _ in range(10 * rate):
            simulation.advance(1.0 / rate)
            amplitude = max(amplitude, float(np.abs(tops(simulation)).max()))
        assert simulation.step_count == 1200
        ends.append([one.state.joints.copy() for one in simulation.kinds[0].sets])
        poses.append(simulation.pose[0].link.copy())
    assert amplitude > 0.01
    for other in (1, 2):
        for first, second in zip(ends[0], ends[other], strict=True):
            assert np.array_equal(first, second)
        # The pose goes on from the last step to the sum of all frames' times, which is rounded.
        np.testing.assert_allclose(poses[0], poses[other], atol=1e-5)


def test_calm_is_still() -> None:
    scene, plants = row_of_trees(calm())
    simulation = Simulation(scene, plants)
    at_first = simulation.pose[0].link.copy()
    simulation.advance(3.0)
    assert not simulation.kinds[0].sets[0].state.joints.any()
    assert np.array_equal(simulation.pose[0].link, at_first)
    assert np.abs(tops(simulation)).max() < 1e-6


def test_pose_between_steps_is_smooth(breezy: Wind) -> None:
    scene, plants = row_of_trees(breezy, count=1)
    simulation = Simulation(scene, plants).advance(3.0)
    track = []
    for _ in range(200):
        simulation.advance(1.0 / 1000.0)
        track.append(tops(simulation)[0])
    jumps = np.abs(np.diff(np.array(track), axis=0)).max(axis=1)
    assert jumps.max() < 4.0 * np.median(jumps) + 1e-5


def test_wind_direction_is_the_worlds_whatever_a_plants_yaw() -> None:
    steady = Wind(mean=MeanWind(speed=6.0))
    scene, plants = row_of_trees(steady, count=4)
    moved = tops(Simulation(scene, plants).advance(20.0))
    assert (moved[:, 0] > 5.0 * np.abs(moved[:, 1])).all()
    assert moved[:, 0].min() > 0.5 * moved[:, 0].max()


def test_a_gust_reaches_tree_after_tree() -> None:
    gust = Gust(start=1.0, position=(0.0, 0.0), speed=12.0, strength=10.0)
    scene, plants = row_of_trees(Wind(gusts=(gust,)), count=6, spacing=12.0)
    simulation = Simulation(scene, plants)
    track = []
    for _ in range(30 * 9):
        simulation.advance(1.0 / 30.0)
        track.append(tops(simulation)[:, 0])
    motion = np.array(track)
    arrival = np.argmax(motion > 0.25 * motion.max(axis=0), axis=0) / 30.0
    speed = 12.0 / np.polyfit(np.arange(6), arrival, 1)[0]
    assert speed == pytest.approx(12.0, rel=0.1)


@pytest.mark.slow
def test_neighbours_are_neither_in_step_nor_strangers(breezy: Wind) -> None:
    scene, plants = row_of_trees(replace(breezy, gusts=()), count=8, spacing=6.0)
    simulation = Simulation(scene, plants).advance(5.0)
    track = []
    for _ in range(60 * 20):
        simulation.advance(1.0 / 20.0)
        track.append(tops(simulation)[:, 0])
    matrix = np.corrcoef(np.array(track).T)
    neighbours = np.mean([matrix[i, i + 1] for i in range(7)])
    assert 0.1 < neighbours < 0.6
