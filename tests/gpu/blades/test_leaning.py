"""Blades that move on the card: parity with the CPU, rest, and what holds whatever the card."""

from __future__ import annotations

import re
from dataclasses import replace
from time import perf_counter

import numpy as np
import pytest
import wgpu

from windswept.gpu.blades import Leaning, layouts, lean_rows
from windswept.gpu.layouts import COUNTS, REALS
from windswept.gpu.wiring import shader_text
from windswept.motion.blades import (
    Blades,
    BladeState,
    PackedField,
    TuftPlaces,
    build_kind,
    pack_field,
    place_blades,
    plant_tufts,
    pose_blades,
    rest_blades,
    step_in_field,
)
from windswept.motion.blades.blades import CONSTANT_COUNT, STATE_COUNT
from windswept.motion.blades.lean import lean_of_load
from windswept.motion.blades.pose_blades import rest_frame
from windswept.motion.blades.pose_table import Bins
from windswept.motion.blades.step_blades import LARGEST_FORCE, REST_THRESHOLD
from windswept.motion.blades.step_plain import drag_of_air
from windswept.motion.lanes import WIDTH
from windswept.plants.underbrush import grow_tuft, load_underbrush, underbrush_names

COARSE = Bins(8, 6, 6)
SHAPE = (5, 4, 3)
EDGES = (1.5, 1.5, 0.4)
INTERVAL = 4
STRUCTS = {
    "LeanBlock": layouts.LEAN_BLOCK,
    "LeanKind": layouts.LEAN_KIND,
    "AirGrid": layouts.AIR_GRID,
    "LeanPass": layouts.LEAN_PASS,
}


def species_blades(name: str) -> list[Blades]:
    """Five tufts of a species, kind by kind."""
    tufts = [grow_tuft(load_underbrush(name), 1)]
    kinds = [build_kind(blade, COARSE) for blade in tufts[0].kinds]
    rng = np.random.default_rng(2)
    position = np.zeros((5, 3), np.float32)
    position[:, :2] = rng.uniform(0.0, 5.0, (5, 2))
    up = np.tile(np.float32([0.1, -0.2, np.sqrt(0.95)]), (5, 1))
    yaw, size = rng.uniform(0.0, 6.0, 5).astype(np.float32), rng.uniform(0.8, 1.2, 5).astype(np.float32)
    return plant_tufts(tufts, kinds, TuftPlaces(np.zeros(5, np.int32), position, yaw, up, size))


@pytest.fixture(scope="session")
def planted() -> dict[str, list[Blades]]:
    return {name: species_blades(name) for name in underbrush_names()}


@pytest.fixture(scope="session")
def fescue(planted: dict[str, list[Blades]]) -> Blades:
    return planted["meadow_fescue"][0]


def gusts(time: float, push: float = 1.0) -> PackedField:
    """A gusty field in which something presses the blades down from time to time."""
    rng = np.random.default_rng(5)
    phase, pace = rng.uniform(0.0, 6.3, (2, *SHAPE, 3))
    velocity = np.float32([4.0, 1.0, 0.0]) + 4.0 * np.sin(pace * time + phase)
    pressure = push * np.maximum(np.sin(2.0 * pace * time), 0.0) * np.float32([0.5, 0.5, -1.0])
    return pack_field(velocity.astype(np.float32), pressure.astype(np.float32), (-0.3, 0.2), EDGES)


def steady(*velocity: float) -> PackedField:
    return pack_field(np.tile(np.float32(velocity), (*SHAPE, 1)), None, (0.0, 0.0), EDGES)


def advance(card: Leaning, sets: list[Blades], states: list[BladeState], field: PackedField, n: int) -> None:
    card.write_air(field)
    card.step(n)
    for blades, state in zip(sets, states, strict=True):
        step_in_field(blades, state, field, n)


def pose_gap(sets: list[Blades], ours: list[BladeState], theirs: list[BladeState]) -> float:
    """Largest distance of two poses' joints over the length of the blade."""
    worst = 0.0
    for blades, mine, other in zip(sets, ours, theirs, strict=True):
        length = blades.size * blades.kind.table.length.sum()
        a, b = pose_blades(blades, mine).joint, pose_blades(blades, other).joint
        worst = max(worst, float((np.linalg.norm(a - b, axis=2) / length[:, None]).max()))
    return worst


def test_ten_gusty_seconds_of_every_kind_of_every_species(device, planted):
    sets = [blades for species in planted.values() for blades in species]
    assert len(planted) == 9
    states, card = [rest_blades(blades) for blades in sets], Leaning(device, sets)
    worst, posed, far = 0.0, 0.0, np.zeros(len(sets))
    for interval in range(300):
        advance(card, sets, states, gusts(interval / 30.0), INTERVAL)
        if interval % 30 == 29:
            ours = card.states
            for mine, other in zip(ours, states, strict=True):
                worst = max(worst, float(np.abs(mine.lean - other.lean).max()))
                np.testing.assert_array_equal(mine.broken, other.broken)
            posed = max(posed, pose_gap(sets, ours, states))
            far = np.maximum(far, [np.abs(state.lean).max() for state in states])
    moving = np.array([not blades.kind.still for blades in sets])
    assert far[moving].min() > 0.01
    assert far.max() > 0.3
    # Asked are 1e-3 of the blade's length.
    assert worst < 5e-6
    assert posed < 2e-4


def test_steady_wind_rests_at_equilibrium(device, fescue):
    wind = np.array([2.5, 1.0, 0.0])
    card = Leaning(device, [fescue])
    card.write_air(steady(*wind))
    card.step(120 * 20)
    settled = card.states[0]
    assert not settled.broken.any()
    frame = rest_frame(fescue).astype(np.float64)
    size = fescue.size[:, None].astype(np.float64)
    force = drag_of_air(fescue.kind, np.einsum("bij,j->bi", frame, wind)) * size**-1.5
    weight = -fescue.kind.weight * frame[:, :, 2]
    expected = lean_of_load(weight + force) - lean_of_load(weight)
    np.testing.assert_allclose(settled.lean, expected, atol=5e-6)
    card.step(120)
    assert np.abs(card.states[0].lean - settled.lean).max() <= 4.0 * np.finfo(np.float32).eps


def test_without_a_force_every_blade_returns_to_rest_to_the_last_bit(device, planted):
    sets = planted["oxeye_daisy"]
    card = Leaning(device, sets)
    card.write_air(gusts(1.0))
    card.step(60)
    assert all(np.abs(state.lean).max() > 1e-3 for state in card.states[:2])
    card.write_air(steady(0.0, 0.0, 0.0))
    card.step(120 * 60)
    assert not any(state.lean.any() or state.rate.any() for state in card.states)


def test_leans_do_not_depend_on_how_steps_are_dealt_out_nor_on_the_run(device, fescue):
    ends = []
    for shares in ((4, 4), (1, 3, 2, 2), (1, 3, 2, 2)):
        card = Leaning(device, [fescue])
        card.write_air(gusts(0.3))
        for count in shares:
            card.step(count)
        ends.append(card.states[0].lanes)
    np.testing.assert_array_equal(ends[0], ends[1])
    np.testing.assert_array_equal(ends[1], ends[2])


def test_each_set_feels_its_own_air_and_goes_on_from_a_state(device, planted):
    sets = planted["white_clover"][:2]
    fields = steady(6.0, 0.0, 0.0), gusts(0.2)
    states = [step_in_field(b, rest_blades(b), gusts(0.9), 11) for b in sets]
    card = Leaning(device, sets, airs=[1, 0])
    card.write(states)
    card.write_air(*fields)
    card.step(30)
    for blades, state, field, mine in zip(sets, states, fields[::-1], card.states, strict=True):
        step_in_field(blades, state, field, 30)
        np.testing.assert_allclose(mine.lean, state.lean, atol=2e-6)


def test_blades_that_the_card_cannot_bind_at_once_move_all_the_same(device, planted):
    sets = planted["white_clover"]
    tile = 4 * CONSTANT_COUNT * WIDTH
    count = sum(len(blades.constants) for blades in sets)
    whole = Leaning(device, sets)
    shared = Leaning(device, sets, limit=tile * (count // 3 + lean_rows.BLOCK // WIDTH))
    assert len(whole._shares) == 1
    assert len(shared._shares) >= 3
    assert max(share._own["constants"].size for share in shared._shares) <= tile * (count // 3 + 8)
    for card in (whole, shared):
        card.write_air(gusts(0.4))
        card.step(40)
    for one, other in zip(whole.states, shared.states, strict=True):
        assert one.lanes.any()
        np.testing.assert_array_equal(one.lanes, other.lanes)


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e6])
def test_forces_that_cannot_be_meant_are_mended_and_counted(device, fescue, bad):
    field = steady(bad, 0.0, 0.0)
    card, states = Leaning(device, [fescue]), [rest_blades(fescue)]
    advance(card, [fescue], states, field, INTERVAL)
    assert card.clamped_count == states[0].clamped_count > 0
    mine = card.states[0]
    assert np.isfinite(mine.lean).all()
    np.testing.assert_allclose(mine.lean, states[0].lean, atol=1e-5)


def test_breaking_and_what_is_left_agree(device, fescue):
    # No joint of a fescue's leaf breaks in the wind: a weaker one does.
    kind = replace(fescue.kind, breaking_lean=0.8, broken_scale=0.3)
    rng = np.random.default_rng(0)
    base = np.column_stack([rng.uniform(0.0, 5.0, (70, 2)), np.zeros(70)])
    blades = place_blades(kind, base, np.repeat(fescue.frame[:1], 70, axis=0), rng.uniform(0.7, 1.3, 70))
    card, states = Leaning(device, [blades]), [rest_blades(blades)]
    for interval in range(20):
        advance(card, [blades], states, gusts(interval / 3.0), INTERVAL)
    assert 0 < states[0].broken.sum() < 70
    np.testing.assert_array_equal(card.states[0].broken, states[0].broken)
    np.testing.assert_allclose(card.states[0].lean, states[0].lean, atol=1e-5)


def test_a_meadow_that_no_wind_moves_steps_nothing(device):
    card = Leaning(device, [])
    card.write_air(gusts(0.5))
    card.step(4)
    assert card.states == []
    assert card.clamped_count == 0


def test_more_fields_than_the_card_knows_are_refused(device, fescue):
    with pytest.raises(ValueError, match="at most 2"):
        Leaning(device, [fescue]).write_air(*[steady(1.0, 0.0, 0.0)] * 3)


def test_structs_and_numbers_agree_with_the_shader():
    text = shader_text("lean")
    kinds = {"vec4f": REALS, "vec4u": COUNTS}
    for name, dtype in STRUCTS.items():
        body = re.search(rf"struct {name} \{{(.*?)\n\}}", text, re.DOTALL)
        assert body is not None
        fields = re.findall(r"^\s*(\w+): (\w+),", body[1], re.MULTILINE)
        assert np.dtype([(field, *kinds[kind]) for field, kind in fields]) == dtype
    for line in (
        f"WIDTH = {WIDTH}u;",
        f"BLOCK = {lean_rows.BLOCK}u;",
        f"CONSTANT_ROWS = {CONSTANT_COUNT}u;",
        f"STATE_ROWS = {STATE_COUNT}u;",
        f"array<AirGrid, {layouts.AIR_LIMIT}>",
    ):
        assert line in text
    assert float(re.search(r"LARGEST_FORCE = (\S+);", text)[1]) == LARGEST_FORCE
    assert float(re.search(r"REST_THRESHOLD = (\S+);", text)[1]) == REST_THRESHOLD


def test_leaning_is_timed_after_a_picture_too(device, fescue):
    # Mesa's software driver said a thousandth of the truth.
    card = Leaning(device, [fescue])
    card.write_air(gusts(1.0))
    clear_a_picture(device)
    by_clock, on_the_wall = [], []
    for _ in range(5):
        start = perf_counter()
        card.step(2000)
        card.wait()
        on_the_wall.append(1e3 * (perf_counter() - start))
        by_clock.append(card.times.read().get("lean"))
    if card.times.works:
        assert 0.2 * min(on_the_wall) < np.median(by_clock) <= max(on_the_wall)


def clear_a_picture(device):
    """The least picture."""
    usage = wgpu.TextureUsage.RENDER_ATTACHMENT
    texture = device.create_texture(size=(64, 64, 1), format="rgba8unorm", usage=usage)
    encoder = device.create_command_encoder()
    attachment = {"view": texture.create_view(), "load_op": "clear", "store_op": "store"}
    encoder.begin_render_pass(color_attachments=[attachment]).end()
    device.queue.submit([encoder.finish()])
