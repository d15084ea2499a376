"""A forest with and without simulation levels: links stepped and time per step, seen by somebody who walks in it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from windswept.plants.weber_penn import grow
from windswept.scene.camera import Camera
from windswept.scene.load_scene import load_scene
from windswept.scene.scene import Placements, PlantKind, Scene
from windswept.scene.simulation import Simulation

PLACEMENTS = 1_000
SPACING = 8.0
"""Mean distance between neighbours, m."""
KINDS = (("quaking_aspen", 0), ("scots_pine", 0), ("hazel", 0), ("quaking_aspen", 3))
SECONDS = 2.0
"""Simulated for each timing."""
WALK = (1.4, 10.0)
"""Speed of the camera, m/s, and how long it walks, s."""


def bench_forest(say: Callable[[str], None] = lambda line: None) -> dict[str, float]:
    """Figures ``forest.<placements>.*`` and ``choose.share_of_step``."""
    scene = forest()
    plants = [grow(kind.source, kind.seed) for kind in scene.kinds]
    name = f"forest.{PLACEMENTS}"
    say(f"{name}, every link")
    full = Simulation(scene, plants)
    ms_full = milliseconds_per_step(full)
    say(f"{name}, at levels")
    levelled = Simulation(scene, plants, levels=True, picture_height=1080)
    changing = _timed_changes(levelled)
    ms_active = milliseconds_per_step(levelled)
    share_of_changes = changing() / (levelled.step_count * ms_active)
    choosing = milliseconds_to_choose(levelled)
    return {
        f"{name}.links_full": full.stepped_count,
        f"{name}.links_active": levelled.stepped_count,
        f"{name}.ms_full": ms_full,
        f"{name}.ms_active": ms_active,
        "choose.share_of_step": choosing / (4.0 * ms_active),
        "choose.share_with_changes": share_of_changes,
    }


def forest(placements: int = PLACEMENTS) -> Scene:
    """Trees of four kinds round a camera that walks among them."""
    rng = np.random.default_rng(0)
    side = SPACING * np.sqrt(placements)
    kind = rng.integers(0, len(KINDS), placements)
    position = np.zeros((placements, 3), np.float32)
    position[:, :2] = rng.uniform(-0.5 * side, 0.5 * side, (placements, 2))
    yaw = rng.uniform(0.0, 2.0 * np.pi, placements).astype(np.float32)
    return replace(
        load_scene("hazel"),
        kinds=tuple(PlantKind(*one) for one in KINDS),
        placements=tuple(Placements(position[kind == k], yaw[kind == k]) for k in range(len(KINDS))),
        camera=walking_camera(),
    )


def walking_camera() -> Camera:
    """At eye height through the middle of the forest, looking ahead."""
    speed, seconds = WALK
    eye = np.array([[0.0, 0.0, 1.7], [speed * seconds, 0.0, 1.7]], np.float32)
    return Camera(
        time=np.array([0.0, seconds], np.float32),
        eye=eye,
        target=eye + np.array([10.0, 0.0, 1.3], np.float32),
        fov_y=np.full(2, np.radians(60.0), np.float32),
    )


def milliseconds_per_step(simulation: Simulation) -> float:
    """Wall time of one inner step of all plants, wind and choice of levels included, ms."""
    simulation.advance(0.1)
    before, started = simulation.step_count, time.perf_counter()
    simulation.advance(SECONDS)
    return 1e3 * (time.perf_counter() - started) / (simulation.step_count - before)


def _timed_changes(simulation: Simulation) -> Callable[[], float]:
    """Has the simulation time all its choosing and changing of levels from now on; gives what tells the sum, ms."""
    change, spent = simulation.change_levels, [0.0]

    def timed(at_once: bool = False) -> None:
        started = time.perf_counter()
        change(at_once)
        spent[0] += 1e3 * (time.perf_counter() - started)

    simulation.change_levels = timed  # type: ignore[method-assign]
    return lambda: spent[0]


def milliseconds_to_choose(simulation: Simulation, repeats: int = 20) -> float:
    """Wall time of choosing the levels of all plants, ms; it is done once in four inner steps."""
    simulation.change_levels()
    started = time.perf_counter()
    for _ in range(repeats):
        simulation.change_levels()
    return 1e3 * (time.perf_counter() - started) / repeats
