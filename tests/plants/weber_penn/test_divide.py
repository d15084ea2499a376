"""Segments divided into links on a smooth curve."""

import numpy as np
import pytest

from windswept.plants.weber_penn import frames
from windswept.plants.weber_penn.axes import grow_axes
from windswept.plants.weber_penn.divide import divided
from windswept.plants.weber_penn.tree import plant_tree


@pytest.fixture
def axes(sample_species):
    """One bent, forked trunk of four segments."""
    species = sample_species({"base_splits": 2}, {"curve_res": 4, "curve": 120.0, "split_angle": 30.0})
    return grow_axes(plant_tree(species, 0, 1000, 1000), 0, frames.upright(1), 0)


def sharpest_turn(lines):
    """Largest angle between successive links of a stem, rad."""
    z = lines.frame[:, frames.Z]
    cosine = (z[1:] * z[:-1]).sum(axis=1)[lines.stem[1:] == lines.stem[:-1]]
    return np.arccos(np.clip(cosine, -1, 1)).max()


def test_one_link_a_segment_is_the_segment(axes):
    lines = divided(axes, 1, 4)
    np.testing.assert_allclose(lines.base, axes.segment_base / 4)
    np.testing.assert_allclose(lines.tip - lines.base, axes.segment_frame[:, frames.Z] / 4, atol=1e-12)


def test_links_join_pass_the_segment_ends_and_bend_less(axes):
    lines, coarse = divided(axes, 4, 4), divided(axes, 1, 4)
    within = lines.stem[1:] == lines.stem[:-1]
    np.testing.assert_array_equal(lines.base[1:][within], lines.tip[:-1][within])
    np.testing.assert_allclose(lines.base[::4], coarse.base, atol=1e-12)
    along = (lines.tip - lines.base) / np.linalg.norm(lines.tip - lines.base, axis=1, keepdims=True)
    np.testing.assert_allclose(lines.frame[:, frames.Z], along, atol=1e-9)
    assert sharpest_turn(lines) < 0.5 * sharpest_turn(coarse)


def test_z_runs_from_0_to_1(axes):
    lines = divided(axes, 2, 4)
    assert (lines.z_base[0], lines.z_tip[-1]) == (0.0, 1.0)
    np.testing.assert_allclose(lines.z_tip - lines.z_base, 1 / 8)
    np.testing.assert_array_equal(lines.z_base[lines.stem == 1][0], 0.25)


def test_of_stems_numbers_anew(axes):
    kept = divided(axes, 2, 4).of_stems(np.array([True, False, True]))
    np.testing.assert_array_equal(np.unique(kept.stem), [0, 1])
    assert len(kept.stem) == 8 + 6
