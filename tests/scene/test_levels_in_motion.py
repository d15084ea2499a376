"""Plants change their simulation level while the camera moves, and nobody sees it."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from windswept.levels import Eye
from windswept.motion import pose_links, rest_state
from windswept.plants.plant import Plant
from windswept.plants.sources import grow_source
from windswept.plants.weber_penn import grow
from windswept.scene.load_scene import load_scene
from windswept.scene.scene import Placements, PlantKind, Scene
from windswept.scene.simulation import Simulation

HEIGHT = 1080
FOV = np.radians(60.0)


@pytest.fixture(scope="module")
def aspens() -> tuple[Scene, list[Plant]]:
    """Three aspens in a row away from the camera, in a turbulent breeze without gusts."""
    position = np.array([[0.0, 0.0, 0.0], [6.0, 14.0, 0.0], [-6.0, 30.0, 0.0]], np.float32)
    scene = load_scene("quaking_aspen")
    scene = replace(
        scene,
        wind=replace(scene.wind, gusts=()),
        kinds=(PlantKind("quaking_aspen", 0),),
        placements=(Placements(position, np.array([0.0, 1.0, 2.0], np.float32)),),
    )
    return scene, [grow("quaking_aspen", 0)]


def eye_at(y: float) -> Eye:
    return Eye(np.array([0.0, y, 3.0], np.float32), float(FOV), HEIGHT)


def fly(aspens: tuple[Scene, list[Plant]], levels: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Tips (frames, P, n, 3) in the plants' frames, pixel sizes (frames, P), levels (frames, P), flying away."""
    scene, plants = aspens
    simulation = Simulation(scene, plants, levels=levels)
    kind = simulation.kinds[0]
    tips = plants[0].stem_link_start[1:] - 1
    vector = kind.model.skeleton.vector[tips].astype(np.float32)
    track, pixels, at = [], [], []
    for frame in range(60 * 5):
        eye = eye_at(-12.0 - 0.4 * frame)
        simulation.eye = eye
        simulation.advance(1.0 / 60.0)
        pose = simulation.pose[0]
        q = pose.rotation[:, tips]
        t = 2.0 * np.cross(q[..., :3], vector)
        track.append(pose.position[:, tips] + vector + q[..., 3:] * t + np.cross(q[..., :3], t))
        pixels.append(eye.metres(np.linalg.norm(kind.placements.position - eye.position, axis=1)))
        at.append(kind.at.copy())
    return np.array(track, np.float64), np.array(pixels), np.array(at)


@pytest.mark.slow
def test_no_leaf_jumps_when_a_plant_changes_its_level(aspens: tuple[Scene, list[Plant]]) -> None:
    # PHYSICS D2.2: the second difference of every tip less the same without levels, in pixels.
    with_levels, pixels, at = fly(aspens, True)
    without, _, _ = fly(aspens, False)
    assert (np.diff(at, axis=0) != 0).sum() >= 4
    jump = np.linalg.norm(np.diff(with_levels - without, n=2, axis=0), axis=-1) / pixels[1:-1, :, None]
    changing = np.zeros(len(at), bool)
    for frame in np.flatnonzero((np.diff(at, axis=0) != 0).any(axis=1)):
        changing[frame : frame + 35] = True
    seen = jump[changing[1:-1]]
    assert np.percentile(seen, 99) < 0.25
    assert seen.max() < 1.0


def test_a_trembling_camera_changes_nothing(aspens: tuple[Scene, list[Plant]]) -> None:
    scene, plants = aspens
    simulation = Simulation(scene, plants, levels=True)
    kind = simulation.kinds[0]
    assert kind.ladder is not None
    eye = eye_at(0.0)
    border = float(eye.distance(np.maximum.accumulate(kind.ladder.error))[4]) + kind.radius
    seen = []
    for frame in range(90):
        simulation.eye = eye_at(-border * (1.0 + 0.01 * np.sin(frame)))
        simulation.advance(1.0 / 30.0)
        seen.append(kind.at.copy())
    assert (np.diff(np.array(seen)[30:], axis=0) == 0).all()


def test_a_camera_that_jumps_is_followed(aspens: tuple[Scene, list[Plant]]) -> None:
    scene, plants = aspens
    simulation = Simulation(scene, plants, levels=True)
    kind = simulation.kinds[0]
    simulation.eye = eye_at(-5.0)
    simulation.advance(1.5)
    near = simulation.stepped_count
    simulation.eye = eye_at(-4000.0)
    simulation.advance(1.5)
    assert not kind.blends
    assert simulation.stepped_count < near / 20
    simulation.eye = eye_at(-5.0)
    simulation.advance(1.5)
    assert not kind.blends
    assert simulation.stepped_count == near
    assert all(np.isfinite(s.state.joints).all() for s in kind.sets)


def test_what_stands_still_is_not_stepped_and_would_not_move(
    aspens: tuple[Scene, list[Plant]], monkeypatch: pytest.MonkeyPatch
) -> None:
    scene, plants = aspens
    simulation = Simulation(scene, plants, levels=True)
    bend, still = simulation.kinds[0].sets[-2:]
    for far in (bend, still):
        far.add(0, *(part[0, :, :, 0] for part in rest_state(far.level, 1).parts))
        far.sample_winds(scene.wind, 0.0, 1.0 / 30.0)
    stepped = []
    for far in (bend, still):
        assert far.winds is not None
        state = far.stepper.step(rest_state(far.level, 1), *far.winds, 4)
        pose = pose_links(simulation.kinds[0].model, far.level, state).link
        rest = pose_links(simulation.kinds[0].model, far.level, rest_state(far.level, 1)).link
        assert np.array_equal(pose, rest) == (far is still)
        monkeypatch.setattr(far, "stepper", SimpleNamespace(step=lambda *_, far=far: stepped.append(far)))
        far.step(4, 0, 4)
    assert stepped == [bend]


def lone(species: str) -> tuple[Scene, list[Plant]]:
    """A plant in a turbulent breeze."""
    scene = load_scene(species)
    return replace(scene, wind=replace(scene.wind, gusts=())), [grow_source(species)]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("species", "tolerance", "away", "multibody"),
    [("california_black_oak", 2.0, 9.0, False), ("flowering_herb", 2.0, 1.5, True)],
)
def test_a_lone_plant_near_the_camera_is_cut_branch_by_branch_without_a_jump(
    species: str, tolerance: float, away: float, multibody: bool
) -> None:
    scene, plants = lone(species)
    runs = []
    for levels in (True, False):
        simulation = Simulation(scene, plants, levels=levels, pixels=tolerance, multibody=multibody)
        kind = simulation.kinds[0]
        simulation.advance(1.0)
        before, track, cuts = None, [], 0
        for frame in range(120):
            position = away * np.array([0.0, -1.0 - frame / 180.0, 1.0 / 3.0], np.float32)
            simulation.eye = Eye(position, float(FOV), HEIGHT, tolerance=tolerance)
            simulation.advance(1.0 / 60.0)
            own = kind.near.get(0)
            cuts += own is not None and own is not before and own.level.coupled == multibody
            before = own
            track.append(simulation.pose[0].position[0, ::7].astype(np.float64))
        runs.append(np.array(track))
        if levels:
            assert cuts >= 2
            assert kind.stepped_count < 2 * kind.model.link_count
    pixel = Eye(np.zeros(3, np.float32), float(FOV), HEIGHT).metres(np.array([0.55 * away]))[0]
    jump = np.linalg.norm(np.diff(runs[0] - runs[1], n=2, axis=0), axis=-1) / pixel
    assert np.percentile(jump, 99) < 0.25
    assert jump.max() < 1.0
