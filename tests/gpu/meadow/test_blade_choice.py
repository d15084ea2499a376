"""Which blades are drawn: the card's lists are the CPU's, row for row."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from windswept.gpu.buffers import UNIFORM_STRIDE
from windswept.gpu.frame import Camera
from windswept.gpu.layouts import COUNTS, REALS
from windswept.gpu.matrices import camera_matrix, frustum_planes
from windswept.gpu.meadow import blade_choice, choice_layouts, meadow_drawing
from windswept.gpu.meadow.blade_choice import LAST, MOST_DEPTH, BladeChoice
from windswept.gpu.meadow.blade_list import NEAREST, BladeList, BladeRules, Sharpness, blade_list
from windswept.gpu.meadow.layouts import MEADOW_PASS
from windswept.gpu.meadow.meadow_rows import CHUNK, LEVELS, MeadowRows, meadow_rows
from windswept.gpu.wiring import shader_text
from windswept.scene.load_scene import build_scene
from windswept.scene.simulation import Simulation

RULES = BladeRules(2.0, (9.0, 4.0), 9.0)
ROOM = 1 << 20
GROUP, ROW = 64, 65536
"""Threads of a workgroup that poses, and of a row of them."""
EYES = [(0.0, -1.0, 0.4), (2.0, -6.0, 1.5), (0.0, 0.2, 30.0), (40.0, 40.0, 2.0)]


@pytest.fixture(scope="module")
def rows() -> MeadowRows:
    area = {"rectangle": [-2.0, -2.0, 2.0, 2.0]}
    sources = [{"source": name, "spacing_m": 0.12} for name in ("common_poppy", "heather", "meadow_fescue")]
    camera = {"eye": [0.0, -3.0, 1.0], "target": [0.0, 0.0, 0.2]}
    scene = build_scene(
        "m.toml", {"stand": [{"count": 40, "area": area, "source": sources}], "camera": camera}
    )
    meadow = Simulation(scene).meadow
    assert meadow is not None
    return meadow_rows(meadow.beds)


def sharpness(eye: tuple[float, float, float]) -> Sharpness:
    camera = Camera(eye, (0.0, 0.3, 0.2))
    return Sharpness(np.array(eye), frustum_planes(camera_matrix(camera, 1.6)), 900.0)


def chosen(device: Any, choice: BladeChoice, look: Sharpness) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Items, plan and passes, read back."""
    encoder = device.create_command_encoder()
    choice.record(encoder, look, 0.004, {})
    device.queue.submit([encoder.finish()])
    items, plan, passes = (
        np.frombuffer(device.queue.read_buffer(buffer), np.uint32)
        for buffer in (choice.items, choice.plan, choice.passes)
    )
    return items.reshape(-1, 4), plan, passes


def pass_rows(passes: np.ndarray) -> np.ndarray:
    words = passes.reshape(-1, UNIFORM_STRIDE // 4)[:, : MEADOW_PASS.itemsize // 4]
    return np.ascontiguousarray(words).view(MEADOW_PASS).ravel()


@pytest.mark.parametrize("eye", EYES)
def test_lists_and_indirect_arguments_are_the_cpus(device, rows, eye):
    choice, look = BladeChoice(device, rows, RULES, ROOM), sharpness(eye)
    items, plan, passes = chosen(device, choice, look)
    wanted: BladeList = blade_list(rows, look, RULES)
    np.testing.assert_array_equal(items[: len(wanted.items)], wanted.items)
    assert plan[LAST] == wanted.joint_count
    told = pass_rows(passes)
    first = 0
    for depth, count in enumerate(wanted.depth_counts):
        groups = plan[3 * depth : 3 * depth + 3].tolist()
        most = ROW
        assert groups == [-(-min(count, most) // GROUP), -(-count // most), 1]
        assert told["items"][depth].tolist() == [first, count, 0, 0]
        first += count
    drawn = {sections: (joint, count) for joint, count, sections in wanted.draws}
    for row, sections in enumerate(choice.section_numbers):
        joint, count = drawn.get(sections, (None, 0))
        batch = meadow_drawing.BATCH
        arguments = plan[3 * MOST_DEPTH + 5 * row :][:5].tolist()
        assert arguments == [6 * sections * min(batch, count), -(-count // batch), 0, 0, 0]
        mine = told[MOST_DEPTH + row]
        assert mine["items"][1:3].tolist() == [count, 2 * (sections + 1)]
        assert count == 0 or mine["items"][0] == joint
        np.testing.assert_allclose(mine["now"], [0.004, 900.0, RULES.width_pixels, RULES.reach])


def test_without_room_for_their_joints_blades_have_fewer_sections(device, rows):
    look = sharpness(EYES[0])
    free = blade_list(rows, look, RULES)
    fewest = blade_list(rows, look, RULES, room=0)
    between = (free.joint_count + fewest.joint_count) // 2
    assert fewest.joint_count < between < free.joint_count
    for room in (between, fewest.joint_count):
        items, plan, _ = chosen(device, BladeChoice(device, rows, RULES, room), look)
        wanted = blade_list(rows, look, RULES, room)
        assert wanted.joint_count <= room
        np.testing.assert_array_equal(items[: len(wanted.items)], wanted.items)
        assert plan[LAST] == wanted.joint_count


def test_what_has_no_room_at_all_is_neither_drawn_nor_posed(device, rows):
    look = sharpness(EYES[0])
    room = blade_list(rows, look, RULES, room=0).joint_count // 2
    choice = BladeChoice(device, rows, RULES, room)
    told = pass_rows(chosen(device, choice, look)[2])[MOST_DEPTH:]["items"]
    ends = told[:, 0] + told[:, 1] * (
        np.pad(choice.section_numbers, (0, len(told) - len(choice.section_numbers))) + 1
    )
    assert 0 < ends[told[:, 1] > 0].max() <= room
    assert told[:, 1].sum() > 0.4 * len(blade_list(rows, look, RULES).items)


def test_eyes_see_many_levels_many_blades_and_none(rows):
    """What the parity above is worth: all levels, blades left out, and an empty list."""
    lists = [blade_list(rows, sharpness(eye), RULES) for eye in EYES]
    assert {len(one.draws) for one in lists} >= {0, 4, 5}
    assert min(len(one.items) for one in lists[:2]) > 0
    assert len(lists[1].items) < 0.8 * len(rows.parent)
    assert max(len(one.depth_counts) for one in lists) == 3
    assert len(rows.chunk_set) > 20


def test_the_choice_is_the_same_every_time_and_keeps_nothing(device, rows):
    choice = BladeChoice(device, rows, RULES, ROOM)
    first = chosen(device, choice, sharpness(EYES[0]))
    chosen(device, choice, sharpness(EYES[1]))
    count = len(blade_list(rows, sharpness(EYES[0]), RULES).items)
    again = chosen(device, choice, sharpness(EYES[0]))
    np.testing.assert_array_equal(first[0][:count], again[0][:count])
    for a, b in zip(first[1:], again[1:], strict=True):
        np.testing.assert_array_equal(a, b)


def test_an_eye_that_stands_chooses_once_and_time_goes_on(device, rows):
    choice = BladeChoice(device, rows, RULES, ROOM)
    first = chosen(device, choice, sharpness(EYES[0]))
    encoder = device.create_command_encoder()
    choice.record(encoder, sharpness(EYES[0]), 0.007, {})
    device.queue.submit([encoder.finish()])
    passes = np.frombuffer(device.queue.read_buffer(choice.passes), np.uint32)
    later = pass_rows(passes)[: choice.depths]
    np.testing.assert_allclose(later["now"][:, 0], 0.007)
    np.testing.assert_array_equal(later["items"], pass_rows(first[2])["items"][: choice.depths])
    np.testing.assert_array_equal(later["now"][:, 1:], pass_rows(first[2])["now"][: choice.depths, 1:])


def test_structs_and_numbers_agree_with_the_shader():
    text = shader_text("blade_choice")
    kinds = {
        "vec4f": REALS,
        "vec4u": COUNTS,
        "array<vec4f, 5>": choice_layouts.PLANES,
        "array<vec4u, 4>": choice_layouts.SECTION_NUMBERS,
    }
    for name, dtype in (("ChunkRow", choice_layouts.CHUNK_ROW), ("ChoiceLook", choice_layouts.CHOICE_LOOK)):
        body = re.search(rf"struct {name} \{{(.*?)\n\}}", text, re.DOTALL)
        assert body is not None
        fields = re.findall(r"^\s*(\w+): ([\w<>, ]+),", body[1], re.MULTILINE)
        assert np.dtype([(field, *kinds[kind]) for field, kind in fields]) == dtype
    for line in (
        f"NEAREST = {NEAREST};",
        f"CHUNK = {CHUNK}u;",
        f"BATCH = {meadow_drawing.BATCH}u;",
        f"MOST_DEPTH = {blade_choice.MOST_DEPTH}u;",
        f"LAST = {LAST}u;",
        f"COARSEST = {LEVELS - 1}u;",
        f"GROUP = {GROUP}u;",
        f"ROW = {ROW}u;",
        f"STRIDE = {UNIFORM_STRIDE // 16}u;",
    ):
        assert line in text
    pose = shader_text("blades_pose")
    assert f"@workgroup_size({GROUP})" in pose
    assert f"id.y * {ROW}u" in pose
