"""Shapes of chains against the heavy elastica, closed forms and hand calculations (PHYSICS B3, C2)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipeinc, ellipkinc

from windswept.errors import InputError
from windswept.motion.blades.chain import BROKEN_STIFFNESS, build_chain
from windswept.motion.blades.rest_shape import moment, posed, rest_shape

from .conftest import uniform

HEAVY_ELASTICA = {
    0.5: (0.9978, -0.0623),
    1.0: (0.9912, -0.1235),
    2.0: (0.9669, -0.2385),
    5.0: (0.8467, -0.4959),
    10.0: (0.6564, -0.7002),
    20.0: (0.4452, -0.8299),
}
"""Tip (x, z) of a horizontal clamp under its own weight W = q L^3 / EI."""
DOWN = np.array([0.0, 1.0, 0.0])
"""A horizontal blade whose normal points down."""


@pytest.mark.parametrize("weight", HEAVY_ELASTICA)
def test_equilibrium_is_the_heavy_elastica(weight: float) -> None:
    x, z = HEAVY_ELASTICA[weight]
    tip = rest_shape(uniform(20), weight * DOWN).joint[-1]
    assert np.hypot(tip[0] - x, -tip[1] - z) < 0.003
    assert tip[2] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("weight", HEAVY_ELASTICA)
def test_eight_sections_are_enough_for_one_percent(weight: float) -> None:
    x, z = HEAVY_ELASTICA[weight]
    tip = rest_shape(uniform(8), weight * DOWN).joint[-1]
    assert np.hypot(tip[0] - x, -tip[1] - z) < 0.0116


@pytest.mark.parametrize(
    ("weight", "height"), [(1.0, -0.1244), (2.0, -0.2433), (5.0, -0.5321), (10.0, -0.7782)]
)
def test_sequential_pass_has_the_stated_figures(weight: float, height: float) -> None:
    tip = rest_shape(uniform(20), weight * DOWN, "sequential").joint[-1]
    assert -tip[1] == pytest.approx(height, abs=1e-4)


def test_sequential_pass_of_two_sections_by_hand() -> None:
    # PHYSICS C2.7: at the base the mass is that of both sections at L / 2, at the upper joint that of the upper one.
    weight, length = 3.0, 1.0
    chain = uniform(2)
    base = np.arctan2(np.sin(np.pi / 2), chain.stiffness[0, 0] / (weight * length / 2) - np.cos(np.pi / 2))
    gamma = np.pi / 2 + base
    upper = np.arctan2(np.sin(gamma), chain.stiffness[1, 0] / (weight / 2 * length / 4) - np.cos(gamma))
    turns = rest_shape(chain, weight * DOWN, "sequential").turns
    np.testing.assert_allclose(turns[:, 0], [base, upper], rtol=1e-12)
    assert chain.stiffness[:, 0] == pytest.approx([4.0, 2.0])


@pytest.mark.parametrize(("gamma", "ratio", "turn"), [(60, 2.0, 30.0), (30, 1.2, 56.3), (20, 0.5, 142.1)])
def test_a_soft_joint_turns_beyond_the_arcsine(gamma: float, ratio: float, turn: float) -> None:
    # PHYSICS C2.1 and C2.2: K = k R / (m g) below cos gamma needs atan2.
    chain = uniform(2)
    chain = replace(chain, stiffness=np.array([[1.0, 1.0], [1e9, 1e9]]))
    tilt = np.radians(gamma)
    weight = 1.0 / (0.5 * ratio) * np.array([-np.cos(tilt), np.sin(tilt), 0.0])
    turns = rest_shape(chain, weight, "sequential").turns
    assert np.degrees(turns[0, 0]) == pytest.approx(turn, abs=0.05)


@pytest.mark.parametrize("load", [0.25, 1.0, 2.0, 5.0, 10.0])
def test_dead_tip_load_is_the_elastica(load: float) -> None:
    # The force stands at the centre of the last of 40 sections, which is the tip of an elastica so much shorter.
    length = 1.0 - 0.5 / 40
    force = np.zeros((40, 3))
    force[-1, 1] = load / length**2
    joint = rest_shape(uniform(40), force).joint

    def root_load(angle: float) -> float:
        m = (1.0 + np.sin(angle)) / 2.0
        theta = np.arcsin(1.0 / np.sqrt(2.0 * m))
        return float(ellipkinc(np.pi / 2, m) - ellipkinc(theta, m) - np.sqrt(load))

    angle = brentq(root_load, 1e-6, np.pi / 2 - 1e-9)
    m = (1.0 + np.sin(angle)) / 2.0
    theta = np.arcsin(1.0 / np.sqrt(2.0 * m))
    sag = 1.0 - 2.0 / np.sqrt(load) * (ellipeinc(np.pi / 2, m) - ellipeinc(theta, m))
    reach = np.sqrt(2.0 * np.sin(angle) / load)
    tip = 0.5 * (joint[-1] + joint[-2]) / length
    assert np.hypot(tip[0] - reach, tip[1] - sag) < 0.003


def test_a_tip_load_bends_more_than_the_same_load_spread_out() -> None:
    # PL^3/3EI against qL^4/8EI: the ratio is 8/3 (PHYSICS C2.14).
    chain, force = uniform(200), np.zeros((200, 3))
    force[-1, 1] = 1e-3
    tip = rest_shape(chain, force).joint[-1, 1]
    spread = rest_shape(chain, 1e-3 * DOWN).joint[-1, 1]
    assert tip / spread == pytest.approx(8.0 / 3.0, rel=0.01)


@pytest.mark.parametrize("seed", range(4))
def test_equilibrium_balances_every_joint_in_three_dimensions(seed: int) -> None:
    rng = np.random.default_rng(seed)
    chain = uniform(6, side_ratio=5.0)
    force = rng.normal(0.0, 1.0, (6, 3)) + np.array([0.0, 0.5, 1.0])
    shape = rest_shape(chain, force)
    centre = 0.5 * (shape.joint[1:] + shape.joint[:-1])
    n_before = np.vstack([[[0.0, 1.0, 0.0]], shape.frame[:-1, 1]])
    s_before = np.vstack([[[0.0, 0.0, 1.0]], shape.frame[:-1, 2]])
    assert np.abs(shape.turns[:, 1]).max() > 0.02
    for i in range(6):
        torque = np.cross(centre[i:] - shape.joint[i], force[i:]).sum(axis=0)
        turn = shape.turns[i]
        t_before = np.cross(n_before[i], s_before[i])
        bent_normal = n_before[i] * np.cos(turn[0]) - t_before * np.sin(turn[0])
        assert chain.stiffness[i, 0] * turn[0] == pytest.approx(torque @ s_before[i], abs=1e-6)
        assert chain.stiffness[i, 1] * turn[1] == pytest.approx(-torque @ bent_normal, abs=1e-6)


def test_a_column_buckles_at_greenhills_weight() -> None:
    # W = 7.837 for a uniform column; a chain of 20 sections is a little stiffer.
    upright = np.array([-1.0, 0.0, 0.0])
    assert rest_shape(uniform(20), 7.6 * upright).joint[-1, 0] > 0.999
    assert rest_shape(uniform(20), 8.2 * upright).joint[-1, 0] < 0.9


def test_natural_curvature_is_the_shape_without_load() -> None:
    chain = replace(uniform(4), turn=np.array([0.1, 0.2, 0.2, 0.2]))
    for method in ("equilibrium", "sequential"):
        shape = rest_shape(chain, np.zeros(3), method)  # type: ignore[arg-type]
        np.testing.assert_allclose(shape.joint, posed(chain, shape.turns).joint)
        np.testing.assert_allclose(shape.turns[:, 0], chain.turn, atol=1e-8)


@pytest.mark.parametrize("method", ["equilibrium", "sequential"])
def test_a_joint_that_bears_too_much_breaks_and_stays_broken(method: str) -> None:
    whole = uniform(6)
    bearing = moment(whole, rest_shape(whole, 2.0 * DOWN, method).turns)  # type: ignore[arg-type]
    chain = replace(whole, strength=np.full(6, 0.9 * bearing.max()))
    shape = rest_shape(chain, 2.0 * DOWN, method)  # type: ignore[arg-type]
    assert shape.broken.tolist() == [True] + 5 * [False]
    left = chain.softened(shape.broken)
    assert left.stiffness[0, 0] == pytest.approx(BROKEN_STIFFNESS * whole.stiffness[0, 0])
    # Later, under a load that breaks nothing, it hangs as the softened blade does.
    later = rest_shape(chain, 0.5 * DOWN, method, shape.broken)  # type: ignore[arg-type]
    assert later.broken.tolist() == shape.broken.tolist()
    whole_tip = rest_shape(whole, 0.5 * DOWN, method).joint[-1, 1]  # type: ignore[arg-type]
    assert later.joint[-1, 1] > 1.5 * whole_tip


def test_a_blade_without_thickness_is_refused_in_one_line() -> None:
    ones = np.ones(3)
    with pytest.raises(InputError, match=r"leaf: section 1, stiffness = 0\.0: expected a number above 0"):
        build_chain(ones, np.array([1.0, 0.0, 1.0]), ones, ones, ones, name="leaf")
    with pytest.raises(InputError, match=r"blade: section 2, mass = 0\.0"):
        build_chain(ones, ones, np.array([1.0, 1.0, 0.0]), ones, ones)


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_a_load_that_is_no_number_is_refused(wrong: float) -> None:
    with pytest.raises(InputError, match="a finite force"):
        rest_shape(uniform(5), np.array([0.0, wrong, 0.0]))
