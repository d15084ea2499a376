"""Merged branches on coupled links: what they weigh on their carrier, how they bend it, and that they stay calm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import random_tree
from windswept.levels import Hierarchy, cut_level, simplify
from windswept.levels.influence import REFERENCE_SPEED
from windswept.motion import (
    Level,
    Model,
    State,
    build_model,
    build_stepper,
    finest_level,
    pose_links,
    rest_state,
)
from windswept.motion.multibody.held_mass import held_mass
from windswept.plants.plant import Material

LIMP, STIFF = (Material(youngs_modulus=modulus, damping_ratio=0.3) for modulus in (5e8, 5e9))


@pytest.fixture(scope="module")
def merged() -> tuple[Hierarchy, Level]:
    """A tree of which some links are left, with groups on them."""
    return merged_tree(STIFF)


def merged_tree(material: Material) -> tuple[Hierarchy, Level]:
    hierarchy = simplify(build_model(random_tree(3, material=material)))
    level = replace(cut_level(hierarchy, float(np.quantile(hierarchy.error, 0.8))), coupled=True)
    assert level.group_count > 3
    assert 3 < level.link_count < hierarchy.model.link_count
    return hierarchy, level


def blown(model: Model, level: Level, winds: list[float], steps: int) -> State:
    """One plant after winds of so many m/s along x, each for so many steps."""
    stepper, state = build_stepper(model, level), rest_state(level, 1)
    for speed in winds:
        wind = np.zeros((1, len(level.probe_position), 3), np.float32)
        wind[..., 0] = speed
        stepper.step(state, wind, wind, steps)
    return state


def test_carriers_hold_the_mass_of_their_groups(merged: tuple[Hierarchy, Level]) -> None:
    # Against 200 points of mass along every merged link.
    hierarchy, level = merged
    model = hierarchy.model
    skeleton, rods = model.skeleton, model.rods
    held = held_mass(model, level)
    own = rods.mass[level.link]
    assert own.sum() + held[:, 0].sum() == pytest.approx(rods.mass.sum(), rel=1e-12)
    expected = np.zeros_like(held)
    points = (np.arange(200) + 0.5) / 200.0
    for carrier, first, stop in zip(level.group_carrier, level.group_first, level.group_stop, strict=True):
        row = int(np.flatnonzero(level.link == carrier)[0])
        unit = skeleton.vector[carrier] / skeleton.length[carrier]
        for link in range(first, stop):
            # A density a + b s + c s^2 that has the rod's mass and its first and second moments.
            moments = [rods.mass[link], rods.moment[link], rods.inertia[link] / skeleton.length[link] ** 2]
            density = np.polynomial.Polynomial(
                np.linalg.solve([[1 / (i + j + 1) for j in range(3)] for i in range(3)], moments)
            )
            at = skeleton.base[link] - skeleton.base[carrier] + points[:, None] * skeleton.vector[link]
            along, weight = at @ unit, density(points) / 200.0
            off = np.sum(at**2, axis=1) - along**2
            expected[row] += [weight.sum(), weight @ along, weight @ (along**2 + 0.5 * off)]
    assert np.abs(held - expected).max() < 1e-4 * np.abs(expected).max()


def test_steady_wind_bends_coupled_links_with_groups_as_without(merged: tuple[Hierarchy, Level]) -> None:
    # As at levels of `springs`: what is left is geometry beyond first order.
    hierarchy, level = merged
    model = hierarchy.model
    finest = replace(finest_level(model), coupled=True)
    ends = [
        pose_links(model, one, blown(model, one, [REFERENCE_SPEED] * 5, 400)).position[0]
        for one in (finest, level)
    ]
    moved = np.linalg.norm(ends[0] - model.skeleton.base, axis=1).max()
    assert moved > 1e-3
    assert np.linalg.norm(ends[1] - ends[0], axis=1).max() < 0.01 * moved


def test_calm_air_moves_no_group(merged: tuple[Hierarchy, Level]) -> None:
    hierarchy, level = merged
    state = blown(hierarchy.model, level, [0.0], 200)
    assert not any(part.any() for part in state.parts)


def test_coupled_links_with_groups_outlast_a_storm() -> None:
    hierarchy, level = merged_tree(LIMP)
    state = blown(hierarchy.model, level, [40.0, -40.0, 0.0, 40.0] * 10, 120)
    assert all(np.isfinite(part).all() for part in state.parts)
    resting = blown(hierarchy.model, level, [40.0, -40.0, 0.0, 0.0, 0.0, 0.0], 600)
    assert np.abs(resting.velocities(0)).max() < 1e-3
