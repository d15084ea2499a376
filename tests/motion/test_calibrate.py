"""Decoupled joints tuned to the coupled plant: the linear answer against a dense solution, and what tuning keeps."""

from __future__ import annotations

import numpy as np
import pytest

from handmade import build_plant, random_tree, straight
from windswept.motion import Stepper, build_model, finest_level, rest_state
from windswept.motion.calibrate import (
    DAMPINGS,
    RATIOS,
    REFERENCE_SPEED,
    calibrated,
    joint_answers,
    nearest_oscillators,
)
from windswept.motion.multibody.constants import joint_lag
from windswept.motion.multibody.plain import drag_plain, kinematics, mass_matrix
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.springs_accuracy import tip_tracks
from windswept.studies.turbulence import rms, turbulent_air


def test_answers_are_those_of_the_whole_matrices() -> None:
    # (K + i w D + i w A - w^2 M) theta = q, in waves of air that travel along x and push along it.
    model = build_model(random_tree(0))
    still = np.zeros((model.link_count, 2))
    moving = kinematics(model, still, still)
    lever = (model.drag.centre * model.skeleton.length)[:, None, None]
    centre = moving.jacobian[:, 0] + lever * moving.jacobian[:, 1]
    wind = np.tile([REFERENCE_SPEED, 0.0, 0.0], (len(model.probe_position), 1))
    resistance = drag_plain(model, moving, wind)[1]
    air = np.einsum("lxm,lxy,lyn->mn", centre, resistance, centre, optimize=True)
    delay = (model.skeleton.base + model.drag.centre[:, None] * model.skeleton.vector)[:, 0] / REFERENCE_SPEED
    stiffness = 1.0 / model.rods.compliance.ravel()
    mass, lag = mass_matrix(model, moving), np.repeat(joint_lag(model), 2)
    lines = np.array([2.0, 9.0, 40.0])
    angle, torque = joint_answers(model, lines, np.zeros(1))
    for k, omega in enumerate(lines):
        late = np.exp(-1j * omega * delay)[:, None]
        push = np.einsum("lxm,lx->m", centre, resistance[:, :, 0] * late)
        matrix = np.diag(stiffness * (1.0 + 1j * omega * lag)) + 1j * omega * air - omega**2 * mass
        theta = np.linalg.solve(matrix, push)
        felt = push - 1j * omega * air @ theta
        assert np.abs(angle[k, :, :, 0].ravel() - theta).max() < 1e-6 * np.abs(theta).max()
        assert np.abs(torque[k, :, :, 0].ravel() - felt).max() < 1e-6 * np.abs(felt).max()


def test_a_lone_link_keeps_its_own_oscillator() -> None:
    model = build_model(build_plant(straight(2.0, 1, 0.02)))
    tuned = calibrated(model)
    assert tuned.stem_frequency == pytest.approx(model.stem_frequency, rel=0.02)
    assert tuned.damping_ratio == pytest.approx(model.damping_ratio, rel=0.15)


def test_tuning_keeps_static_deflection_and_its_bounds() -> None:
    model = build_model(random_tree(2))
    tuned = calibrated(model)
    wind = np.zeros((1, len(model.probe_position), 3), np.float32)
    wind[..., 0] = 5.0
    angles = []
    for one in (model, tuned):
        state = rest_state(finest_level(one), 1)
        Stepper(finest_level(one)).step(state, wind, wind, 6000)
        angles.append(state.angles(0))
    assert np.abs(angles[0]).max() > 1e-3
    assert angles[1] == pytest.approx(angles[0], abs=1e-5)
    ratio, share = tuned.stem_frequency / model.stem_frequency, tuned.damping_ratio / model.damping_ratio
    assert ratio.min() >= 0.99 * RATIOS[0]
    assert ratio.max() <= 1.01 * RATIOS[-1]
    assert share.min() >= 0.99 * DAMPINGS[0]
    assert share.max() <= 1.01 * DAMPINGS[-1]


def test_nearest_oscillators_find_an_oscillator() -> None:
    # Angles that are those of oscillators with other frequencies and damping than the stems' own.
    model = build_model(random_tree(1))
    lines = np.geomspace(1.0, 400.0, 60)
    true, zeta = 0.8 * model.stem_frequency, 2.0 * model.damping_ratio
    response = 1.0 / (1.0 - (lines[:, None] / true) ** 2 + 2j * zeta * lines[:, None] / true)
    pushed = np.ones(response.shape)
    found, damping = nearest_oscillators(
        model, lines, np.gradient(lines), pushed, np.abs(response) ** 2, response
    )
    assert found == pytest.approx(true, rel=0.02)
    assert damping == pytest.approx(zeta, rel=0.2)


@pytest.mark.slow
def test_tuned_joints_stay_within_a_tenth_of_the_coupled_plant() -> None:
    model = build_model(plant_with_links(200))
    links = (np.append(model.skeleton.stem_first_link[1:], model.link_count) - 1).astype(np.int32)
    models = {"before": model, "after": calibrated(model)}
    tracks = tip_tracks(models, turbulent_air(model, 7.0, 0, 4), 8.0, links)
    motion = rms(tracks["multibody"])
    before, after = (rms(tracks[name] - tracks["multibody"]) / motion for name in models)
    assert after < 0.10
    assert after < before
