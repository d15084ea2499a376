"""Weber and Penn's plain formulas against hand values (PHYSICS B8)."""

import numpy as np
import pytest

from windswept.plants.weber_penn.formulas import (
    child_count,
    child_length,
    child_radius,
    envelope_ratio,
    shape_ratio,
)


@pytest.mark.parametrize(
    ("shape", "ratio", "expected"),
    [
        (0, 0.0, 0.2),
        (0, 0.5, 0.6),
        (1, 0.5, 1.0),
        (1, 1 / 6, 0.6),
        (2, 1.0, 1.0),
        (2, 1 / 3, 0.6),
        (3, 0.3, 1.0),
        (4, 0.0, 0.5),
        (4, 0.5, 0.75),
        (5, 0.35, 0.5),
        (5, 0.7, 1.0),
        (5, 0.85, 0.5),
        (6, 0.5, 0.6),
        (7, 0.35, 0.75),
        (7, 0.7, 1.0),
        (7, 0.85, 0.75),
    ],
)
def test_shape_ratio(shape, ratio, expected):
    assert shape_ratio(shape, ratio) == pytest.approx(expected)


@pytest.mark.parametrize("shape", range(8))
def test_shape_ratios_lie_in_0_to_1(shape):
    ratio = shape_ratio(shape, np.linspace(0, 1, 101))
    assert ratio.shape == (101,)
    assert ratio.min() >= -1e-12
    assert ratio.max() <= 1 + 1e-12


@pytest.mark.parametrize(
    ("ratio", "expected"),
    [(0.0, 0.0), (0.1, 0.5), (0.4, 1.5**0.001), (0.6, 1.0), (0.9, 0.25**0.001), (-0.01, 0.0), (1.01, 0.0)],
)
def test_envelope_of_the_willow(ratio, expected):
    assert envelope_ratio(ratio, 0.6, 0.001, 0.5) == pytest.approx(expected)


def test_shape_8_is_the_envelope(sample_species):
    growth = sample_species({"prune_width_peak": 0.6, "prune_power_low": 0.001}).growth
    assert shape_ratio(8, 0.1, growth) == pytest.approx(0.5)
    with pytest.raises(ValueError, match="pruning parameters"):
        shape_ratio(8, 0.1)


def test_child_length_and_radius():
    assert child_length(4.0, 1.0, 0.5) == pytest.approx(0.5 * (4 - 0.6))
    assert child_radius(0.2, 0.25, 1.5) == pytest.approx(0.2 / 8)


def test_child_counts():
    ones = np.ones(1)
    assert child_count(1, 50, ones, ones) == 50
    assert child_count(2, 30, 0.5 * ones, ones) == pytest.approx(18)
    assert child_count(3, 12, ones, 0.5 * ones) == pytest.approx(9)
