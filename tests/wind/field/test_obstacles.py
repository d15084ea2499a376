"""Air round what stands in it."""

import math

import numpy as np
import pytest

from windswept.wind.field import Box, Cylinder, Field, FieldPlan, Grid, Spheroid, start_field, step_field
from windswept.wind.field.deflect import deflect, flux_divergence, node_velocity, solve_fluxes
from windswept.wind.field.obstacles import Obstacle, openness

from .field_cases import line_of_air, small_field, steady

OPEN = Grid((-30.0, -30.0), (1.0, 1.0, 1.0), (61, 61, 24))
POST = Cylinder((-12.0, 0.0), 3.0, 20.0)
OBSTACLES: dict[str, Obstacle] = {
    "cylinder": Cylinder((0.0, 0.0), 4.0, 9.0),
    "sphere": Spheroid((1.0, 2.0, 4.0), 5.0, 5.0),
    "box": Box((0.0, 0.0), (9.0, 6.0), 6.0, 0.4),
    "crown": Spheroid((0.0, 0.0, 8.0), 5.0, 4.0, 0.4),
    "raised": Cylinder((0.0, 0.0), 4.0, 14.0, 5.0),
}


def blown(obstacle: Obstacle, speed: float = 6.0, seconds: float = 10.0, **plan: object) -> Field:
    field = small_field(steady(speed), obstacles=(obstacle,), **plan)
    step_field(field, seconds)
    return field


@pytest.mark.parametrize("name", OBSTACLES)
def test_fluxes_have_no_divergence_and_do_not_enter(name: str) -> None:
    passes = openness(OPEN, [OBSTACLES[name]])
    solid = passes == 0.0
    assert solid.any() == (name != "crown")
    for flux, ambient in zip(solve_fluxes(OPEN, passes), np.eye(3), strict=True):
        assert np.abs(flux_divergence(OPEN, flux)).max() < 1e-4
        velocity = node_velocity(flux, ambient)
        inside = solid & ~_beside_air(solid)
        assert not velocity[:, inside & (np.arange(24) > 0)].any()
        for axis, face in enumerate((flux.x, flux.y, flux.z)):
            both = np.moveaxis(solid, axis, 0)
            assert not np.moveaxis(face, axis, 0)[both[1:] | both[:-1]].any()


def _beside_air(solid: np.ndarray) -> np.ndarray:
    near = np.zeros_like(solid)
    for axis in range(3):
        for step in (-1, 1):
            near |= ~np.roll(solid, step, axis)
    return near


@pytest.mark.parametrize(("radius", "half_height"), [(3.0, 3.0), (5.0, 4.0), (2.0, 3.0)])
def test_the_centre_of_a_spheroid_is_deep_inside(radius: float, half_height: float) -> None:
    ball = Spheroid((0.0, 0.0, 4.0), radius, half_height)
    assert ball.distance(np.zeros(1), np.zeros(1), np.full(1, 4.0)) == -min(radius, half_height)
    grid = Grid((-6.0, -6.0), (1.0, 1.0, 1.0), (13, 13, 12))
    assert openness(grid, [ball])[6, 6, 4] == 0.0


def test_beside_a_tall_cylinder_the_flow_is_the_potential_one() -> None:
    # U (1 + R^2/r^2) across the flow and U (1 - R^2/r^2) along it: the cylinder is as high as the field.
    wide = Grid((-60.0, -60.0), (1.0, 1.0, 1.0), (121, 121, 5))
    radius = 8.0
    passes = openness(wide, [Cylinder((0.0, 0.0), radius, 99.0)])
    velocity = node_velocity(solve_fluxes(wide, passes)[0], np.eye(3)[0])[0, :, :, 1]
    for r in (12, 16, 20):
        assert velocity[60, 60 + r] == pytest.approx(1.0 + radius**2 / r**2, rel=0.06)
        assert velocity[60 + r, 60] == pytest.approx(1.0 - radius**2 / r**2, abs=0.06)


def test_no_flow_through_faster_beside_slower_behind() -> None:
    field = blown(POST)
    free = line_of_air(field, y=14.0)[5, 0]
    air = line_of_air(field)[:, 0]
    assert not field.velocity[19:22, 16, 1:].any()
    beside = field.velocity[20, 16 + 5, 4, 0]
    assert beside > 1.15 * free
    assert air[20 + 5] < 0.5 * free
    assert air[20 + 9] < 0.6 * free
    assert air[20 - 4] < 0.8 * free


def test_the_wake_recovers_downstream_and_does_not_reach_aside() -> None:
    field = blown(POST, relaxation=0.5)
    free = 6.0 * field.profile[4]
    air = line_of_air(field)[:, 0]
    behind = air[[30, 40, 50, 60]] / free
    assert (np.diff(behind) > 0.0).all()
    assert behind[-1] > 0.85
    assert line_of_air(field, y=10.0)[50, 0] > 0.95 * free


def test_wakes_have_the_same_depth_at_any_step() -> None:
    depth = []
    for rate in (30.0, 60.0, 144.0):
        field = small_field(steady(6.0), obstacles=(POST,))
        for _ in range(round(8.0 * rate)):
            step_field(field, 1.0 / rate)
        depth.append(1.0 - line_of_air(field)[[30, 40], 0] / (6.0 * field.profile[4]))
    np.testing.assert_allclose(depth, np.broadcast_to(depth[1], (3, 2)), atol=0.05)


def test_the_wake_turns_with_the_wind() -> None:
    field = blown(Cylinder((0.0, 0.0), 2.0, 5.0))
    field.wind = steady(6.0, math.pi / 2)
    step_field(field, 12.0)
    free = 6.0 * field.profile[3]
    assert field.velocity[32, 16 + 6, 3, 1] < 0.6 * free
    assert field.velocity[32 + 8, 16, 3, 1] > 0.9 * free


def test_a_crown_lets_some_air_through_and_a_solid_none() -> None:
    inside = {}
    for name, share in (("solid", 0.0), ("dense", 0.3), ("light", 0.7)):
        field = blown(Spheroid((-10.0, 0.0, 4.0), 4.0, 4.0, share))
        inside[name] = field.velocity[22, 16, 4, 0] / (6.0 * field.profile[4])
    assert inside["solid"] == 0.0
    assert 0.05 < inside["dense"] < inside["light"] < 1.0


def test_obstacles_in_calm_air_move_nothing() -> None:
    field = small_field(obstacles=tuple(OBSTACLES.values()))
    step_field(field, 1.0)
    assert not field.velocity.any()


def test_no_obstacle_no_deflection() -> None:
    assert (deflect(OPEN, []).column == -1).all()
    far = deflect(OPEN, [Cylinder((0.0, 0.0), 2.0, 3.0)])
    assert (far.column[[1, -2], 30] == -1).all()
    assert far.column[30, 30] >= 0


def test_flow_over_a_slope_of_boxes_from_each_side_is_mirrored() -> None:
    field = start_field(FieldPlan(OPEN, obstacles=(Box((0.0, 0.0), (6.0, 10.0), 5.0),)), steady(4.0))
    step_field(field, 0.05)
    np.testing.assert_allclose(field.velocity[:, :, :, 0], field.velocity[:, ::-1, :, 0], atol=1e-4)
    np.testing.assert_allclose(field.velocity[:, :, :, 1], -field.velocity[:, ::-1, :, 1], atol=1e-4)
