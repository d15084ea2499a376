"""The meadow on the card beside the CPU's poses, and what is chosen to be drawn."""

from __future__ import annotations

import re
from dataclasses import replace
from importlib.resources import files
from typing import Any

import numpy as np
import pytest

from windswept.gpu import layouts
from windswept.gpu.frame import Camera, Frame
from windswept.gpu.meadow import layouts as meadow_layouts
from windswept.gpu.meadow import meadow_drawing
from windswept.gpu.meadow.blade_list import BladeRules, Sharpness, blade_list
from windswept.gpu.meadow.meadow_drawing import BATCH, strip_triangles
from windswept.gpu.meadow.meadow_rows import LEVELS, MeadowRows
from windswept.gpu.wiring import shader_text
from windswept.render.staging import frame_now, stage
from windswept.scene.camera import View
from windswept.scene.load_scene import build_scene
from windswept.scene.simulation import Simulation

SIZE = (160, 96)
EYE = (0.0, -2.5, 0.5)


def meadow_scene(**more: Any) -> dict[str, Any]:
    stand = {
        "count": 24,
        "area": {"rectangle": [-0.8, -0.8, 0.8, 0.8]},
        "source": [
            {"source": "common_poppy", "spacing_m": 0.15},
            {"source": "meadow_fescue", "spacing_m": 0.1},
        ],
    }
    camera = {"eye": list(EYE), "target": [0.0, 0.0, 0.2]}
    return {"stand": [stand], "camera": camera, "wind": {"speed_m_s": 7.0}} | more


@pytest.fixture(scope="module")
def windy() -> Simulation:
    return Simulation(build_scene("m.toml", meadow_scene()), picture_height=SIZE[1] * 40).advance(0.51)


@pytest.fixture(scope="module")
def whole(device: Any, windy: Simulation) -> Any:
    """A renderer that leaves no blade and no section out."""
    return stage(windy, SIZE, blade_rules=BladeRules(1e-6, (1e-6, 1e-7), 1e4))


def posed_joints(renderer: Any) -> np.ndarray:
    """All posed joints, as the card holds them."""
    meadow = renderer.meadow
    data = renderer.canvas.device.queue.read_buffer(meadow._posed)
    return np.frombuffer(data, meadow_layouts.POSED_JOINT)


def posed_items(renderer: Any) -> np.ndarray:
    """(n, 4) what the card has chosen."""
    meadow = renderer.meadow
    data = renderer.canvas.device.queue.read_buffer(meadow.choice.items)
    return np.frombuffer(data, np.uint32).reshape(-1, 4)[: meadow.drawn_count]


def joints_of(rows: np.ndarray, item: np.ndarray, sections: int) -> np.ndarray:
    """(n, sections + 1, 3) places of items."""
    return rows["place"][item[:, 1, None] + np.arange(sections + 1)][..., :3]


def test_every_struct_has_its_numpy_type() -> None:
    source = (files("windswept.gpu") / "shaders" / "blades_types.wgsl").read_text()
    found = dict(re.findall(r"struct (\w+) \{(.*?)\n\}", source, re.DOTALL))
    types = {
        "BladeRow": meadow_layouts.BLADE_ROW,
        "BladeRun": meadow_layouts.BLADE_RUN,
        "PosedJoint": meadow_layouts.POSED_JOINT,
        "MeadowPass": meadow_layouts.MEADOW_PASS,
    }
    assert set(found) == set(types)
    wgsl = {"vec4f": layouts.REALS, "vec4u": layouts.COUNTS}
    for name, body in found.items():
        fields = re.findall(r"^\s*(\w+): (\w+),", body, re.MULTILINE)
        assert types[name] == np.dtype([(field, *wgsl[kind]) for field, kind in fields])
    assert f"const BATCH = {BATCH}u;" in shader_text("blades")


def test_poses_on_the_card_are_those_of_the_processor(whole: Any, windy: Simulation) -> None:
    """Within a thousandth of the blade's length: frames travel in 16 bits."""
    whole.draw(frame_now(windy))
    posed, items = posed_joints(whole), posed_items(whole)
    assert len(items) == windy.meadow.blade_count  # type: ignore[union-attr]
    ahead = windy.time - windy.step_count / 120.0
    number = 0
    for bed in windy.meadow.beds:  # type: ignore[union-attr]
        for blades, pose in zip(bed.blades, bed.pose(ahead), strict=True):
            mine = items[(items[:, 2] // LEVELS) == number]
            mine = mine[np.argsort(mine[:, 0])]
            got = joints_of(posed, mine, pose.joint.shape[1] - 1)
            worst = np.linalg.norm(got - pose.joint, axis=2).max()
            assert worst < 1e-3 * float(blades.kind.table.length.sum()) + 1e-4
            number += 1


def test_fewer_sections_have_the_same_tip(device: Any, windy: Simulation, whole: Any) -> None:
    whole.draw(frame_now(windy))
    fine, fine_items = posed_joints(whole), posed_items(whole)
    coarse = stage(windy, SIZE, blade_rules=BladeRules(1e-6, (1e9, 1e9), 1e4))
    coarse.draw(frame_now(windy))
    few, few_items = posed_joints(coarse), posed_items(coarse)
    rows: MeadowRows = coarse.meadow.rows
    leaf = next(n for n, s in enumerate(rows.sections) if s[0] > 4)
    a = fine_items[fine_items[:, 2] // LEVELS == leaf]
    b = few_items[few_items[:, 2] // LEVELS == leaf]
    tips = joints_of(fine, a[np.argsort(a[:, 0])], rows.sections[leaf, 0])[:, -1]
    near = joints_of(few, b[np.argsort(b[:, 0])], 2)[:, -1]
    length = 0.5
    assert np.linalg.norm(tips - near, axis=1).max() < 0.005 * length


def test_what_hangs_on_a_blade_brings_it_along(whole: Any) -> None:
    rows: MeadowRows = whole.meadow.rows
    planes = np.tile(np.array([0.0, 0.0, 0.0, 1.0]), (5, 1))
    wanted = blade_list(rows, Sharpness(np.array([0.0, -30.0, 1.0]), planes, 100.0), BladeRules(1.5))
    assert 0 < len(wanted.items) < 0.5 * len(rows.parent)
    chosen = set(wanted.items[:, 0].tolist())
    parents = rows.parent[wanted.items[:, 0]]
    assert all(parent in chosen for parent in parents[parents >= 0].tolist())
    assert sum(wanted.depth_counts) == len(wanted.items)
    carried = parents >= 0
    first = dict(wanted.items[:, :2].tolist())
    assert [first[p] for p in parents[carried].tolist()] == (wanted.items[carried, 3] // 16).tolist()
    assert (wanted.items[~carried, 3] == layouts.NONE).all()


def test_posed_joints_do_not_overlap(whole: Any) -> None:
    rows: MeadowRows = whole.meadow.rows
    planes = np.tile(np.array([0.0, 0.0, 0.0, 1.0]), (5, 1))
    wanted = blade_list(rows, Sharpness(np.array([0.0, -3.0, 1.0]), planes, 900.0), BladeRules())
    drawn = [
        (first + i * (sections + 1), sections + 1) for first, n, sections in wanted.draws for i in range(n)
    ]
    assert sorted(first for first, _ in drawn) == sorted(wanted.items[:, 1].tolist())
    assert sum(count for _, count in drawn) == wanted.joint_count


def test_nothing_is_chosen_behind_the_eye(whole: Any) -> None:
    planes = np.tile(np.array([0.0, -1.0, 0.0, -50.0]), (5, 1))
    wanted = blade_list(whole.meadow.rows, Sharpness(np.zeros(3), planes, 900.0), BladeRules())
    assert len(wanted.items) == 0
    assert wanted.draws == ()


def test_the_area_drawn_stays_as_blades_are_left_out(device: Any, windy: Simulation) -> None:
    """Half widths at the roots, summed over the leaves on the ground, whichever are left out."""
    view = View(np.array([0.0, -14.0, 1.0], np.float32), np.zeros(3, np.float32), 0.2)
    counts = []
    for pixels in (1.5, 4.0):
        renderer = stage(windy, SIZE, blade_rules=BladeRules(pixels))
        renderer.draw(frame_now(windy, view))
        posed, items = posed_joints(renderer), posed_items(renderer)
        rows: MeadowRows = renderer.meadow.rows
        leaf = np.bincount(rows.chunk_set[rows.chunk[rows.depth == 0]]).argmax()
        run = rows.runs[leaf * LEVELS + 2]
        whole = rows.borders[run["rows"][3]] * run["width"][1] * rows.blades["place"][:, 3]
        whole = whole[rows.chunk_set[rows.chunk] == leaf].sum()
        mine = items[items[:, 2] // LEVELS == leaf]
        drawn = posed["place"][mine[:, 1], 3]
        counts.append(np.sum(drawn > 0.0))
        # Which are left out is chance: three standard errors of so many.
        assert drawn.sum() == pytest.approx(whole, rel=3.0 / np.sqrt(counts[-1]))
    assert counts[0] > 1.5 * counts[1]


def test_the_same_frame_gives_the_same_picture_and_wind_another(whole: Any, windy: Simulation) -> None:
    frame = frame_now(windy)
    first = whole.draw(frame)
    np.testing.assert_array_equal(first, whole.draw(frame))
    later = Simulation(windy.scene, picture_height=SIZE[1] * 40).advance(0.9)
    moved = whole.draw(replace(frame, meadow=frame_now(later).meadow))
    assert (np.abs(first.astype(int) - moved).max(axis=2) > 20).mean() > 0.01


def test_strips_stay_within_their_batch() -> None:
    for sections in (2, 5):
        indices = strip_triangles(sections).reshape(BATCH, -1)
        low = 2 * (sections + 1) * np.arange(BATCH)
        np.testing.assert_array_equal(indices.min(axis=1), low)
        np.testing.assert_array_equal(indices.max(axis=1), low + 2 * sections + 1)


def test_the_last_blades_without_room_are_left_out_and_the_others_as_they_were(
    device: Any, windy: Simulation, monkeypatch: pytest.MonkeyPatch
) -> None:
    frame, rules = frame_now(windy), BladeRules(1e-6, (1e9, 1e9), 1e4)
    whole = stage(windy, SIZE, blade_rules=rules)
    picture, items = whole.draw(frame), posed_items(whole)
    room = int(0.4 * items[:, 1].max())
    monkeypatch.setattr(meadow_drawing, "MOST_JOINTS", room)
    few = stage(windy, SIZE, blade_rules=rules)
    shown = few.draw(frame)
    np.testing.assert_array_equal(posed_items(few), items)
    fits = items[:, 1] + 2 < room
    parents = few.meadow.rows.parent[items[fits, 0]]
    assert set(parents[parents >= 0].tolist()) <= set(items[fits, 0].tolist())
    assert (parents >= 0).any()
    posed, all_posed = (posed_joints(renderer)["place"] for renderer in (few, whole))
    np.testing.assert_array_equal(posed[items[fits, 1]], all_posed[items[fits, 1]])
    assert (np.abs(shown.astype(int) - picture).max(axis=2) > 20).any()


def test_an_empty_frame_of_a_meadow_is_drawn(whole: Any) -> None:
    picture = whole.draw(Frame((), Camera((0.0, 0.0, 20.0), (0.0, 0.0, 0.0))))
    assert picture[..., :3].std() > 1.0
