"""Centre lines: curving, helices, attraction, splitting."""

import numpy as np
import pytest

from windswept.plants.weber_penn import frames
from windswept.plants.weber_penn.axes import grow_axes
from windswept.plants.weber_penn.tree import plant_tree


@pytest.fixture
def axes_of(sample_species):
    """Centre lines of ``count`` upright (or leaning) stems of an order."""

    def make(level, count=1, order=1, growth=None, lean=0.0, seed=0):
        species = sample_species({"levels": 4} | (growth or {}), *[level] * 4)
        tree = plant_tree(species, seed, 100_000, 100_000)
        return grow_axes(tree, order, frames.turn_about_x(frames.upright(count), lean), 0)

    return make


def leans(axes, stem=0):
    """Declination along one stem, degrees."""
    return np.degrees(frames.declination(axes.segment_frame[axes.segment_stem == stem]))


def test_curve_turns_evenly_after_the_first_segment(axes_of):
    np.testing.assert_allclose(leans(axes_of({"curve_res": 4, "curve": 40.0})), [0, 10, 20, 30], atol=1e-5)


def test_curve_back_turns_the_upper_half(axes_of):
    level = {"curve_res": 4, "curve": 40.0, "curve_back": -20.0}
    np.testing.assert_allclose(leans(axes_of(level)), [0, 20, 10, 0], atol=1e-5)


def test_curve_v_turns_at_most_by_its_share(axes_of):
    axes = axes_of({"curve_res": 5, "curve_v": 50.0}, count=200)
    z = axes.segment_frame[:, frames.Z].reshape(200, 5, 3)
    turn = np.degrees(np.arccos(np.clip((z[:, 1:] * z[:, :-1]).sum(axis=2), -1, 1)))
    assert turn.max() <= 10 + 1e-6
    assert 4 < turn.mean() < 6


def test_segments_join(axes_of):
    axes = axes_of({"curve_res": 6, "curve": 90.0, "seg_splits": 0.5, "split_angle": 30.0}, count=5)
    tip = axes.segment_base + axes.segment_frame[:, frames.Z]
    within = axes.segment_stem[1:] == axes.segment_stem[:-1]
    np.testing.assert_allclose(axes.segment_base[1:][within], tip[:-1][within], atol=1e-12)
    for stem in np.flatnonzero(axes.mother >= 0):
        own = axes.segment_base[axes.segment_stem == stem][0]
        of_mother = axes.segment_stem == axes.mother[stem]
        place = tip[of_mother & (axes.segment_index == axes.start[stem] - 1)]
        np.testing.assert_allclose(own, place[0], atol=1e-12)


def test_a_helix_keeps_its_angle_and_closes_its_turn(axes_of):
    axes = axes_of({"curve_res": 8, "curve_v": -30.0})
    np.testing.assert_allclose(leans(axes), 30.0, atol=1e-6)
    np.testing.assert_allclose(axes.segment_frame[:, frames.Z].sum(axis=0)[:2], 0.0, atol=1e-9)


@pytest.mark.parametrize(("strength", "better"), [(2.0, np.less), (-2.0, np.greater)])
def test_attraction_pulls_up_or_down_from_order_2_on(axes_of, strength, better):
    level, growth = {"curve_res": 8}, {"attraction_up": strength}
    pulled = leans(axes_of(level, order=2, growth=growth, lean=1.0))
    assert better(pulled[1:], pulled[:-1]).all()
    assert (pulled >= 0).all()
    np.testing.assert_allclose(leans(axes_of(level, order=1, growth=growth, lean=1.0)), np.degrees(1.0))


def test_attraction_is_declination_times_its_sine(axes_of):
    lean = leans(axes_of({"curve_res": 4}, order=2, growth={"attraction_up": 0.5}, lean=1.2))
    assert np.radians(lean[0] - lean[1]) == pytest.approx(0.5 * 1.2 * np.sin(1.2) / 4)


def test_splits_come_as_often_as_asked(axes_of):
    axes = axes_of({"curve_res": 3, "seg_splits": 0.25}, count=400)
    assert np.count_nonzero(axes.start == 1) == pytest.approx(100, abs=3)
    assert np.count_nonzero(axes.start == 2) == pytest.approx(125, abs=5)


def test_whole_splits_double_every_stem(axes_of):
    axes = axes_of({"curve_res": 4, "seg_splits": 1.0}, count=3)
    np.testing.assert_array_equal(np.bincount(axes.start), [3, 3, 6, 12])
    assert axes.segment_density[axes.segment_index == 3].sum() == pytest.approx(3)


def test_a_fork_opens_by_its_angle_and_closes_again(axes_of):
    level = {"curve_res": 8, "seg_splits": 0.125, "split_angle": 28.0}
    axes = axes_of(level, order=0, growth={"base_splits": 3}, seed=1)
    np.testing.assert_array_equal(axes.start[:4], [0, 1, 1, 1])
    np.testing.assert_allclose(leans(axes, 1)[0], 28.0, atol=1e-5)
    heading = [
        np.arctan2(*axes.segment_frame[axes.segment_stem == stem][0, frames.Z][[1, 0]]) for stem in (1, 2, 3)
    ]
    gaps = np.mod(np.diff(heading), 2 * np.pi)
    np.testing.assert_allclose(gaps, np.pi / 2, atol=1e-6)


def test_a_split_is_undone_along_the_rest(axes_of):
    axes = axes_of({"curve_res": 6, "split_angle": 25.0}, order=0, growth={"base_splits": 1})
    np.testing.assert_allclose(leans(axes, 0), [0, 25, 20, 15, 10, 5], atol=1e-5)


def test_a_leaning_stem_forks_less(axes_of):
    axes = axes_of({"curve_res": 2, "seg_splits": 1.0, "split_angle": 30.0}, count=1, lean=np.radians(20.0))
    np.testing.assert_allclose(leans(axes, 0), [20, 30], atol=1e-5)
    np.testing.assert_allclose(leans(axes, 1), [30], atol=1e-5)
