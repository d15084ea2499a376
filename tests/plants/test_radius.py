"""Taper, flare and lobes against hand values of Weber and Penn's formulas (PHYSICS B8)."""

import numpy as np
import pytest

from windswept.plants.radius import bulge_factor, flare_factor, lobe_factor, taper_radius, unit_taper


@pytest.mark.parametrize(
    ("taper", "lost"), [(0, 0), (0.5, 0.5), (1, 1), (1.25, 0.75), (2, 0), (2.7, 0), (3, 0)]
)
def test_unit_taper(taper, lost):
    assert unit_taper(taper) == lost


@pytest.mark.parametrize(
    ("taper", "z", "expected"),
    [
        (0.0, 1.0, 0.1),  # cylinder
        (0.5, 0.5, 0.075),
        (1.0, 0.25, 0.075),  # cone
        (1.0, 1.0, 0.0),
        (2.0, 0.5, 0.1),  # cylinder away from its round end
        (2.0, 0.95, np.sqrt(0.1**2 - 0.05**2)),  # Z2 = 0.05, Z3 - r = -0.05
        (2.0, 1.0, 0.0),
        (1.5, 0.9, 0.055),  # taper_Z = 0.1 (1 - 0.5 x 0.9) = Z3 - 0.045
        (3.0, 0.5, 0.1),  # Z2 = 0.5, beads 0.2 apart: Z3 = 0.1, the belly of a bead
        (3.0, 0.6, 0.0),  # Z2 = 0.4, between two beads
        (2.5, 0.6, 0.05),  # half as deep
    ],
)
def test_taper_radius_by_hand(taper, z, expected):
    assert taper_radius(0.1, taper, z, 1.0) == pytest.approx(expected, abs=1e-9)


def test_taper_broadcasts_and_is_finite_for_no_radius():
    radius = taper_radius(np.array([[0.0], [0.2]]), np.array([0.5, 1.5, 3.0]), 0.3, 2.0)
    assert radius.shape == (2, 3)
    assert np.isfinite(radius).all()
    assert (radius[0] == 0).all()


def test_round_end_is_a_hemisphere():
    height = np.linspace(0, 0.1, 11)
    radius = taper_radius(0.1, 2.0, 1.0 - height, 1.0)
    np.testing.assert_allclose(radius**2 + (0.1 - height) ** 2, 0.01, atol=1e-12)


def test_flare_is_one_above_an_eighth_and_nearly_one_plus_flare_at_the_foot():
    np.testing.assert_array_equal(flare_factor(0.6, np.array([0.125, 0.5, 1.0])), 1.0)
    assert flare_factor(0.6, 0.0) == pytest.approx(1 + 0.99 * 0.6)
    assert flare_factor(1.0, 1 / 16) == pytest.approx(1 + (10 - 1) / 100)


def test_lobes_bulge_as_often_as_asked():
    angle = np.linspace(0, 2 * np.pi, 721)
    factor = lobe_factor(5, 0.07, angle)
    assert factor.max() == pytest.approx(1.07, abs=1e-4)
    assert np.count_nonzero(np.diff(np.sign(np.diff(factor))) < 0) == 5
    assert lobe_factor(0, 0.3, 1.0) == 1.0


def test_bulges_swell_and_narrow_along_the_stem():
    # Skjermo equation 4: 1 + b_d sin(2 pi b_n v).
    found = bulge_factor(5, 0.1, [0.0, 0.05, 0.1, 0.15, 1.0])
    np.testing.assert_allclose(found, [1.0, 1.1, 1.0, 0.9, 1.0], atol=1e-12)
    np.testing.assert_array_equal(bulge_factor(0, 0.1, [0.0, 0.3]), 1.0)
