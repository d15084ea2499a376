"""Verification of the height profile against the log law and its canopy continuation."""

import math

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.wind.mean import MeanWind, Profile, profile_factor


def test_log_law_values() -> None:
    # U(z) / U(10 m) = ln(z / z0) / ln(10 m / z0) with z0 = 0.1 m.
    for z in (0.5, 2.0, 10.0, 40.0):
        assert profile_factor(Profile(roughness=0.1), z) == pytest.approx(math.log(z / 0.1) / math.log(100.0))


def test_displacement_shifts_the_law() -> None:
    profile = Profile(roughness=0.5, displacement=4.0, reference_height=20.0)
    assert profile_factor(profile, 12.0) == pytest.approx(math.log(8.0 / 0.5) / math.log(16.0 / 0.5))


def test_canopy_top_of_usual_ratios_is_the_join() -> None:
    # d = 0.7 h and z0 = 0.1 h join within 3 % of h.
    assert Profile(roughness=0.5, displacement=3.5, reference_height=20.0).join_height == pytest.approx(
        5.0, rel=0.03
    )


@pytest.mark.parametrize("profile", [Profile(), Profile(1.0, 7.0, 30.0), Profile(0.01), Profile(0.3, 2.0)])
def test_profile_is_smooth_rising_and_never_negative(profile: Profile) -> None:
    z = np.linspace(-1.0, 3.0 * profile.join_height, 20001)
    factor = profile_factor(profile, z)
    assert np.isfinite(factor).all()
    assert (factor > 0.0).all()
    assert (np.diff(factor) >= 0.0).all()
    slope = np.diff(factor) / np.diff(z)
    start = np.searchsorted(z, 0.0) + 1
    assert np.abs(np.diff(slope[start:])).max() < 0.01 * slope.max()


def test_below_ground_counts_as_on_the_ground() -> None:
    assert profile_factor(Profile(), -3.0) == profile_factor(Profile(), 0.0)


def test_mean_vector_points_where_the_air_goes() -> None:
    assert MeanWind(2.0, math.pi / 2).vector == pytest.approx((0.0, 2.0))


@pytest.mark.parametrize(
    ("values", "place"),
    [
        ((0.0, 0.0, 10.0), "roughness"),
        ((math.nan, 0.0, 10.0), "roughness"),
        ((0.1, -1.0, 10.0), "displacement"),
        ((1.0, 9.0, 10.0), "reference_height"),
        ((0.1, 0.0, math.inf), "reference_height"),
    ],
)
def test_bad_profiles_say_what_is_wrong(values: tuple[float, float, float], place: str) -> None:
    with pytest.raises(InputError, match=place):
        Profile(*values)
