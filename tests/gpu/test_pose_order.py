"""Links and stems by when they are first needed: nobody who is drawn lacks a pose, and few are posed for nothing."""

from __future__ import annotations

import numpy as np
import pytest

from handmade import random_tree, with_leaves
from windswept.geometry.curves import build_geometry
from windswept.geometry.detail import DetailRules, choose_detail, detail_order, in_runs
from windswept.gpu.pose_order import pose_order
from windswept.plants.weber_penn import grow

RULES = DetailRules(stem_pixels=(24.0, 7.0, 2.0, 0.3), leaf_pixels=3.0, leaf_scale_limit=5.0)
OTHERS = DetailRules(stem_pixels=(50.0, 20.0, 9.0, 2.0), leaf_pixels=1.0, leaf_scale_limit=2.0)


@pytest.fixture(scope="module", params=[(4, 0), (7, 0), (7, 1)])
def drawn(request):
    """Two trees, and one with an odd number of leaves."""
    seed, fewer = request.param
    plant = random_tree(seed)
    plant = with_leaves(plant, plant.leaf_count - fewer)
    geometry = build_geometry(plant)
    order = detail_order(geometry)
    return plant, geometry, order, pose_order(geometry, plant.link_parent, order, RULES)


def needed_by(plant, geometry, order, pieces, leaves):
    """Links and stems, by walking up from everything that is drawn."""
    links, stems = set(), set()

    def need_link(link):
        while link >= 0 and link not in links:
            links.add(link)
            link = int(plant.link_parent[link])

    def need_stem(stem):
        while stem >= 0 and stem not in stems:
            stems.add(stem)
            need_link(int(geometry.stem_link[stem]))
            if geometry.stem_parent[stem] >= 0:
                for link in geometry.piece_link[geometry.stem_attach_piece[stem]]:
                    need_link(int(link))
            stem = int(geometry.stem_parent[stem])

    for piece in order.piece_order[:pieces]:
        need_stem(int(geometry.piece_stem[piece]))
        for link in geometry.piece_link[piece]:
            need_link(int(link))
    for leaf in order.leaf_order[:leaves]:
        need_stem(int(geometry.leaf_stem[leaf]))
        need_link(int(geometry.leaf_link[leaf]))
    return links, stems


@pytest.mark.parametrize("rules", [RULES, OTHERS])
def test_everything_that_is_drawn_is_posed(drawn, rules):
    plant, geometry, order, pose = drawn
    pixels = np.geomspace(0.1, 1e4, 40)
    detail = choose_detail(order, pixels, rules)
    reach = pose.reach(detail.piece_limit[:, -1], detail.leaf_count)
    for (links, stems), pieces, leaves in zip(
        reach, detail.piece_limit[:, -1], detail.leaf_count, strict=True
    ):
        # The stems that are shifted need their links too, drawn or not.
        needed_links, needed_stems = needed_by(plant, geometry, order, int(pieces), int(leaves))
        assert needed_stems <= set(pose.stem_order[:stems].tolist())
        assert needed_links <= set(pose.link_order[:links].tolist())


def test_a_leaf_that_fills_up_a_run_needs_no_more_than_the_last(drawn):
    plant, _, _, pose = drawn
    assert len(pose.leaf_reach) == in_runs(plant.leaf_count) + 1
    last = pose.leaf_reach[plant.leaf_count :]
    np.testing.assert_array_equal(last, np.broadcast_to(last[0], last.shape))


def test_stems_that_are_shifted_find_their_links(drawn):
    _, geometry, _, pose = drawn
    for links, stems in pose.piece_reach.tolist() + pose.leaf_reach.tolist():
        for stem in pose.stem_order[:stems]:
            own = [geometry.stem_link[stem]]
            if geometry.stem_parent[stem] >= 0:
                own += geometry.piece_link[geometry.stem_attach_piece[stem]].tolist()
            assert pose.link_rank[own].max() < links


def test_parents_come_first_and_ranks_are_an_order(drawn):
    plant, geometry, _, pose = drawn
    for order, rank, parent in (
        (pose.link_order, pose.link_rank, plant.link_parent),
        (pose.stem_order, pose.stem_rank, geometry.stem_parent),
    ):
        np.testing.assert_array_equal(order[rank], np.arange(len(order)))
        has_parent = parent >= 0
        assert (rank[parent[has_parent]] < rank[has_parent]).all()


@pytest.mark.parametrize(("limit", "leaves", "links"), [(5.0, 1123, 1893), (25.0, 45, 240)])
def test_a_far_crown_poses_what_carries_its_last_leaves(limit, leaves, links):
    """An aspen a kilometre away, a metre as large as half a pixel."""
    plant = grow("quaking_aspen")
    geometry, rules = build_geometry(plant), DetailRules(leaf_scale_limit=limit)
    order = detail_order(geometry)
    pose = pose_order(geometry, plant.link_parent, order, rules)
    detail = choose_detail(order, np.array([0.6]), rules)
    assert detail.piece_limit[0, -1] == 0
    assert detail.leaf_count[0] == pytest.approx(leaves, rel=0.05)
    assert pose.reach(detail.piece_limit[:, -1], detail.leaf_count)[0, 0] == pytest.approx(links, rel=0.05)


def test_hardly_more_is_posed_than_is_needed(drawn):
    plant, geometry, order, pose = drawn
    detail = choose_detail(order, np.geomspace(1.0, 3e3, 25), RULES)
    reach = pose.reach(detail.piece_limit[:, -1], detail.leaf_count)
    needed = [
        len(needed_by(plant, geometry, order, int(pieces), int(leaves))[0])
        for pieces, leaves in zip(detail.piece_limit[:, -1], detail.leaf_count, strict=True)
    ]
    assert (reach[:, 0] <= np.array(needed) * 1.1 + 2).all()
    assert reach[0, 0] < plant.link_count == reach[-1, 0]
