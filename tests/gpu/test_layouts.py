from __future__ import annotations

import re
from importlib.resources import files

import numpy as np
import pytest

from windswept.gpu import layouts
from windswept.gpu.plant_drawing import LEAF_BATCH, STEM_BATCH
from windswept.gpu.wiring import SHADER_SETS, shader_module, shader_text
from windswept.motion.multibody import constants
from windswept.motion.shapes import MAX_ANGLE

WGSL_TYPES = {
    "vec4f": layouts.REALS,
    "vec4u": layouts.COUNTS,
    "mat4x4f": layouts.MATRIX,
    "u32": layouts.COUNT,
}
STRUCTS = {
    "Frame": layouts.FRAME,
    "Placement": layouts.PLACEMENT,
    "Look": layouts.LOOK,
    "LinkPose": layouts.LINK_POSE,
    "Stem": layouts.STEM,
    "Piece": layouts.PIECE,
    "Leaf": layouts.LEAF,
    "StemShift": layouts.STEM_SHIFT,
    "PosedPiece": layouts.POSED_PIECE,
    "PosedLeaf": layouts.POSED_LEAF,
    "GrassBlade": layouts.GRASS_BLADE,
    "Batch": layouts.BATCH,
    "Listed": layouts.LISTED,
    "Kind": layouts.KIND,
    "Rung": layouts.RUNG,
    "Link": layouts.LINK,
    "Group": layouts.GROUP,
    "Shape": layouts.SHAPE,
    "Rooted": layouts.ROOTED,
    "Motion": layouts.MOTION,
    "Moment": layouts.MOMENT,
    "Air": layouts.AIR,
    "Wave": layouts.WAVE,
    "Gust": layouts.GUST,
    "Shift": layouts.SHIFT,
}
MOST_BUFFERS = 8
"""Storage buffers that every browser gives a shader."""


def shader_source(name: str) -> str:
    return (files("windswept.gpu") / "shaders" / f"{name}.wgsl").read_text()


def wgsl_structs() -> dict[str, list[tuple[str, str]]]:
    source = shader_source("types") + shader_source("motion")
    found = re.findall(r"struct (\w+) \{(.*?)\n\}", source, re.DOTALL)
    return {name: re.findall(r"^\s*(\w+): (\w+),", body, re.MULTILINE) for name, body in found}


def test_every_struct_has_its_numpy_type():
    assert set(wgsl_structs()) == set(STRUCTS)


@pytest.mark.parametrize("name", STRUCTS)
def test_fields_agree_with_the_shader(name):
    expected = np.dtype([(field, *WGSL_TYPES[kind]) for field, kind in wgsl_structs()[name]])
    assert STRUCTS[name] == expected


@pytest.mark.parametrize("name", SHADER_SETS)
def test_every_set_of_shaders_compiles(device, name):
    assert shader_module(device, name) is not None


@pytest.mark.parametrize(("name", "batch"), [("bark", STEM_BATCH), ("leaves", LEAF_BATCH)])
def test_batches_agree_with_the_shader(name, batch):
    assert f"const BATCH = {batch}u;" in shader_text(name)


def test_shaders_hold_no_templates():
    for parts in SHADER_SETS.values():
        for part in parts:
            assert "{{" not in shader_source(part)


@pytest.mark.parametrize("name", SHADER_SETS)
def test_no_set_takes_more_buffers_than_a_browser_gives(name):
    assert len(re.findall(r"var<storage", shader_text(name))) <= MOST_BUFFERS


@pytest.mark.parametrize(
    "line",
    [
        f"const LANES = {layouts.LANES}u;",
        f"const MAX_ANGLE = {MAX_ANGLE};",
    ],
)
def test_constants_of_the_motion_agree_with_the_shader(line):
    assert line in shader_source("motion")


@pytest.mark.parametrize(
    "name", ["STOP_ANGLE", "STOP_STIFFNESS", "MOST_ANGLE", "PULL_WEIGHT", "RATE_LEAD", "REST_THRESHOLD"]
)
def test_constants_of_coupled_links_agree_with_the_shader(name):
    line = f"const {name} = {getattr(constants, name)};"
    assert line.replace("e-09", "e-9") in shader_source("multibody_types")


def test_uniform_tables_are_as_long_as_their_layouts_say():
    for name, parts in SHADER_SETS.items():
        for part in parts:
            lengths = dict(re.findall(r"(rungs|kinds): array<\w+, (\d+)>", shader_source(part)))
            assert lengths.get("rungs", "800") == str(layouts.RUNG_LIMIT), name
            assert lengths.get("kinds", "64") == str(layouts.KIND_LIMIT), name
    assert layouts.RUNG_LIMIT * layouts.RUNG.itemsize <= 65536
