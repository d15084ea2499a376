"""Rows of coupled links: agreement with the shader, and how its walks pass things on."""

from __future__ import annotations

import re
from importlib.resources import files

import numpy as np
import pytest

from handmade import random_tree
from windswept.gpu.layouts import COUNTS, NONE, REALS
from windswept.gpu.multibody import layouts
from windswept.gpu.multibody.coupled_arrays import rod_rows, ways
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


@pytest.mark.parametrize("name", ["TIP", "FOLLOWS", "FORKS", "LATER", "CARRIED", "RECORD", "SLOT"])
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
