from __future__ import annotations

import re
from importlib.resources import files

import numpy as np
import pytest

from windswept.gpu import layouts
from windswept.gpu.plant_drawing import LEAF_BATCH, STEM_BATCH
from windswept.gpu.wiring import SHADER_SETS, shader_module, shader_text

WGSL_TYPES = {"vec4f": layouts.REALS, "vec4u": layouts.COUNTS, "mat4x4f": layouts.MATRIX}
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
}


def shader_source(name: str) -> str:
    return (files("windswept.gpu") / "shaders" / f"{name}.wgsl").read_text()


def wgsl_structs() -> dict[str, list[tuple[str, str]]]:
    found = re.findall(r"struct (\w+) \{(.*?)\n\}", shader_source("types"), re.DOTALL)
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
