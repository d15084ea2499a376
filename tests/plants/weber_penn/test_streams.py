"""Streams are named, repeatable and independent."""

import numpy as np

from windswept.plants.weber_penn.streams import Streams, vary


def test_same_name_same_numbers_and_other_names_other_numbers():
    one = Streams(3).vary("length", 1, 1.0, 5)
    np.testing.assert_array_equal(one, Streams(3).vary("length", 1, 1.0, 5))
    for other in (Streams(4).vary("length", 1, 1.0, 5), Streams(3).vary("rotate", 1, 1.0, 5)):
        assert (one != other).all()
    assert (one != Streams(3).vary("length", 2, 1.0, 5)).all()


def test_drawing_more_keeps_the_first():
    np.testing.assert_array_equal(Streams(3).vary("x", 0, 1.0, 9)[:5], Streams(3).vary("x", 0, 1.0, 5))


def test_vary_stays_within_its_spread():
    drawn = vary(Streams(0).generator("x"), 0.5, 1000)
    assert -0.5 <= drawn.min() < -0.45
    assert 0.45 < drawn.max() <= 0.5
