"""Rows of coupled links: agreement with the shader, and how its walks pass things on."""

from __future__ import annotations

import re
from importlib.resources import files

import numpy as np
import pytest

from handmade import random_tree
from stands import stand_of
from windswept.gpu.layouts import COUNTS, MULTIBODY, NONE, REALS
from windswept.gpu.multibody import layouts
from windswept.gpu.multibody.coupled_arrays import coupled_arrays, rod_rows, ways
from windswept.gpu.springs.kinds import GrownKind
from windswept.gpu.springs.room import block_size
from windswept.gpu.springs.rung_arrays import rung_arrays
from windswept.motion import build_model, finest_level

STRUCTS = {"Rod": layouts.ROD, "Coupled": layouts.COUPLED}


@pytest.fixture(scope="module")
def source() -> str:
    return (files("windswept.gpu") / "shaders" / "multibody_types.wgsl").read_text()


@pytest.mark.parametrize("name", STRUCTS)
def test_fields_agree_with_the_shader(source, name):
    body = re.search(rf"struct {name} \{{(.*?)\n\}}", source, re.DOTALL)
    assert body is not None
    fields = re.findall(r"^\s*(\w+): (\w+),", body[1], re.MULTILINE)
    kinds = {"vec4f": REALS, "vec4u": COUNTS}
    assert STRUCTS[name] == np.dtype([(field, *kinds[kind]) for field, kind in fields])


@pytest.mark.parametrize("name", ["TIP", "FOLLOWS", "FORKS", "LATER"])
def test_constants_agree_with_the_shader(source, name):
    assert f"const {name} = {getattr(layouts, name)}u;" in source


def test_ways_of_a_forked_plant():
    #        0 - 1 - 2 - 3
    #            |   4
    #            5 - 6          7
    parent = np.array([-1, 0, 1, 2, 2, 1, 5, -1], np.int32)
    tip, follows, forks, later = layouts.TIP, layouts.FOLLOWS, layouts.FORKS, layouts.LATER
    expected = [
        0,
        follows | forks,
        follows | forks | later,
        tip | follows | later,
        tip,
        0,
        tip | follows,
        tip,
    ]
    assert ways(parent).tolist() == expected


def test_a_link_before_one_that_does_not_follow_is_a_tip():
    # What the way from leaf to root holds in registers then begins anew.
    way = ways(build_model(random_tree(2)).skeleton.parent)
    follows = (way & layouts.FOLLOWS) != 0
    assert np.array_equal(~follows[1:], (way[:-1] & layouts.TIP) != 0)


def test_rods_hold_the_plant():
    model = build_model(random_tree(2))
    rows, skeleton = rod_rows(model, finest_level(model)), model.skeleton
    inner = skeleton.parent >= 0
    reach = np.linalg.norm(rows["foot"][:, :3], axis=1)
    expected = (skeleton.attach * skeleton.length[skeleton.parent])[inner]
    np.testing.assert_allclose(reach[inner], expected, rtol=1e-6)
    assert not reach[~inner].any()
    assert (rows["rows"][~inner, 0] == NONE).all()
    np.testing.assert_allclose(rows["mass"][:, 0], model.rods.mass, rtol=1e-6)
    np.testing.assert_allclose(rows["axis_1"][:, 3] * model.rods.compliance[:, 0], 1.0, rtol=1e-6)


def test_rods_of_a_merged_level_hold_its_groups(soft_trees, coupled_ladders):
    model = build_model(soft_trees[0])
    for place in coupled_ladders[0].merged(coupled=True):
        level = coupled_ladders[0].levels[place]
        rows, mass = rod_rows(model, level), model.rods.mass
        assert rows["mass"][:, 0].sum() == pytest.approx(mass.sum(), rel=1e-5)
        assert (rows["mass"][:, 0] > 1.01 * mass[level.link]).any()
        assert rows["mass"][-1, 3] == level.group_count
        assert np.array_equal(np.diff(rows["mass"][:, 3], prepend=0.0), np.diff(level.group_start[1:]))
        assert np.array_equal(rows["rows"][1:, 0], level.parent[1:])


def test_only_coupled_rungs_take_what_coupled_links_need(soft_trees, coupled_ladders):
    scene = stand_of(soft_trees, [70, 3])
    pairs = zip(soft_trees, coupled_ladders, scene.placements, strict=True)
    kinds = [GrownKind(tree, ladder.hierarchy.model, ladder, placed) for tree, ladder, placed in pairs]
    arrays = rung_arrays(kinds, 1 << 30)
    ours = coupled_arrays(kinds, arrays)
    is_coupled, links = arrays.coupled, arrays.rungs["links"][:, 1]
    assert 2 < is_coupled.sum() < len(is_coupled)
    assert np.array_equal(arrays.rungs["air"][:, 3] == MULTIBODY, is_coupled)
    assert not ours.coupled["pace"][~is_coupled].any()
    first_rod = ours.coupled["rows"][is_coupled, 0].astype(int)
    assert np.array_equal(np.append(first_rod, len(ours.rods))[1:] - first_rod, links[is_coupled])
    size, room = block_size(list(arrays.levels)), arrays.rungs["room"][:, 3].astype(int)
    assert not size.stack[is_coupled].any()
    assert size.stack[~is_coupled].all()
    for column, whole in zip(
        size.columns[:, 3:].T, (ours.carried_rows, ours.record_rows, ours.slot_rows), strict=True
    ):
        assert not column[~is_coupled].any()
        assert whole == (room * column).sum() > 0
