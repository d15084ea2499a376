"""A scene in motion: frame-rate independence, calm, determinism, gusts that travel, neighbours out of step."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from handmade import random_tree
from windswept.errors import InputError
from windswept.plants.plant import Plant
from windswept.scene.load_scene import load_scene
from windswept.scene.scene import Placements, PlantKind, Scene
from windswept.scene.simulation import Simulation
from windswept.scene.world_links import world_links
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


@pytest.mark.parametrize("seconds", [-1.0, np.nan, np.inf])
def test_time_that_cannot_pass_changes_nothing(breezy: Wind, seconds: float) -> None:
    scene, plants = row_of_trees(breezy)
    simulation = Simulation(scene, plants).advance(0.25)
    before = simulation.pose[0].link.copy()
    with pytest.raises(InputError, match=r"advance: seconds = .*: expected a time of 0 s or more"):
        simulation.advance(seconds)
    assert simulation.time == 0.25
    np.testing.assert_array_equal(simulation.pose[0].link, before)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"pixels": 0.0}, "pixels = 0.0: expected a finite number above 0"),
        ({"pixels": np.nan}, "pixels = nan: expected a finite number above 0"),
        ({"pixels": -1.0}, "pixels = -1.0: expected a finite number above 0"),
        ({"picture_height": 0}, "picture_height = 0: expected a finite number above 0"),
        ({"aspect": 0.0}, "aspect = 0.0: expected a finite number above 0"),
        ({"plants": []}, "plants = '0 plants': expected one for each of the scene's 1 kinds"),
        ({"scene": "quaking_aspen"}, "scene = 'quaking_aspen': expected a Scene, as load_scene gives it"),
    ],
)
def test_what_a_simulation_starts_from_is_checked(breezy: Wind, arguments: dict[str, Any], said: str) -> None:
    scene, plants = row_of_trees(breezy)
    with pytest.raises(InputError, match=re.escape(said)):
        Simulation(**({"scene": scene, "plants": plants} | arguments))


def test_links_in_the_world_hang_together_and_stand_where_they_were_placed(breezy: Wind) -> None:
    scene, plants = row_of_trees(breezy)
    simulation = Simulation(scene, plants)
    base, tip = world_links(simulation, 0)
    plant, placed = plants[0], scene.placements[0]
    assert base.shape == tip.shape == (6, plant.link_count, 3)
    root = int(np.flatnonzero(plant.link_parent < 0)[0])
    np.testing.assert_allclose(base[:, root] - plant.link_base[root], placed.position, atol=1e-5)
    simulation.advance(2.0)
    base, tip = world_links(simulation, 0)
    length = np.linalg.norm(plant.link_tip - plant.link_base, axis=1)
    np.testing.assert_allclose(np.linalg.norm(tip - base, axis=2), np.tile(length, (6, 1)), rtol=1e-3)
    child = np.flatnonzero(plant.link_parent >= 0)
    up, along = plant.link_parent[child], plant.link_attach[child][:, None]
    np.testing.assert_allclose(base[:, child], base[:, up] + along * (tip - base)[:, up], atol=1e-4)
    moved = base - placed.position[:, None] - world_turned(plant.link_base, placed.yaw)
    top = int(np.argmax(plant.link_base[:, 2]))
    np.testing.assert_allclose(moved[:, top], tops(simulation), atol=1e-4)


def world_turned(points: np.ndarray, yaw: np.ndarray) -> np.ndarray:
    """(P, L, 3) points of a plant turned as its placements are."""
    cosine, sine = np.cos(yaw)[:, None], np.sin(yaw)[:, None]
    x, y, z = points.T
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, z + 0.0 * cosine], axis=-1)
