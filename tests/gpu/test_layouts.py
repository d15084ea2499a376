from __future__ import annotations

import re
from importlib.resources import files

import numpy as np
import pytest

from windswept.gpu import layouts
from windswept.gpu.culling.layouts import DRAWN_KIND
from windswept.gpu.multibody.layouts import COUPLED
from windswept.gpu.plant_drawing import LEAF_BATCH, STEM_BATCH
from windswept.gpu.springs import room
from windswept.gpu.wiring import SHADER_SETS, shader_module, shader_text
from windswept.levels.carry_over import CLOSE, MOST_ROUNDS, REGULAR
from windswept.motion.groups import REST_THRESHOLD
from windswept.motion.modal import MODE_COUNT
from windswept.motion.multibody import constants
from windswept.motion.shapes import MAX_ANGLE
from windswept.render.staging import LEVEL_LOOKS

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
        f"const STILL = {layouts.STILL:.1f};",
        f"const SPRINGS = {layouts.SPRINGS:.1f};",
        f"const MULTIBODY = {layouts.MULTIBODY:.1f};",
    ],
)
def test_constants_of_the_motion_agree_with_the_shader(line):
    assert line in shader_source("motion")


@pytest.mark.parametrize(
    "line",
    [
        f"const RECORD = {room.RECORD}u;",
        f"const MODE_RECORD = {room.MODE_RECORD}u;",
        f"const MODES = {MODE_COUNT}u;",
    ],
)
def test_constants_of_the_walk_agree_with_the_shader(line):
    assert line in shader_source("springs")


@pytest.mark.parametrize(
    "name",
    ["STOP_ANGLE", "STOP_STIFFNESS", "STOP_EDGE", "PULL_KNEE", "MOST_ANGLE", "RATE_LEAD", "REST_THRESHOLD"],
)
def test_constants_of_coupled_links_agree_with_the_shader(name):
    line = f"const {name} = {getattr(constants, name)};"
    assert line.replace("e-09", "e-9") in shader_source("multibody_types")


@pytest.mark.parametrize("name", ["CARRIED", "RECORD", "SLOT"])
def test_rows_of_coupled_links_agree_with_the_shader(name):
    assert f"const {name} = {getattr(layouts, name + '_ROWS')}u;" in shader_source("multibody_types")


@pytest.mark.parametrize(
    ("shader", "line"),
    [
        ("fit_groups", f"const MOST_ROUNDS = {MOST_ROUNDS}u;"),
        ("fit_groups", f"const REGULAR = {REGULAR};"),
        ("fit_groups", f"const CLOSE = {CLOSE};"),
        ("groups", f"const GROUP_REST_THRESHOLD = {REST_THRESHOLD};"),
    ],
)
def test_constants_of_groups_agree_with_the_shader(shader, line):
    assert line.replace("e-0", "e-") in shader_source(shader)


TABLE_LENGTHS = {
    "rungs": layouts.RUNG_LIMIT,
    "kinds": layouts.KIND_LIMIT,
    "coupled": layouts.RUNG_LIMIT,
    "looks": layouts.LOOK_LIMIT,
}


def test_uniform_tables_are_as_long_as_their_layouts_say():
    checked = set()
    for name, parts in SHADER_SETS.items():
        for part in parts:
            uniforms = re.findall(r"var<uniform> (\w+): array<\w+, (\d+)>", shader_source(part))
            for table, length in uniforms:
                if table in TABLE_LENGTHS:
                    assert int(length) == TABLE_LENGTHS[table], (name, part)
                    checked.add(table)
    assert checked == set(TABLE_LENGTHS)


@pytest.mark.parametrize(
    ("length", "layout"),
    [
        (layouts.RUNG_LIMIT, layouts.RUNG),
        (layouts.KIND_LIMIT, layouts.KIND),
        (layouts.KIND_LIMIT, DRAWN_KIND),
        (layouts.RUNG_LIMIT, COUPLED),
        (layouts.LOOK_LIMIT, layouts.LOOK),
    ],
)
def test_uniform_tables_fit_every_adapter(length, layout):
    assert length * layout.itemsize <= 65536


def test_the_colours_of_levels_find_room_beside_all_kinds():
    assert layouts.KIND_LIMIT + len(LEVEL_LOOKS) <= layouts.LOOK_LIMIT
