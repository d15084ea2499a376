"""Flow primitives: closed forms, and the kernel against the plain formula."""

import math

import numpy as np
import pytest

from windswept.wind.field.acts import Jet
from windswept.wind.field.flows import flow_into, jet_velocity
from windswept.wind.field.primitives import Line, Primitive, Uniform, primitive_velocity

from .field_cases import FLAT

TILTED = Line((3.0, -2.0, 1.0), 4.0, -7.0, 1.5, axis=(1.0, 2.0, 0.5), drift=(1.0, 0.0, 0.2))
EDGE = 1e-3
"""Of the small cubes over which slopes are taken, m."""


def slopes(flow: list[Primitive], point: tuple[float, float, float]) -> np.ndarray:
    """(3, 3) derivative of velocity component a along b by central differences, 1/s."""
    steps = EDGE * np.concatenate([np.eye(3), -np.eye(3)])
    velocity = primitive_velocity(flow, np.array(point) + steps, 0.0)
    return (velocity[:3] - velocity[3:]).T / (2.0 * EDGE)


def divergence_and_curl(flow: list[Primitive], point: tuple[float, float, float]) -> tuple[float, np.ndarray]:
    d = slopes(flow, point)
    return float(np.trace(d)), np.array([d[2, 1] - d[1, 2], d[0, 2] - d[2, 0], d[1, 0] - d[0, 1]])


def test_away_from_cores_there_is_neither_divergence_nor_curl() -> None:
    # V = V_ideal r^2 / (r^2 + e^2): divergence a e^2 / (pi (r^2 + e^2)^2), which a small core takes to 0.
    flow = [Line((0.0, 0.0, 0.0), 5.0, 8.0, core=0.01), Uniform((1.0, 2.0, 0.0))]
    divergence, curl = divergence_and_curl(flow, (3.0, 4.0, 2.0))
    assert divergence == pytest.approx(0.0, abs=1e-5)
    np.testing.assert_allclose(curl, 0.0, atol=1e-5)


@pytest.mark.parametrize("radius", [0.0, 0.5, 1.0, 3.0])
def test_inside_cores_divergence_and_curl_are_those_of_the_cored_flow(radius: float) -> None:
    source, vortex, core = 5.0, 8.0, 1.0
    divergence, curl = divergence_and_curl([Line((0.0, 0.0, 0.0), source, vortex, core)], (radius, 0.0, 0.0))
    shape = core**2 / (math.pi * (radius**2 + core**2) ** 2)
    assert divergence == pytest.approx(source * shape, abs=1e-5)
    np.testing.assert_allclose(curl, [0.0, 0.0, vortex * shape], atol=1e-5)


def test_a_source_blows_out_its_strength_through_any_far_circle() -> None:
    turn = np.linspace(0.0, 2.0 * math.pi, 64, endpoint=False)
    outward = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(64)])
    velocity = primitive_velocity(
        [Line((0.0, 0.0, 0.0), source=6.0, vortex=9.0, core=0.1)], 20.0 * outward, 0.0
    )
    assert 2.0 * math.pi * 20.0 * np.sum(velocity * outward, axis=1).mean() == pytest.approx(6.0, rel=1e-4)
    along = np.column_stack([-np.sin(turn), np.cos(turn), np.zeros(64)])
    assert 2.0 * math.pi * 20.0 * np.sum(velocity * along, axis=1).mean() == pytest.approx(9.0, rel=1e-4)


def test_a_core_has_no_infinite_velocity_and_its_middle_stands() -> None:
    flow = [Line((0.0, 0.0, 0.0), source=-6.0, vortex=9.0, core=0.5)]
    assert not primitive_velocity(flow, np.zeros((1, 3)), 0.0).any()
    near = primitive_velocity(flow, np.array([[0.5, 0.0, 0.0]]), 0.0)
    assert np.linalg.norm(near) == pytest.approx(math.hypot(6.0, 9.0) / (2.0 * math.pi) / (2 * 0.5))


def test_primitives_superpose_move_and_blow_in_their_time() -> None:
    points = np.random.default_rng(0).uniform(-9.0, 9.0, (20, 3))
    late = Uniform((0.0, 0.0, 1.0), start=4.0, end=6.0)
    total = primitive_velocity([TILTED, late], points, 5.0)
    moved = Line((8.0, -2.0, 2.0), 4.0, -7.0, 1.5, axis=(2.0, 4.0, 1.0))
    total[:, 2] -= 1.0
    np.testing.assert_allclose(total, primitive_velocity([moved], points, 0.0), atol=1e-5)
    np.testing.assert_allclose(primitive_velocity([late], points, 6.0), 0.0)


def test_a_jet_has_no_divergence_and_does_not_pass_the_ground() -> None:
    jet = Jet((1.0, -1.0), 3.0, 12.0, 1.0)
    points = np.random.default_rng(1).uniform([-6.0, -6.0, 0.1], [6.0, 6.0, 5.0], (50, 3))
    parts = [
        (jet_velocity(jet, points + step)[:, a] - jet_velocity(jet, points - step)[:, a]) / (2.0 * EDGE)
        for a, step in enumerate(EDGE * np.eye(3))
    ]
    np.testing.assert_allclose(np.sum(parts, axis=0), 0.0, atol=1e-4)
    assert np.abs(parts[2]).max() > 0.1
    assert not jet_velocity(jet, points * [1.0, 1.0, 0.0])[:, 2].any()


def test_kernel_equals_the_plain_formulas() -> None:
    flow = np.zeros((3, *FLAT.shape), np.float32)
    primitives = [TILTED, Uniform((1.0, -2.0, 0.5)), Line((0.0, 5.0, 0.0), vortex=12.0)]
    jets = [Jet((4.0, -3.0), 3.0, 9.0, 1.0), Jet((-20.0, 0.0), 2.0, 5.0, 0.7)]
    flow_into(flow, FLAT, primitives, jets, 2.0)
    points = FLAT.nodes().reshape(-1, 3)
    expected = primitive_velocity(primitives, points, 2.0) + sum(jet_velocity(jet, points) for jet in jets)
    np.testing.assert_allclose(flow.reshape(3, -1).T, expected, atol=2e-5)
