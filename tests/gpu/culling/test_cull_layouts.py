from __future__ import annotations

import re
from importlib.resources import files

import numpy as np
import pytest

from windswept.geometry.detail import FADE, LEAF_RUN
from windswept.gpu import layouts
from windswept.gpu.culling import culling
from windswept.gpu.culling import layouts as cull_layouts
from windswept.gpu.draw_list import CHUNK, NEAREST
from windswept.gpu.draw_plan import DRAWS, LEAVES, MOST_GROUPS, PIECES, POSES, STEMS, TALLY, WORDS
from windswept.gpu.wiring import shader_text

TYPES = {"vec4f": layouts.REALS, "vec4u": layouts.COUNTS, "array<vec4f, 5>": cull_layouts.PLANES}


def structs():
    source = (files("windswept.gpu") / "shaders" / "cull_types.wgsl").read_text()
    found = re.findall(r"struct (\w+) \{(.*?)\n\}", source, re.DOTALL)
    return {name: re.findall(r"^\s*(\w+): ([\w<]+(?:, 5>)?),", body, re.MULTILINE) for name, body in found}


@pytest.mark.parametrize("name", ["Standing", "DrawnKind", "Sight", "Choice", "Needs"])
def test_fields_agree_with_the_shader(name):
    layout = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).upper()
    expected = np.dtype([(field, *TYPES[kind]) for field, kind in structs()[name]])
    assert getattr(cull_layouts, layout) == expected


def test_every_struct_is_compared():
    assert set(structs()) == {"Standing", "DrawnKind", "Sight", "Choice", "Needs"}


@pytest.mark.parametrize(
    ("module", "line"),
    [
        ("cull", f"const NEAREST = {NEAREST};"),
        ("cull", f"const FADE = {FADE};"),
        ("cull", f"const LEAF_RUN = {LEAF_RUN:.1f};"),
        ("cull", f"const COLUMNS = {culling.BAND_COLUMNS}u;"),
        ("cull", f"const CLASSES = {cull_layouts.CLASSES}u;"),
        ("cull", f"const GROUP = {cull_layouts.GROUP}u;"),
        ("cull", f"const BANDS = {cull_layouts.BANDS}u;"),
        ("cull", f"const CHUNK = {CHUNK}u;"),
        ("curves", f"const CHUNK = {CHUNK}u;"),
        ("cull", f"const TALLY = {TALLY}u;"),
        ("cull_places", f"const POSES = {POSES}u;"),
        ("cull_places", f"const STEMS = {STEMS}u;"),
        ("cull_places", f"const DRAWS = {DRAWS}u;"),
        ("cull_places", f"const MOST = {MOST_GROUPS}u;"),
        ("cull_places", f"meshes: array<vec4u, {cull_layouts.MESH_LIMIT}>"),
    ],
)
def test_constants_agree_with_the_shader(module, line):
    assert line in shader_text(module)


def test_words_of_a_plan_do_not_overlap():
    assert (PIECES, LEAVES) == (STEMS + 3, STEMS + 6)
    assert LEAVES + 3 <= DRAWS
    assert DRAWS + 5 * cull_layouts.MESH_LIMIT <= TALLY
    assert TALLY + 9 <= WORDS
