"""The springs kernel against its plain formulas, closed forms and MuJoCo."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
import pytest
from scipy.special import ellipeinc, ellipkinc

from handmade import build_plant, random_tree, straight
from windswept.motion import Model, State, Stepper, build_model, finest_level, pose_links, push, rest_state
from windswept.motion.model import PROPAGATION, TIME_STEP, modes_of
from windswept.motion.springs_plain import pose_plain, step_plain
from windswept.plants.plant import Material
from windswept.plants.pose import Pose
from windswept.plants.weber_penn import grow
from windswept.studies.mujoco_tree import mujoco_tree

LIMP = Material(youngs_modulus=3e8, damping_ratio=0.05)


def steady(
    model: Model, placements: int, speed: float, direction: tuple[float, float, float] = (1, 0, 0)
) -> np.ndarray:
    wind = np.zeros((placements, len(model.probe_position), 3), np.float32)
    wind[:] = speed * np.array(direction)
    return wind


def stepped(model: Model, placements: int) -> tuple[Stepper, State]:
    level = finest_level(model)
    return Stepper(level), rest_state(level, placements)


def posed(model: Model, state: State) -> Pose:
    return pose_links(model, finest_level(model), state)


def settle_plain(model: Model, wind: np.ndarray, force: np.ndarray, steps: int) -> np.ndarray:
    """Joint angles after many critically damped steps of the plain formulas."""
    model = replace(model, damping_ratio=np.full_like(model.damping_ratio, 0.9))
    model = replace(model, modes=modes_of(model))
    angles = np.zeros((model.link_count, 2))
    velocities = np.zeros_like(angles)
    for _ in range(steps):
        angles, velocities = step_plain(model, angles, velocities, wind, force)
    return angles


@pytest.mark.parametrize("seed", [0, 1])
def test_kernel_equals_plain_formulas(seed: int) -> None:
    rng = np.random.default_rng(seed)
    model = build_model(random_tree(seed, material=LIMP))
    model = replace(model, propagation=rng.uniform(0.9, 1.0, model.link_count))
    model = replace(model, constants=model.constants.copy())
    model.constants[:, PROPAGATION] = model.propagation
    placements, chosen = 9, 8
    stepper, state = stepped(model, placements)
    angles, velocities = np.zeros((model.link_count, 2)), np.zeros((model.link_count, 2))
    for _ in range(60):
        wind = steady(model, placements, 8.0) + rng.standard_normal((placements, 1, 3)).astype(np.float32)
        stepper.step(state, wind, wind)
        angles, velocities = step_plain(model, angles, velocities, wind[chosen].astype(float))
    assert np.abs(angles).max() > 0.05
    assert np.abs(state.angles(chosen) - angles).max() < 2e-5
    rotation, position = pose_plain(model, angles)
    pose = posed(model, state)
    assert np.abs(pose.position[chosen] - position).max() < 2e-5
    turned = np.array([r.as_quat() for r in rotation])
    assert np.abs(np.abs(np.sum(turned * pose.rotation[chosen], axis=1)) - 1.0).max() < 1e-5


def test_calm_air_moves_nothing() -> None:
    model = build_model(random_tree(0))
    stepper, state = stepped(model, 5)
    calm = steady(model, 5, 0.0)
    stepper.step(state, calm, calm, 500)
    assert not state.joints.any()
    assert np.array_equal(posed(model, state).position[0], build_pose_at_rest(model))


def build_pose_at_rest(model: Model) -> np.ndarray:
    return posed(model, stepped(model, 1)[1]).position[0]


def elastica_tip(load: float) -> tuple[float, float]:
    """(deflection, shortening) over length of a cantilever under a dead tip load (Bisshopp and Drucker)."""
    from scipy.optimize import brentq

    def root_load(angle: float) -> float:
        m = (1.0 + np.sin(angle)) / 2.0
        theta = np.arcsin(1.0 / np.sqrt(2.0 * m))
        return float(ellipkinc(np.pi / 2, m) - ellipkinc(theta, m) - np.sqrt(load))

    angle = brentq(root_load, 1e-6, np.pi / 2 - 1e-9)
    m = (1.0 + np.sin(angle)) / 2.0
    theta = np.arcsin(1.0 / np.sqrt(2.0 * m))
    sag = 1.0 - 2.0 / np.sqrt(load) * (ellipeinc(np.pi / 2, m) - ellipeinc(theta, m))
    return float(sag), float(1.0 - np.sqrt(2.0 * np.sin(angle) / load))


@pytest.mark.parametrize("load", [0.25, 1.0, 2.0, 3.0])
def test_elastica_under_dead_tip_load(load: float) -> None:
    length, radius = 1.0, 0.005
    plant = build_plant(straight(length, 20, radius), LIMP)
    model = build_model(plant)
    model.drag.centre[-1] = 1.0
    bending_stiffness = LIMP.youngs_modulus * np.pi * radius**4 / 4.0
    force = np.zeros((20, 3))
    force[-1, 0] = load * bending_stiffness / length**2
    angles = settle_plain(model, np.zeros((len(model.probe_position), 3)), force, 400)
    rotation, position = pose_plain(model, angles)
    tip = position[-1] + rotation[-1].apply(model.skeleton.vector[-1])
    sag, shortening = elastica_tip(load)
    assert tip[0] / length == pytest.approx(sag, abs=0.01)
    assert 1.0 - tip[2] / length == pytest.approx(shortening, abs=0.01)


@pytest.mark.parametrize("seed", range(3))
def test_mujoco_agrees_on_static_tip(seed: int) -> None:
    model = build_model(random_tree(seed))
    rng = np.random.default_rng(seed)
    force = 0.3 * rng.standard_normal((model.link_count, 3)) + np.array([1.0, 0.4, 0.0])
    tree = mujoco_tree(model)
    data = mujoco.MjData(tree)
    tree.dof_damping[:] = 20.0 * TIME_STEP * tree.jnt_stiffness
    mujoco.mj_forward(tree, data)
    for _ in range(6000):
        data.qfrc_applied[:] = 0.0
        for link in range(model.link_count):
            site = data.site(f"centre{link}")
            mujoco.mj_applyFT(
                tree,
                data,
                force[link],
                np.zeros(3),
                site.xpos,
                int(tree.site(f"centre{link}").bodyid[0]),
                data.qfrc_applied,
            )
        mujoco.mj_step(tree, data)
    assert np.abs(data.qvel).max() < 1e-4
    angles = settle_plain(model, np.zeros((len(model.probe_position), 3)), force, 250)
    rotation, position = pose_plain(model, angles)
    tips = np.array(
        [p + r.apply(d) for p, r, d in zip(position, rotation, model.skeleton.vector, strict=True)]
    )
    theirs = np.array([data.site(f"tip{link}").xpos for link in range(model.link_count)])
    moved = np.linalg.norm(theirs - (model.skeleton.base + model.skeleton.vector), axis=1)
    assert moved.max() > 0.01
    assert np.abs(tips - theirs).max() < 0.02 * moved.max()


@pytest.mark.parametrize("ratio", [0.02, 0.08])
def test_damping_ratio_from_pull_and_release(ratio: float) -> None:
    # In vacuo: no leaves, hardly any air (drag coefficient 0).
    material = Material(damping_ratio=ratio, wood_drag=0.0)
    model = build_model(build_plant(straight(8.0, 12, 0.06, 0.02), material))
    stepper, state = stepped(model, 1)
    push(model, state, 0, model.link_count - 1, np.array([3.0, 0.0, 0.0]))
    calm = steady(model, 1, 0.0)
    track = []
    for _ in range(3000):
        stepper.step(state, calm, calm)
        track.append(float(posed(model, state).position[0, -1, 0]))
    track = np.array(track)
    peaks = np.flatnonzero((track[1:-1] > track[:-2]) & (track[1:-1] > track[2:])) + 1
    decrement = np.mean(np.diff(np.log(track[peaks[:6]])))
    found = -decrement / np.sqrt((2 * np.pi) ** 2 + decrement**2)
    assert found == pytest.approx(ratio, rel=0.03)
    period = np.mean(np.diff(peaks)) * TIME_STEP
    damped = model.stem_frequency[0] * np.sqrt(1 - ratio**2)
    assert 2 * np.pi / period == pytest.approx(damped, rel=0.01)


@pytest.mark.parametrize(("exponent", "slope"), [(0.0, 2.0), (-1.0, 1.0)])
def test_static_law_of_deflection_over_speed(exponent: float, slope: float) -> None:
    # PHYSICS D2.9: deflection ~ U^(2+V) once the leaves fold.
    stem = straight(4.0, 12, 0.06, 0.03)
    stem.leaves = 10
    material = Material(reconfiguration=exponent, reconfiguration_speed=0.5, wood_drag=0.0, damping_ratio=0.7)
    model = build_model(build_plant(stem, material))
    speeds = np.array([1.5, 3.0, 6.0, 10.0])
    stepper, state = stepped(model, len(speeds))
    wind = steady(model, len(speeds), 1.0) * speeds[:, None, None].astype(np.float32)
    for _ in range(40):
        stepper.step(state, wind, wind, 30)
    tips = posed(model, state).position[:, -1, 0]
    fitted = np.polyfit(np.log(speeds), np.log(tips), 1)[0]
    assert fitted == pytest.approx(slope, abs=0.1 if exponent == 0.0 else 0.15)


@pytest.mark.slow
def test_ten_minutes_of_storm_stay_finite() -> None:
    model = build_model(random_tree(2, material=LIMP))
    stepper, state = stepped(model, 8)
    rng = np.random.default_rng(0)
    before = steady(model, 8, 40.0)
    for _ in range(600):
        after = steady(model, 8, float(rng.choice([0.0, 40.0, -40.0])))
        stepper.step(state, before, after, 1)
        stepper.step(state, after, after, 119)
        before = after
    assert np.isfinite(state.joints).all()
    assert np.abs(state.joints[:, :, ::2]).max() < np.pi


def test_same_seed_same_bytes() -> None:
    model = build_model(random_tree(1))

    def run() -> bytes:
        stepper, state = stepped(model, 20)
        wind = (
            np.random.default_rng(3).standard_normal((20, len(model.probe_position), 3)).astype(np.float32)
            * 6
        )
        stepper.step(state, wind, wind, 50)
        return state.joints.tobytes()

    assert run() == run()


def test_a_push_moves_only_the_way_to_the_root() -> None:
    model = build_model(random_tree(1))
    state = stepped(model, 2)[1]
    push(model, state, 1, 30, np.array([0.1, 0.0, 0.0]))
    way = {30}
    while model.skeleton.parent[min(way)] >= 0:
        way.add(int(model.skeleton.parent[min(way)]))
    moving = set(np.flatnonzero(np.abs(state.velocities(1)).max(axis=1) > 0).tolist())
    assert moving == way
    assert not state.velocities(0).any()


@pytest.mark.parametrize(
    ("species", "speed"), [("hazel", 15.0), ("quaking_aspen", 25.0), ("california_black_oak", 15.0)]
)
def test_a_steady_storm_ends_in_rest(species: str, speed: float) -> None:
    # A force held over a step must neither feed nor drain the motion, whatever stiffness the air adds.
    model = build_model(grow(species, 0))
    stepper, state = stepped(model, 1)
    wind = steady(model, 1, speed)
    stepper.step(state, wind, wind, 120 * 20)
    track = []
    for _ in range(60):
        stepper.step(state, wind, wind)
        track.append(state.angles(0).copy())
    assert np.abs(track[-1]).max() > 0.3
    assert np.ptp(np.array(track), axis=0).max() < 2e-3


def test_a_broken_number_is_not_mistaken_for_rest() -> None:
    model = build_model(random_tree(0))
    stepper, state = stepped(model, 1)
    wind = steady(model, 1, 5.0)
    wind[0, 0, 0] = np.nan
    stepper.step(state, wind, wind, 2)
    assert np.isnan(state.joints).any()


def test_a_force_of_place_keeps_its_energy() -> None:
    # The elastic part alone: without damping and air a swing keeps its height for a hundred periods.
    material = Material(damping_ratio=0.0, wood_drag=0.0)
    model = build_model(build_plant(straight(6.0, 8, 0.05, 0.02), material))
    stepper, state = stepped(model, 1)
    push(model, state, 0, model.link_count - 1, np.array([2.0, 0.0, 0.0]))
    calm = steady(model, 1, 0.0)
    heights = []
    for _ in range(40):
        swing = []
        for _ in range(60):
            stepper.step(state, calm, calm, 4)
            swing.append(abs(float(posed(model, state).position[0, -1, 0])))
        heights.append(max(swing))
    assert heights[-1] == pytest.approx(heights[0], rel=0.01)
