"""The thesis' merges: pairs, chains, whorls and opposed children become single links; the trunk feels them all."""

from __future__ import annotations

import numpy as np
import pytest

from handmade import BARE_STIFF, build_plant, random_tree, straight
from windswept.levels import joint_motion_of, simplify
from windswept.levels.hierarchy import Hierarchy
from windswept.levels.pair_table import pair_table
from windswept.levels.printed import (
    BASE,
    DIRECTION,
    DRAG,
    INERTIA,
    LENGTH,
    MASS,
    MOMENT,
    NUMBER,
    SLOWNESS,
    STIFFNESS,
    STRENGTH,
    SUM_COUNT,
    merge_parent_child,
    printed_level,
    printed_merges,
)
from windswept.motion import Level, Stepper, build_model, finest_level, rest_state
from windswept.plants.plant import Material
from windswept.plants.weber_penn import grow

COEFFICIENT = {0.0: 0.1399, 0.25: 0.1574, 0.5: 0.1840, 0.75: 0.2317}
"""c1 of a tapered cantilever, f = c D / L^2 root(E / rho) (PHYSICS B2)."""


def rod(stiffness: float, length: float, mass: float, leaf_mass: float) -> np.ndarray:
    """(SUM_COUNT,) a straight uniform rod along x with a leaf at its tip, growing from its parent's tip."""
    row = np.zeros(SUM_COUNT)
    row[NUMBER] = row[BASE] = row[DRAG] = row[DIRECTION] = 1.0
    row[LENGTH], row[STIFFNESS], row[MASS] = length, stiffness, mass + leaf_mass
    row[MOMENT] = (mass / 2.0 + leaf_mass) * length
    row[INERTIA] = (mass / 3.0 + leaf_mass) * length**2
    row[STRENGTH], row[SLOWNESS] = length * stiffness, length * row[INERTIA]
    return row


def merged(parent: np.ndarray, vector: np.ndarray, beyond: np.ndarray) -> np.ndarray:
    table, link = pair_table(), parent.copy()
    merge_parent_child(link, vector, beyond, table.displacement, table.rate, table.single)
    return link


def test_pairs_with_leaves_have_the_pairs_deflection_and_frequency() -> None:
    # PHYSICS B3 with any masses: the pair's mass is not spread as the rods of the table are.
    rng = np.random.default_rng(0)
    worst_stiffness = worst_frequency = 0.0
    for _ in range(300):
        k_p, k_c = np.exp(rng.uniform(np.log([1.0, 0.005]), np.log([1.0, 5.0])))
        l_p, l_c = 1.0, np.exp(rng.uniform(np.log(0.6), np.log(8.0)))
        m_p, m_c = 1.0, l_c * np.exp(rng.uniform(np.log(0.3), np.log(5.0)))
        angle = rng.uniform(0.0, 0.5 * np.pi)
        parent = rod(k_p, l_p, m_p, 0.0)
        beyond = rod(k_c, l_c, m_c, rng.uniform(0.0, 0.5) * m_c)
        beyond[DIRECTION : DIRECTION + 3] = np.cos(angle), np.sin(angle), 0.0
        link = merged(parent, np.array([l_p, 0.0, 0.0]), beyond)
        arm = np.array([l_p + l_c * np.cos(angle), l_c * np.sin(angle)])
        length = np.linalg.norm(arm)
        lever = (arm @ [np.cos(angle), np.sin(angle)]) * l_c / length
        stiffness = 1.0 / (1.0 / k_p + (lever / length) ** 2 / k_c)
        m12 = l_p * beyond[MOMENT] * np.cos(angle) + beyond[INERTIA]
        m11 = parent[INERTIA] + beyond[MASS] * l_p**2 + 2.0 * m12 - beyond[INERTIA]
        scale = 1.0 / np.sqrt([k_p, k_c])
        slowest = np.linalg.eigvalsh(np.array([[m11, m12], [m12, beyond[INERTIA]]]) * np.outer(scale, scale))[
            -1
        ]
        assert link[LENGTH] == pytest.approx(length)
        assert link[INERTIA] == pytest.approx(m11)
        worst_stiffness = max(worst_stiffness, abs(link[STIFFNESS] / stiffness - 1.0))
        squared = link[STRENGTH] / link[SLOWNESS]
        worst_frequency = max(worst_frequency, abs(np.sqrt(squared * slowest) - 1.0))
    assert worst_stiffness < 0.02
    assert worst_frequency < 0.02


@pytest.mark.parametrize("taper", COEFFICIENT)
def test_a_cantilever_of_many_links_merges_to_one_that_swings_as_it(taper: float) -> None:
    length, radius = 2.0, 0.02
    plant = build_plant(straight(length, 20, radius, radius * (1.0 - taper)), BARE_STIFF)
    model = build_model(plant)
    merges = printed_merges(simplify(model))
    # Each merge keeps one mode of two and takes the child for rigid in it: 1.5 % low for a cylinder, more with taper.
    hertz = COEFFICIENT[taper] * 2 * radius / length**2
    hertz *= np.sqrt(BARE_STIFF.youngs_modulus / BARE_STIFF.wood_density)
    assert merges.frequency[0] / (2.0 * np.pi) == pytest.approx(hertz, rel=0.02 + 0.06 * taper)
    skeleton = model.skeleton
    end = skeleton.base[-1, 2] + model.drag.centre[-1] * skeleton.vector[-1, 2]
    lever = end - skeleton.base[:, 2]
    softness = np.sum(lever**2 * model.rods.compliance.mean(axis=1))
    assert merges.arm[0, 2] == pytest.approx(end)
    assert end**2 / merges.stiffness[0] == pytest.approx(softness, rel=0.02)


def whorl(directions: np.ndarray) -> Hierarchy:
    """A stem of two links with a side stem in each direction from its tip."""
    trunk = straight(1.0, 2, 0.03, 0.02)
    for direction in directions:
        side = straight(0.5, 1, 0.008, direction=tuple(direction), origin=trunk.nodes[-1], leaves=4, order=1)
        trunk.children.append((1, 1.0, side))
    return simplify(build_model(build_plant(trunk)))


def around(count: int, rise: float) -> np.ndarray:
    """(count, 3) unit vectors evenly around the vertical, rising by an angle, rad."""
    turn = 2.0 * np.pi * np.arange(count) / count
    flat = np.full(count, np.cos(rise))
    return np.column_stack([flat * np.cos(turn), flat * np.sin(turn), np.full(count, np.sin(rise))])


@pytest.mark.parametrize(("count", "rise"), [(8, 0.7), (8, 0.0), (5, 0.1), (2, 0.0)])
def test_whorls_and_opposed_children_average_to_a_link_along_their_parent(count: int, rise: float) -> None:
    hierarchy = whorl(around(count, rise))
    merges = printed_merges(hierarchy)
    tuft = int(hierarchy.child[1].max())
    child = np.flatnonzero(hierarchy.model.skeleton.stem > 0)
    length = np.linalg.norm(merges.arm[child], axis=1).mean()
    assert hierarchy.stop[tuft] - hierarchy.first[tuft] == count
    # Not a stub: as long as a child, upright, as stiff as one child, with one child's leaf.
    assert merges.arm[tuft] == pytest.approx([0.0, 0.0, length], abs=1e-6)
    assert merges.stiffness[tuft] == pytest.approx(merges.stiffness[child].mean())
    assert merges.frequency[tuft] == pytest.approx(merges.frequency[child].mean(), rel=1e-3)
    assert merges.drag[tuft] == pytest.approx(merges.drag[child].mean())
    # All children's drag bends the parent.
    own = np.trace(hierarchy.influence.drag[1]) / 3.0
    assert merges.drag[1] == pytest.approx(own + count * merges.drag[tuft])
    assert merges.arm[1] == pytest.approx([0.0, 0.0, 0.5 + length], abs=1e-6)


def test_children_to_one_side_keep_their_side() -> None:
    hierarchy = whorl(np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]))
    merges = printed_merges(hierarchy)
    arm = merges.arm[int(hierarchy.child[1].max())]
    assert arm[0] == pytest.approx(arm[1])
    assert arm[2] == pytest.approx(0.0, abs=1e-6)


def test_longer_children_weigh_more_in_stiffness() -> None:
    trunk = straight(1.0, 2, 0.03, 0.02)
    for length, radius, way in ((0.2, 0.004, -1.0), (0.6, 0.01, 1.0)):
        side = straight(
            length, 1, radius, direction=(way, 0.0, 1.0), origin=trunk.nodes[-1], leaves=4, order=1
        )
        trunk.children.append((1, 1.0, side))
    hierarchy = simplify(build_model(build_plant(trunk)))
    merges = printed_merges(hierarchy)
    short, long = merges.stiffness[2:4]
    one, other = np.linalg.norm(merges.arm[2:4], axis=1)
    expected = (one * short + other * long) / (one + other)
    assert merges.stiffness[int(hierarchy.child[1].max())] == pytest.approx(expected)


def test_merged_stems_swing_as_the_stems_do() -> None:
    hierarchy = simplify(build_model(grow("quaking_aspen", 0)))
    merges, skeleton = printed_merges(hierarchy), hierarchy.model.skeleton
    _, first = np.unique(skeleton.stem, return_index=True)
    ratio = merges.frequency[first] / hierarchy.model.stem_frequency
    # Middle half of the stems; children that differ much are averaged all the same (C3.6).
    low, high = np.percentile(ratio, [25, 75])
    assert 0.95 < low <= high < 1.05
    assert np.isfinite(merges.arm).all()


def trunk_turn(hierarchy: Hierarchy, level: Level, speed: float) -> float:
    """How far steady wind turns the trunk's lowest joint, rad."""
    stepper, state = Stepper(level), rest_state(level, 1)
    wind = np.zeros((1, len(level.probe_position), 3), np.float32)
    wind[..., 0] = speed
    for _ in range(80):
        stepper.step(state, wind, wind, 40)
    own, _ = joint_motion_of(hierarchy.model, level, state, 0)
    return float(np.linalg.norm(own[0]))


def test_trunk_feels_the_same_static_force_at_every_printed_level() -> None:
    material = Material(damping_ratio=0.2, youngs_modulus=1e10)
    for plant in (random_tree(3, material=material), grow("hazel", 0)):
        hierarchy = simplify(build_model(plant))
        merges = printed_merges(hierarchy)
        exact = trunk_turn(hierarchy, finest_level(hierarchy.model), 3.0)
        groups = 0
        for share in (0.003, 0.03, 0.3):
            level = printed_level(hierarchy, merges, share * hierarchy.error[hierarchy.root])
            assert level.link_count > 0
            groups += level.group_count
            assert trunk_turn(hierarchy, level, 3.0) == pytest.approx(exact, rel=0.01)
        assert groups > 0
