"""The multibody kernels against their plain formulas, closed forms, conservation and MuJoCo."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from coupled_plants import energy_of, pulled
from handmade import build_plant, random_tree, straight
from windswept.levels.maximal_wind import maximal_wind
from windswept.levels.measure import followed_tips, tip_positions
from windswept.motion import (
    Model,
    Stepper,
    build_model,
    finest_level,
    plant_frequencies,
    pose_links,
    push,
    rest_state,
)
from windswept.motion.multibody import CoupledState, MultibodyStepper, constants, coupled, coupled_rest
from windswept.motion.multibody.plain import energy, kinematics, mass_matrix, step_multibody_plain
from windswept.plants.plant import Material
from windswept.plants.sources import grow_source
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.mujoco_tree import mujoco_frequencies, mujoco_tree
from windswept.studies.multibody_against_mujoco import compare, swaying_air
from windswept.studies.multibody_modes import ringing_frequency
from windswept.studies.multibody_steps import sway_in_wind
from windswept.studies.turbulence import rms, turbulent_air

LIMP = Material(youngs_modulus=3e8, damping_ratio=0.05)
FREE = Material(damping_ratio=0.0, wood_drag=0.0, leaf_drag=0.0)


def steady(model: Model, placements: int, speed: float) -> np.ndarray:
    wind = np.zeros((placements, len(model.probe_position), 3), np.float32)
    wind[..., 0] = speed
    return wind


def swung(model: Model, state: CoupledState, seconds: float) -> np.ndarray:
    """Energy at 30 moments of a free swing, over the first."""
    stepper, calm = MultibodyStepper(model), steady(model, 1, 0.0)
    energies = [energy_of(model, state)]
    for _ in range(30):
        stepper.step(state, calm, calm, round(seconds / model.time_step / 30))
        energies.append(energy_of(model, state))
    return np.array(energies) / energies[0]


@pytest.mark.parametrize("seed", [0, 1])
def test_kernel_equals_plain_formulas(seed: int) -> None:
    rng = np.random.default_rng(seed)
    model = build_model(random_tree(seed, material=LIMP))
    placements, chosen = 9, 8
    stepper, state = MultibodyStepper(model), coupled_rest(model, placements)
    angles, rates = np.zeros((model.link_count, 2)), np.zeros((model.link_count, 2))
    carried = np.zeros((model.link_count, 2, 3))
    for _ in range(40):
        wind = steady(model, placements, 8.0) + rng.standard_normal((placements, 1, 3)).astype(np.float32)
        stepper.step(state, wind, wind)
        angles, rates, carried = step_multibody_plain(
            model, angles, rates, carried, wind[chosen].astype(float)
        )
    assert np.abs(angles).max() > 0.05
    assert np.abs(state.angles(chosen) - angles).max() < 1e-6
    assert np.abs(state.velocities(chosen) - rates).max() < 1e-4
    assert np.abs(state.carried[1, :, :, 0].reshape(-1, 2, 3) - carried).max() < 1e-4


def test_a_large_turn_equals_plain_formulas() -> None:
    # Joint angles far beyond what wind does: the joint's own geometry, and centrifugal terms.
    rng = np.random.default_rng(0)
    model = build_model(random_tree(0, material=LIMP))
    state = rest_state(finest_level(model), 1)
    state.angles(0)[:] = rng.normal(0.0, 0.3, (model.link_count, 2))
    state.velocities(0)[:] = rng.normal(0.0, 1.0, (model.link_count, 2))
    angles, rates = state.angles(0).astype(float), state.velocities(0).astype(float)
    moving = coupled(model, state)
    carried = moving.carried[0, :, :, 0].reshape(-1, 2, 3).astype(float)
    assert np.abs(carried - kinematics(model, angles, rates).velocity).max() < 1e-5
    wind = steady(model, 1, 5.0)
    MultibodyStepper(model).step(moving, wind, wind)
    angles, rates, carried = step_multibody_plain(model, angles, rates, carried, wind[0].astype(float))
    assert np.abs(rates).max() > 50.0
    assert np.abs(moving.velocities(0) - rates).max() < 1e-5 * np.abs(rates).max()


def test_calm_air_moves_nothing() -> None:
    model = build_model(random_tree(0))
    state, calm = coupled_rest(model, 5), steady(model, 5, 0.0)
    MultibodyStepper(model).step(state, calm, calm, 200)
    assert not state.joints.any()
    assert not state.carried.any()


def test_settles_where_the_decoupled_joints_do() -> None:
    # In steady wind only the load counts. `springs` takes torques about the joint's axes at rest: the difference is
    # of the second order in the joint's angle.
    model = build_model(random_tree(1, material=replace(LIMP, damping_ratio=0.5)))
    level, wind = finest_level(model), steady(model, 1, 6.0)
    coupled_state, free = coupled_rest(model, 1), rest_state(level, 1)
    MultibodyStepper(model).step(coupled_state, wind, wind, 2400)
    Stepper(level).step(free, wind, wind, 2400)
    largest = np.abs(free.angles(0)).max()
    assert largest > 0.02
    assert np.abs(coupled_state.angles(0) - free.angles(0)).max() < 0.1 * largest**2


def test_energy_is_kept_at_a_small_step() -> None:
    model = build_model(random_tree(0, material=FREE), time_step=1.0 / 2000.0)
    state = pulled(model, 0.01)
    energies = swung(model, state, 60.0)
    assert np.abs(energies - 1.0).max() < 0.01


@pytest.mark.parametrize("rate", [120.0, 30.0, 5.0])
def test_energy_never_grows_at_a_large_step(rate: float) -> None:
    # The trapezoidal rule on carried velocities gains nothing, however far joints turn in a step.
    for plant, angle in (
        (random_tree(0, material=FREE), 0.1),
        (build_plant(straight(6.0, 8, 0.05, 0.02), FREE), 0.3),
    ):
        model = build_model(plant, time_step=1.0 / rate)
        energies = swung(model, pulled(model, angle), 60.0)
        assert np.diff(energies).max() < 1e-4
        assert np.isfinite(energies).all()


@pytest.mark.parametrize("rate", [120.0, 30.0, 5.0])
def test_energy_is_kept_exactly_but_for_rounding(rate: float, monkeypatch: pytest.MonkeyPatch) -> None:
    # In double precision and without the settling of what links carry.
    monkeypatch.setattr(constants, "SETTLING", 0.0)
    model = build_model(build_plant(straight(6.0, 8, 0.05, 0.02), FREE), time_step=1.0 / rate)
    angles = pulled(model, 0.3).angles(0).astype(float)
    rates, carried = np.zeros_like(angles), np.zeros((model.link_count, 2, 3))
    calm, energies = np.zeros((len(model.probe_position), 3)), []
    for _ in range(200):
        energies.append(energy(model, angles, carried))
        angles, rates, carried = step_multibody_plain(model, angles, rates, carried, calm)
    assert np.abs(carried).max() > 0.5
    assert np.abs(np.array(energies) / energies[0] - 1.0).max() < 1e-10


@pytest.mark.parametrize(("rate", "thrown"), [(120.0, 1.0), (30.0, 1.0), (5.0, 5.0)])
@pytest.mark.parametrize("links", [1, 3])
def test_a_whip_gains_nothing_from_its_stops(
    links: int, rate: float, thrown: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    # What a joint went into its stop by in the step that it entered was stored there for nothing.
    monkeypatch.setattr(constants, "SETTLING", 0.0)
    model = build_model(build_plant(straight(2.0, links, 0.01), FREE), time_step=1.0 / rate)
    angles, rates = np.zeros((links, 2)), np.zeros((links, 2))
    rates[:, 0] = thrown * (1.62 if links == 1 else 1.2) * model.stem_frequency[0]
    carried = kinematics(model, angles, rates).velocity
    calm, energies, furthest = np.zeros((len(model.probe_position), 3)), [], 0.0
    for _ in range(600):
        energies.append(energy(model, angles, carried))
        angles, rates, carried = step_multibody_plain(model, angles, rates, carried, calm)
        furthest = max(furthest, np.abs(angles).max())
    assert furthest > constants.STOP_EDGE - 1e-9
    assert np.diff(energies).max() < 1e-6 * energies[0]
    # A stop swallows some of what it is given, not most.
    assert rate < 100.0 or energies[-1] > 0.4 * energies[0]


def test_stopped_joints_equal_plain_formulas() -> None:
    model = build_model(build_plant(straight(2.0, 3, 0.01), FREE))
    state = rest_state(finest_level(model), 1)
    state.velocities(0)[:, 0] = 1.2 * model.stem_frequency[0]
    angles, rates = state.angles(0).astype(float), state.velocities(0).astype(float)
    state, carried = coupled(model, state), kinematics(model, angles, rates).velocity
    stepper, calm, stopped = MultibodyStepper(model), steady(model, 1, 0.0), 0
    for _ in range(30):
        stepper.step(state, calm, calm)
        angles, rates, carried = step_multibody_plain(model, angles, rates, carried, calm[0].astype(float))
        stopped += np.abs(angles).max() > constants.STOP_ANGLE
    assert stopped >= 2
    assert np.abs(state.angles(0) - angles).max() < 1e-4


def test_a_push_moves_every_joint_as_the_mass_matrix_says() -> None:
    rng = np.random.default_rng(0)
    model = build_model(random_tree(1, material=LIMP))
    free = rest_state(finest_level(model), 10)
    for placement in range(10):
        free.angles(placement)[:] = rng.normal(0.0, 0.1, (model.link_count, 2))
        free.velocities(placement)[:] = rng.normal(0.0, 0.5, (model.link_count, 2))
    state = coupled(model, free)
    before, chosen, link = state.joints.copy(), 9, model.link_count - 3
    angles, rates = state.angles(chosen).astype(float), state.velocities(chosen).astype(float)
    impulse = np.array([0.3, -0.2, 0.1])
    push(model, state, chosen, link, impulse, along=0.4)
    moving = kinematics(model, angles, rates)
    struck = moving.jacobian[link, 0] + 0.4 * model.skeleton.length[link] * moving.jacobian[link, 1]
    gain = np.linalg.solve(mass_matrix(model, moving), impulse @ struck).reshape(-1, 2)
    assert np.abs(gain).max() > 1.0
    assert np.abs(state.velocities(chosen) - rates - gain).max() < 1e-4 * np.abs(gain).max()
    carried = state.carried[1, :, :, 1].reshape(-1, 2, 3)
    assert np.abs(carried - kinematics(model, angles, rates + gain).velocity).max() < 1e-3
    assert np.array_equal(state.angles(chosen), before[1, :, ::2, 1])
    assert np.array_equal(state.joints[0], before[0])


def test_a_push_on_merged_branches_is_refused() -> None:
    model = build_model(random_tree(1))
    state = coupled_rest(model, 1)
    state.joints = state.joints[:, :3]
    with pytest.raises(ValueError, match="every link"):
        push(model, state, 0, 1, np.ones(3))


def test_no_placements_are_stepped() -> None:
    model = build_model(random_tree(1))
    state, nothing = coupled_rest(model, 0), steady(model, 0, 5.0)
    assert MultibodyStepper(model).step(state, nothing, nothing, 3).step_count == 3


def test_no_stiffness_limits_the_step() -> None:
    # Modes of 0.3 MHz at 120 steps a second: the branch stands as the wind holds it.
    model = build_model(random_tree(0, material=replace(LIMP, youngs_modulus=1e15)))
    state, wind = coupled_rest(model, 1), steady(model, 1, 20.0)
    MultibodyStepper(model).step(state, wind, wind, 1200)
    assert np.abs(state.angles(0)).max() < 1e-5


def test_a_storm_leaves_nothing_behind() -> None:
    # Two minutes of reversals at 40 m/s, then a steady wind: every joint comes to rest.
    model = build_model(random_tree(2, material=LIMP))
    stepper, state = MultibodyStepper(model), coupled_rest(model, 8)
    rng = np.random.default_rng(0)
    before, stormy = steady(model, 8, 40.0), 0.0
    for _ in range(120):
        after = steady(model, 8, float(rng.choice([0.0, 40.0, -40.0])))
        stepper.step(state, before, after, 1)
        stepper.step(state, after, after, 119)
        before, stormy = after, max(stormy, np.abs(state.joints[:, :, 1::2]).max())
    assert stormy > 5.0
    stepper.step(state, before, steady(model, 8, 10.0), 1)
    stepper.step(state, steady(model, 8, 10.0), steady(model, 8, 10.0), 2400)
    assert np.abs(state.joints[:, :, 1::2]).max() < 1e-3


@pytest.mark.parametrize("species", ["flowering_herb", "hazel"])
def test_limp_stalks_rest_in_a_steady_storm(species: str) -> None:
    # What the air's pull stiffens stalks by is more than a step can follow, and a hazel's twigs stand at their stops.
    model = build_model(grow_source(species, 0))
    wind = np.zeros((4, len(model.probe_position), 3), np.float32)
    wind[..., 0] = np.array([12.0, 25.0, 40.0, 60.0])[:, None]
    stepper, state = MultibodyStepper(model), coupled_rest(model, 4)
    stepper.step(state, np.zeros_like(wind), wind, 120)
    stepper.step(state, wind, wind, 9 * 120)
    for placement, largest in enumerate((0.25, 0.3, 0.4, 0.4)):
        assert np.abs(state.angles(placement)).max() > largest
        assert np.abs(state.velocities(placement)).max() < 1e-3


def test_limp_stalks_sway_in_a_storm_as_they_do_at_a_finer_step() -> None:
    # What the air's pull adds to a link's inertia must not slow its free sway about where a storm holds it.
    model = build_model(grow_source("flowering_herb", 1))
    usual, fine = (sway_in_wind(model, finer) for finer in (1, 8))
    assert rms(usual - fine) < 0.008 * rms(fine)


def test_limp_stalks_whip_as_they_do_at_a_finer_step() -> None:
    # Stiff joints at the trapezoidal rule's limit: their rates must not flip from step to step and feed the motion.
    model = build_model(grow_source("wheat", 1))
    air, tips = maximal_wind(model), followed_tips(model, 60)

    def tips_in_wind(finer: int) -> np.ndarray:
        fine = replace(model, time_step=model.time_step / finer)
        level, seen = replace(finest_level(fine), coupled=True), []
        stepper, state = MultibodyStepper(fine), coupled_rest(fine, 8)
        for k in range(120):
            stepper.step(state, air(level, k / 30), air(level, (k + 1) / 30), 4 * finer)
            seen.append(tip_positions(fine, level, state, tips))
        return np.array(seen)

    usual, fine = tips_in_wind(1), tips_in_wind(8)
    sway = np.sqrt(np.mean((fine - fine.mean(axis=0)) ** 2))
    assert np.sqrt(np.mean((usual - fine) ** 2)) < 0.02 * sway


def test_a_broken_number_is_not_mistaken_for_rest() -> None:
    model = build_model(random_tree(0))
    state, wind = coupled_rest(model, 1), steady(model, 1, 5.0)
    wind[0, 0, 0] = np.nan
    MultibodyStepper(model).step(state, wind, wind, 2)
    assert np.isnan(state.joints).any()


def test_steps_do_not_depend_on_how_they_are_grouped() -> None:
    model = build_model(random_tree(1))
    before, after = steady(model, 9, 3.0), steady(model, 9, 9.0)
    whole, parts = coupled_rest(model, 9), coupled_rest(model, 9)
    stepper = MultibodyStepper(model)
    stepper.step(whole, before, after, 8)
    for taken, count in ((0, 1), (1, 5), (6, 2)):
        stepper.step(parts, before, after, count, taken, 8)
    assert whole.joints.tobytes() == parts.joints.tobytes()
    assert whole.carried.tobytes() == parts.carried.tobytes()


@pytest.mark.parametrize("seed", [0, 1])
def test_five_modes_ring_at_their_frequencies(seed: int) -> None:
    # In the kernel, at the usual step; the eigenvalues are MuJoCo's too.
    model = build_model(plant_with_links(39, seed))
    rung = np.array([ringing_frequency(model, mode) for mode in range(5)])
    assert rung == pytest.approx(plant_frequencies(model.skeleton, model.rods, 5), rel=0.005)
    assert rung == pytest.approx(mujoco_frequencies(mujoco_tree(model))[:5], rel=0.005)


@pytest.mark.parametrize(("links", "seed"), [(39, 0), (39, 1), (200, 2)])
def test_mujoco_agrees_on_frequencies(links: int, seed: int) -> None:
    model = build_model(plant_with_links(links, seed))
    theirs = mujoco_frequencies(mujoco_tree(model))[:5]
    assert plant_frequencies(model.skeleton, model.rods, 5) == pytest.approx(theirs, rel=0.005)


def test_the_plain_mass_matrix_rings_at_the_same_frequencies() -> None:
    model = build_model(random_tree(3))
    still = np.zeros((model.link_count, 2))
    root = np.sqrt(model.rods.compliance.ravel())
    mass = mass_matrix(model, kinematics(model, still, still))
    values = np.linalg.eigvalsh(root[:, None] * mass * root)
    ours = np.sort(1.0 / np.sqrt(values))[:5] / (2.0 * np.pi)
    assert ours == pytest.approx(plant_frequencies(model.skeleton, model.rods, 5), rel=1e-6)


@pytest.mark.parametrize("seed", [0, 1])
def test_the_first_mode_keeps_its_frequency_at_the_usual_step(seed: int) -> None:
    # Prewarped trapezoidal rule: phase of the first mode after ten periods, all other modes at rest.
    model = build_model(random_tree(seed, material=FREE))
    root = np.sqrt(model.rods.compliance.ravel())
    still = np.zeros((model.link_count, 2))
    values, shapes = np.linalg.eigh(
        root[:, None] * mass_matrix(model, kinematics(model, still, still)) * root
    )
    shape, omega = (root * shapes[:, -1]).reshape(-1, 2), 1.0 / np.sqrt(values[-1])
    state = rest_state(finest_level(model), 1)
    state.angles(0)[:] = 1e-3 * shape / np.abs(shape).max()
    state, calm = coupled(model, state), steady(model, 1, 0.0)
    steps = round(20.0 * np.pi / omega / model.time_step)
    MultibodyStepper(model).step(state, calm, calm, steps)
    weight = shape / model.rods.compliance
    position = np.sum(weight * state.angles(0))
    phase = np.arctan2(-np.sum(weight * state.velocities(0)) / omega, position)
    assert phase == pytest.approx(omega * steps * model.time_step - 20.0 * np.pi, abs=0.01 * 2.0 * np.pi)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1])
def test_mujoco_agrees_in_gusts_and_near_resonance(seed: int) -> None:
    model = build_model(random_tree(seed))
    gusts = compare(model, turbulent_air(model, 7.0, seed), 2.0, 1.0 / 1200.0)
    assert gusts.motion > 0.002
    assert gusts.multibody < 0.02 * gusts.motion
    swaying = compare(model, swaying_air(model), 2.0, 1.0 / 1200.0)
    assert swaying.multibody < 0.05 * swaying.sway
    assert swaying.springs > 2.0 * swaying.multibody


def test_pose_is_that_of_any_state() -> None:
    model = build_model(random_tree(1))
    state = pulled(model, 0.2)
    plain = kinematics(model, state.angles(0).astype(float), np.zeros((model.link_count, 2)))
    pose = pose_links(model, finest_level(model), state)
    x, y, z, w = pose.rotation[0].T
    d = model.skeleton.vector / model.skeleton.length[:, None]
    t = 2.0 * np.cross(np.column_stack([x, y, z]), d)
    turned = d + w[:, None] * t + np.cross(np.column_stack([x, y, z]), t)
    assert np.abs(turned - plain.direction).max() < 1e-5
