"""Turns of growth frames: exact directions, still orthonormal."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from windswept.plants.weber_penn import frames

ANGLE = st.floats(-7, 7)


def assert_square(frame):
    np.testing.assert_allclose(
        frame @ frame.transpose(0, 2, 1), np.tile(np.eye(3), (len(frame), 1, 1)), atol=1e-9
    )
    np.testing.assert_allclose(np.linalg.det(frame), 1.0, atol=1e-9)


def test_a_turn_about_x_tips_z_towards_minus_y():
    frame = frames.turn_about_x(frames.upright(1), np.pi / 6)
    np.testing.assert_allclose(frame[0, frames.Z], [0, -0.5, np.sqrt(0.75)], atol=1e-12)
    np.testing.assert_allclose(frames.declination(frame), np.pi / 6)


def test_a_turn_about_y_tips_z_towards_x():
    frame = frames.turn_about_y(frames.upright(1), np.pi / 6)
    np.testing.assert_allclose(frame[0, frames.Z], [0.5, 0, np.sqrt(0.75)], atol=1e-12)


def test_a_turn_about_z_keeps_z():
    frame = frames.turn_about_z(frames.upright(2), np.array([0.3, np.pi / 2]))
    np.testing.assert_allclose(frame[:, frames.Z], [[0, 0, 1]] * 2)
    np.testing.assert_allclose(frame[1, frames.X], [0, 1, 0], atol=1e-12)


@given(ANGLE, ANGLE, ANGLE)
def test_all_turns_keep_frames_square(a, b, c):
    start = frames.turn_about_z(frames.turn_about_x(frames.upright(3), a), b)
    axis = np.array([0.6, 0.0, 0.8])
    assert_square(frames.turn_about_y(start, c))
    assert_square(frames.tip_towards(start, np.full(3, b), c))
    assert_square(frames.turn_about_axis(start, axis, np.full(3, c)))


@given(ANGLE, ANGLE)
def test_a_turn_about_an_axis_is_the_same_as_about_its_own(a, b):
    start = frames.turn_about_z(frames.turn_about_x(frames.upright(1), a), b)
    own = frames.turn_about_x(start, 0.7)
    np.testing.assert_allclose(frames.turn_about_axis(start, start[:, frames.X], 0.7), own, atol=1e-9)


@given(ANGLE, st.floats(0, 3.0))
def test_turn_to_reaches_the_direction(heading, lean):
    start = frames.turn_about_x(frames.upright(1), 0.4)
    goal = frames.tip_towards(start, np.array([heading]), lean)[:, frames.Z]
    turned = frames.turn_to(start, goal)
    assert_square(turned)
    np.testing.assert_allclose(turned[:, frames.Z], goal, atol=1e-9)
