from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from windswept.geometry.detail import (
    LEAF_RUN,
    DetailRules,
    choose_detail,
    detail_order,
    in_runs,
    stem_size,
)

RULES = DetailRules()


@pytest.fixture(scope="module")
def order(aspen):
    return detail_order(aspen)


def drawn_area(detail, total):
    """Leaf area relative to all leaves at their own size, out of the ranks' own shrinking."""
    areas = []
    for k in range(len(detail.leaf_count)):
        rank = np.arange(min(detail.leaf_count[k], total))
        shrink = np.clip((detail.leaf_cut[k] - rank) / detail.leaf_fade[k], 0.0, 1.0)
        areas.append(np.sum((shrink * detail.leaf_scale[k]) ** 2) / total)
    return np.array(areas)


def test_near_plants_are_drawn_whole(order, aspen):
    detail = choose_detail(order, np.array([1e6]), RULES)
    assert detail.leaf_count[0] == aspen.leaf_count
    assert detail.leaf_scale[0] == pytest.approx(1.0)
    assert detail.piece_limit[0, -1] == aspen.piece_count


def test_leaf_area_is_kept_at_every_distance(order, aspen):
    detail = choose_detail(order, np.geomspace(2.0, 1000.0, 60), RULES)
    np.testing.assert_allclose(drawn_area(detail, aspen.leaf_count), 1.0, atol=5e-3)


def test_detail_falls_with_distance_and_never_jumps(order):
    pixels = np.geomspace(500.0, 2.0, 2000)
    detail = choose_detail(order, pixels, RULES)
    assert (np.diff(detail.leaf_count) <= 0).all()
    assert (np.diff(detail.piece_limit, axis=0) <= 0).all()
    assert np.abs(np.diff(detail.leaf_scale)).max() < 0.02


@pytest.mark.parametrize("total", [0, 1, 2, 7, 300, 301])
def test_leaves_are_drawn_in_whole_runs_up_to_the_last_that_has_a_size(order, total):
    few = replace(order, leaf_order=np.arange(total, dtype=np.int32))
    detail = choose_detail(few, np.geomspace(0.1, 1e5, 400), RULES)
    assert (detail.leaf_count % LEAF_RUN == 0).all()
    assert detail.leaf_count.max() == in_runs(total) < total + LEAF_RUN
    sized = np.minimum(np.ceil(detail.leaf_cut), total)
    assert ((sized <= detail.leaf_count) & (detail.leaf_count < sized + LEAF_RUN)).all()


@pytest.mark.parametrize("total", [1, 7, 301])
def test_near_by_an_odd_number_of_leaves_has_its_own_size(order, total):
    detail = choose_detail(replace(order, leaf_order=np.arange(total)), np.array([1e6]), RULES)
    assert detail.leaf_scale[0] == pytest.approx(1.0)
    np.testing.assert_allclose(drawn_area(detail, total), 1.0, rtol=1e-6)


def test_buckets_are_nested_and_finest_first(order):
    limits = choose_detail(order, np.array([5.0, 50.0, 500.0]), RULES).piece_limit
    assert (np.diff(limits, axis=1) >= 0).all()


def test_pieces_of_a_stem_share_a_bucket(order, aspen):
    """Else their rings would not match where they meet."""
    np.testing.assert_array_equal(stem_size(aspen)[aspen.piece_stem[order.piece_order]], order.piece_size)
    assert (np.diff(order.piece_size) <= 0).all()


def test_a_plant_without_leaves_has_an_order(aspen):
    bare = replace(
        aspen,
        **{name: getattr(aspen, name)[:0] for name in ("leaf_link", "leaf_rank", "leaf_size")},
    )
    detail = choose_detail(detail_order(bare), np.array([10.0]), RULES)
    assert detail.leaf_count[0] == 0
