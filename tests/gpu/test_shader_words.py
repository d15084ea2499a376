"""Shaders use no word that WGSL keeps for itself: browsers refuse what naga lets pass."""

from __future__ import annotations

import re
from importlib.resources import files

import pytest

RESERVED = """
NULL Self abstract active alignas alignof as asm asm_fragment async attribute auto await become cast catch class
co_await co_return co_yield coherent column_major common compile compile_fragment concept const_cast consteval
constexpr constinit crate debugger decltype delete demote demote_to_helper do dynamic_cast enum explicit export
extends extern external fallthrough filter final finally friend from fxgroup get goto groupshared highp impl
implements import inline instanceof interface layout lowp macro macro_rules match mediump meta mod module move mut
mutable namespace new nil noexcept noinline nointerpolation non_coherent noncoherent noperspective null nullptr of
operator package packoffset partial pass patch pixelfragment precise precision premerge priv protected pub public
readonly ref regardless register reinterpret_cast require resource restrict self set shared sizeof smooth snorm
static static_assert static_cast std subroutine super target template this thread_local throw trait try type
typedef typeid typename typeof union unless unorm unsafe unsized use using varying virtual volatile wgsl where
with writeonly yield
"""
SHADERS = sorted(
    (path for path in (files("windswept.gpu") / "shaders").iterdir() if path.name.endswith(".wgsl")),
    key=lambda path: path.name,
)


@pytest.mark.parametrize("shader", SHADERS, ids=lambda path: path.name)
def test_no_reserved_word(shader):
    code = re.sub(r"//.*", "", shader.read_text(encoding="utf-8"))
    assert set(re.findall(r"[A-Za-z_]\w*", code)) & set(RESERVED.split()) == set()


@pytest.mark.parametrize("shader", SHADERS, ids=lambda path: path.name)
def test_no_variable_is_left_without_a_value_in_a_loop(shader):
    # naga clears it once a function, not once a turn.
    depth, loops = 0, []
    for line in re.sub(r"//.*", "", shader.read_text(encoding="utf-8")).splitlines():
        if re.search(r"\b(for|while|loop)\b", line):
            loops.append(depth)
        assert not (loops and re.search(r"\bvar \w+: \w+;", line)), line
        depth += line.count("{") - line.count("}")
        while loops and depth <= loops[-1]:
            loops.pop()
