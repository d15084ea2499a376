"""The lowest modes of the whole plant in `springs`: they ring as the coupled plant does, and change nothing at rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import build_plant, random_tree, straight
from windswept.motion import Level, Model, Stepper, build_model, finest_level, rest_state
from windswept.motion.modal import FASTEST, LEFT_OUT, MODE_COUNT, Modes, no_modes
from windswept.motion.modes import natural_modes
from windswept.plants.plant import Material
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.springs_accuracy import tip_tracks
from windswept.studies.turbulence import rms, turbulent_air

SMALL = 1e-3
"""Greatest angle of a mode that rings, rad."""


def coordinates(modes: Modes, joints: np.ndarray) -> np.ndarray:
    """(R,) coordinates of (L, 2) joint angles or rates in the modes."""
    return np.asarray(modes.gain[0] @ np.einsum("kir,ki->r", modes.torque, joints[modes.link]))


def rung(model: Model, level: Level, mode: int, steps: int) -> np.ndarray:
    """(steps,) coordinate of a mode that was pulled out and let go in still air."""
    stepper, state = Stepper(level), rest_state(level, 1)
    shape = natural_modes(model.skeleton, model.rods, MODE_COUNT)[1][..., mode]
    state.angles(0)[:] = SMALL * shape / np.abs(shape).max()
    calm = np.zeros((1, len(model.probe_position), 3), np.float32)
    heard = np.empty(steps)
    for step in range(steps):
        stepper.step(state, calm, calm)
        heard[step] = coordinates(model.modes, state.angles(0))[mode]
    return heard


def frequency_and_damping(heard: np.ndarray, interval: float) -> tuple[float, float]:
    """rad/s and fraction of critical of the damped oscillation that comes nearest to samples of one."""
    (once, twice), *_ = np.linalg.lstsq(np.column_stack([heard[1:-1], heard[:-2]]), heard[2:])
    decay = -0.5 * np.log(-twice) / interval
    damped = np.arccos(once / (2.0 * np.sqrt(-twice))) / interval
    omega = float(np.hypot(decay, damped))
    return omega, decay / omega


@pytest.mark.parametrize("mode", range(MODE_COUNT))
def test_a_mode_rings_at_the_coupled_plants_frequency_and_damping(mode: int) -> None:
    model = build_model(random_tree(3, material=Material(damping_ratio=0.03, wood_drag=1e-9)))
    omega, zeta = model.modes.frequency[mode], model.modes.damping_ratio[mode]
    stride = max(1, round(1.0 / (omega * model.time_step)))
    level = finest_level(model)
    common, alone = (
        frequency_and_damping(rung(model, one, mode, 60 * stride)[::stride], stride * model.time_step)
        for one in (level, replace(level, modes=no_modes()))
    )
    # Kicks are of second order in the step.
    assert common[0] == pytest.approx(omega, rel=(omega * model.time_step) ** 2 / 24.0)
    assert common[1] == pytest.approx(zeta, rel=0.02)
    assert abs(alone[1] / zeta - 1.0) > 2.0 * abs(common[1] / zeta - 1.0)


@pytest.mark.parametrize("seed", [0, 2])
def test_modes_do_not_feed_motion_without_damping(seed: int) -> None:
    model = build_model(random_tree(seed, material=Material(damping_ratio=0.0, wood_drag=1e-9)))
    level = finest_level(model)
    stepper, state = Stepper(level), rest_state(level, 1)
    state.angles(0)[:] = 0.02 * np.random.default_rng(seed).standard_normal((model.link_count, 2))
    calm = np.zeros((1, len(model.probe_position), 3), np.float32)
    energy = np.empty(1800)
    for look in range(len(energy)):
        stepper.step(state, calm, calm, 20)
        energy[look] = np.sum(state.angles(0) ** 2 / model.rods.compliance)
    assert (np.diag(model.modes.gain[0]) > 0.0).all()
    first, *_, last = np.array_split(energy, 10)
    # Elastic energy alone comes and goes.
    assert last.max() < 1.3 * first.max()
    assert last.mean() > 0.4 * first.mean()


def test_angles_in_the_modes_have_their_coordinates_and_no_others() -> None:
    modes = build_model(plant_with_links(200)).modes
    wanted = np.array([0.3, -0.2, 0.1, 0.05])
    angles = np.zeros((200, 2))
    angles[modes.link] = modes.angle @ wanted
    assert coordinates(modes, angles) == pytest.approx(wanted, rel=1e-4)
    energy = np.einsum("kir,kir->r", modes.torque, modes.angle)
    assert (energy > 1.0 - LEFT_OUT).all()
    assert len(modes.link) < 100


def test_links_that_are_not_stepped_take_no_part() -> None:
    modes = build_model(plant_with_links(200)).modes
    links = np.sort(np.random.default_rng(0).choice(200, 120, replace=False)).astype(np.int32)
    links = np.union1d(links, modes.link[::2]).astype(np.int32)
    fewer = modes.among(links)
    assert set(links[fewer.link]) == set(modes.link) & set(links)
    wanted = np.array([0.3, -0.2, 0.1, 0.05]) * (np.diag(fewer.gain[0]) > 0.0)
    angles = np.zeros((len(links), 2))
    angles[fewer.link] = fewer.angle @ wanted
    assert np.any(wanted)
    assert coordinates(fewer, angles) == pytest.approx(wanted, rel=1e-4)
    assert not modes.among(np.zeros(0, np.int32)).gain.any()
    assert not modes.among(modes.link[-1:]).gain.any()


@pytest.mark.parametrize("links", [1, 2])
def test_plants_with_fewer_freedoms_than_modes(links: int) -> None:
    model = build_model(build_plant(straight(2.0, links, 0.02)))
    slow = np.count_nonzero(model.modes.frequency[: 2 * links] * model.time_step < FASTEST)
    assert slow >= 2
    assert np.count_nonzero(np.diag(model.modes.gain[0])) == slow
    wind = np.full((1, len(model.probe_position), 3), 3.0, np.float32)
    stepper, state = Stepper(finest_level(model)), rest_state(finest_level(model), 1)
    stepper.step(state, wind, wind, 50)
    assert np.isfinite(state.joints).all()
    assert state.joints.any()


def test_static_deflection_is_that_of_the_joints() -> None:
    model = build_model(random_tree(2))
    wind = np.zeros((1, len(model.probe_position), 3), np.float32)
    wind[..., 0] = 5.0
    angles = []
    for one in (model, replace(model, modes=no_modes())):
        state = rest_state(finest_level(one), 1)
        Stepper(finest_level(one)).step(state, wind, wind, 6000)
        angles.append(state.angles(0))
    assert np.abs(angles[0]).max() > 1e-3
    assert angles[1] == pytest.approx(angles[0], abs=1e-5)


@pytest.mark.parametrize(
    ("length", "links", "thick", "thin"),
    [(2.0, 6, 0.02, 0.02), (1.5, 8, 0.02, 0.012), (3.0, 6, 0.06, 0.05)],
    ids=["rod", "sapling", "post"],
)
def test_small_stiff_plants_come_to_rest(length: float, links: int, thick: float, thin: float) -> None:
    # Their joints are slow enough to be told what the modes do, but modes 3 and 4 are too fast to be kicked.
    model = build_model(build_plant(straight(length, links, thick, thin)))
    assert model.modes.frequency[3] * model.time_step > FASTEST
    assert model.modes.gain[0].any()
    wind = np.zeros((1, len(model.probe_position), 3), np.float32)
    wind[..., 0] = 8.0
    stepper, state = Stepper(finest_level(model)), rest_state(finest_level(model), 1)
    stepper.step(state, np.zeros_like(wind), wind, 60)
    stepper.step(state, wind, wind, 2400)
    settled = state.angles(0).copy()
    assert settled.any()
    assert np.abs(state.velocities(0)).max() < 1e-4
    stepper.step(state, wind, wind, 1200)
    assert state.angles(0) == pytest.approx(settled, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("links", "seed"), [(68, 0), (200, 0), (200, 1)])
def test_with_modes_in_common_joints_stay_near_the_coupled_plant(links: int, seed: int) -> None:
    model = build_model(plant_with_links(links, seed))
    tips = (np.append(model.skeleton.stem_first_link[1:], model.link_count) - 1).astype(np.int32)
    models = {"alone": replace(model, modes=no_modes()), "common": model}
    tracks = tip_tracks(models, turbulent_air(model, 7.0, seed, 4), 8.0, tips)
    motion = rms(tracks["multibody"])
    alone, common = (rms(tracks[name] - tracks["multibody"]) / motion for name in models)
    assert common < 0.065
    assert common < 0.65 * alone
