"""`bend` on the card: parity with the CPU over gusty wind, and the deformer drawn straight from its buffers."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from importlib.resources import files

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from golden_picture import check_golden, skip_other_drivers
from handmade import build_plant, random_tree, straight
from windswept.errors import GraphicsError, InputError
from windswept.geometry.bark import bark_surface
from windswept.geometry.curves import build_geometry
from windswept.geometry.detail import DetailRules
from windswept.geometry.geometry import PosedCurves
from windswept.gpu import device as device_module
from windswept.gpu import failures
from windswept.gpu import renderer as renderer_module
from windswept.gpu.bend import Bending, BranchDrawing, branch_look_rows, layouts
from windswept.gpu.bend.branch_rows import branch_rows
from windswept.gpu.buffers import filled
from windswept.gpu.frame import Camera, Frame, Ground, PosedPlants
from windswept.gpu.layouts import COUNTS, GUST, REALS, WAVE
from windswept.gpu.plant_buffers import plant_arrays
from windswept.gpu.renderer import Renderer
from windswept.gpu.wiring import COMPUTE, READ, WRITE, bind, buffers_layout, shader_text
from windswept.motion.bend import Bender
from windswept.motion.bend_branches import place_branches
from windswept.motion.bend_plain import WEIGHTS, attachment_gap, handles
from windswept.motion.bend_plant import plant_branches
from windswept.plants.plant import Look
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind, Profile
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.waves import Waves, WaveSchedule, WaveSet
from windswept.wind.wind import Wind, calm

PROBE = """
@group(1) @binding(6) var<storage, read> questions: array<vec4f>;
@group(1) @binding(7) var<storage, read_write> answers: array<vec4f>;

@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&questions) { return; }
    let question = questions[id.x];
    let piece = posed_piece(u32(question.x));
    let found = surface(piece, stems[piece.rows.x], question.y, question.z);
    answers[2u * id.x] = vec4f(found.position, 0.0);
    answers[2u * id.x + 1u] = vec4f(found.normal, 0.0);
}
"""


def gusty(speed=8.0):
    other = Waves([0.1, 2.0], [0.2, 1.0], [20.0, 31.0], [5.0, 7.0], [2.0, 1.5], [1.7, 2.0], [0.3, 4.0])
    waves = WaveSchedule((WaveSet(plausible_waves(speed, 0.4, 3, 0.4), end=6.0), WaveSet(other, start=4.0)))
    gusts = (Gust(2.0, 5.0, 0.3, width=60.0), Gust(4.0, 3.0, 2.0))
    return Wind(profile=Profile(0.05), mean=MeanWind(speed, 0.4), waves=waves, gusts=gusts)


@pytest.fixture(scope="module")
def grove():
    """Two kinds of handmade trees that bend far, three placements."""
    plants = [random_tree(4), random_tree(7)]
    kinds = [plant_branches(plant) for plant in plants]
    kinds = [replace(kind, flexibility=40.0 * kind.flexibility) for kind in kinds]
    kind = np.array([0, 1, 0], np.int32)
    position = np.array([(0, 0, 0), (30, 5, 1), (-20, 9, 0)], np.float32)
    return plants, kind, place_branches(kinds, kind, position, np.array([0.0, 1.0, 4.0]))


def test_structs_agree_with_the_shader():
    shaders = files("windswept.gpu") / "shaders"
    source = "".join((shaders / f"{name}.wgsl").read_text() for name in ("bend_types", "bend_air"))
    numpy_types = {
        "Branch": layouts.BRANCH,
        "BranchLook": layouts.BRANCH_LOOK,
        "BentBranch": layouts.BENT_BRANCH,
        "Breeze": layouts.BREEZE,
        "BendPass": layouts.BEND_PASS,
    }

    def as_numpy(kind):
        array = re.fullmatch(r"array<(\w+), (\d+)>", kind)
        if array:
            return {"Wave": WAVE, "Gust": GUST}[array[1]], (int(array[2]),)
        return {"vec4f": REALS, "vec4u": COUNTS}[kind]

    structs = dict(re.findall(r"struct (\w+) \{(.*?)\n\}", source, re.DOTALL))
    assert set(structs) == set(numpy_types)
    for name, body in structs.items():
        fields = re.findall(r"^\s*(\w+): (.+?),(?:\s*//.*)?$", body, re.MULTILINE)
        assert np.dtype([(field, *as_numpy(kind)) for field, kind in fields]) == numpy_types[name]


@pytest.mark.parametrize("weights", list(WEIGHTS))
@pytest.mark.parametrize("mode", ["step_lagged", "step_ordered"])
def test_the_card_bends_as_the_cpu_does(device, grove, mode, weights):
    _, _, branches = grove
    card, bender, wind = Bending(device, branches, weights=weights), Bender(branches, weights), gusty()
    state = bender.rest()
    still, worst, moved = bender.pose(state).points, 0.0, 0.0
    for time in np.arange(0.0, 10.0, 0.2):
        getattr(card, mode)(wind, time)
        getattr(bender, mode)(state, wind, time)
        ours, theirs = card.pose(), bender.pose(state)
        worst = max(worst, float(np.abs(ours.points - theirs.points).max()))
        moved = max(moved, float(np.abs(theirs.points - still).max()))
        assert_allclose(ours.side, theirs.side, atol=2e-5)
    height = float(branches.tip[:, 2].max())
    assert moved > 0.05 * height
    assert worst < 1e-5 * height


def test_gaps_on_the_card(device, grove):
    _, _, branches = grove
    card, wind = Bending(device, branches), gusty()
    before, lagged = card.pose(), 0.0
    for time in 3.0 + np.arange(30) / 60.0:
        card.step_lagged(wind, time)
        now = card.pose()
        moved = np.linalg.norm(now.points - before.points, axis=2).max(axis=1)
        gap = attachment_gap(branches, now)
        assert np.all(gap <= np.where(branches.parent >= 0, moved[branches.parent], 0.0) + 1e-5)
        lagged, before = max(lagged, float(gap.max())), now
    assert lagged > 1e-4
    card.step_ordered(wind, 4.0)
    assert attachment_gap(branches, card.pose()).max() < 1e-5


def test_still_air_keeps_the_rest_pose_bit_by_bit(device, grove):
    card = Bending(device, grove[2])
    rest = card.pose().points
    card.step_ordered(gusty(), 3.0)
    assert np.abs(card.pose().points - rest).max() > 0.1
    for _ in range(grove[2].level_count):
        card.step_lagged(calm(), 0.0)
    assert_array_equal(card.pose().points, rest)


def test_steps_taken_at_once_are_those_taken_one_by_one(device, grove):
    _, _, branches = grove
    for mode in ("step_lagged", "step_ordered"):
        for steps in (2, 3):
            at_once, singly = Bending(device, branches), Bending(device, branches)
            getattr(at_once, mode)(gusty(), 3.0, steps)
            for _ in range(steps):
                getattr(singly, mode)(gusty(), 3.0)
            assert_array_equal(at_once.pose().points, singly.pose().points)
            getattr(at_once, mode)(gusty(), 4.0)
            getattr(singly, mode)(gusty(), 4.0)
            assert_array_equal(at_once.pose().points, singly.pose().points)


def test_the_card_keeps_no_branches_as_well(device):
    none = place_branches([], np.zeros(0, np.int32), np.zeros((0, 3), np.float32), np.zeros(0, np.float32))
    card = Bending(device, none)
    for step in (card.step_lagged, card.step_ordered):
        step(gusty(), 1.0)
        card.wait()
        assert card.pose().points.shape == (0, 4, 3)
        assert card.pose().side.shape == (0, 3)


def test_a_refused_wind_leaves_the_branches_where_they_were(device, grove):
    card, crowd = Bending(device, grove[2]), plausible_waves(6.0, 0.3, 1, along_count=layouts.WAVE_LIMIT + 1)
    card.step_lagged(gusty(), 3.0)
    before = card.pose().points
    with pytest.raises(InputError, match="waves"):
        card.step_lagged(Wind(waves=WaveSchedule((WaveSet(crowd),))), 3.0)
    assert_array_equal(card.pose().points, before)


@pytest.mark.parametrize(
    "call", ["step_lagged", "step_ordered", "wait", "pose", "draw", "new", "new_drawing"]
)
def test_every_call_says_that_the_card_was_lost(grove, monkeypatch, call):
    plants, kind, branches = grove
    own = cache(device_module.shared_device.__wrapped__)
    for module in (renderer_module, failures):
        monkeypatch.setattr(module, "shared_device", own)
    geometries = [build_geometry(plant) for plant in plants]
    renderer = Renderer(plants, geometries, size=(32, 32))
    looks, rows = branch_look_rows(branches, geometries, renderer.kinds, kind)
    card = Bending(own(), branches, rows)
    renderer.beside.append(BranchDrawing(renderer, card, looks))
    nobody = tuple(
        PosedPlants(
            np.zeros((0, plant.link_count, 8), np.float32), np.zeros((0, 3), np.float32), *np.zeros((2, 0))
        )
        for plant in plants
    )
    frame = Frame(nobody, Camera((0.6, -4.6, 1.7), (0.6, 0.0, 1.45)))
    calls = {
        "step_lagged": lambda: card.step_lagged(gusty(), 1.0),
        "step_ordered": lambda: card.step_ordered(gusty(), 1.0),
        "wait": card.wait,
        "pose": card.pose,
        "draw": lambda: renderer.draw(frame),
        "new": lambda: Bending(card._device, branches),
        "new_drawing": lambda: BranchDrawing(renderer, card, looks),
    }
    calls[call]()
    lost = own()
    lost.destroy()
    with pytest.raises(GraphicsError, match="the graphics card was lost while"):
        calls[call]()
    assert own() is not lost


def test_more_waves_than_the_card_is_given_are_refused(device, grove):
    crowd = plausible_waves(6.0, 0.3, 1, along_count=layouts.WAVE_LIMIT + 1)
    with pytest.raises(InputError, match="waves"):
        Bending(device, grove[2]).step_ordered(Wind(waves=WaveSchedule((WaveSet(crowd),))), 0.0)
    fading = WaveSchedule((WaveSet(crowd, end=-1.0), WaveSet(plausible_waves(6.0, 0.3, 1))))
    Bending(device, grove[2]).step_ordered(Wind(waves=fading), 0.0)


def test_the_deformer_draws_the_bent_branches(device, grove):
    plants, kind, branches = grove
    plain = [build_geometry(plant) for plant in plants]
    shaped = [
        replace(
            geometry,
            stem_flare=np.full(geometry.stem_count, 0.8, np.float32),
            stem_lobes=np.full(geometry.stem_count, 5.0, np.float32),
            stem_lobe_depth=np.full(geometry.stem_count, 0.1, np.float32),
            bulges=6,
            bulge_depth=0.08,
        )
        for geometry in plain
    ]
    arrays = plant_arrays(plants, shaped, [p.look for p in plants], DetailRules())
    looks, rows = branch_look_rows(branches, shaped, arrays.kinds, kind)
    card = Bending(device, branches, rows)
    card.step_ordered(gusty(), 3.0)
    pose = card.pose()
    sides = handles(pose.points.astype(np.float64), pose.side)

    rng = np.random.default_rng(1)
    for number, geometry in enumerate(shaped):
        own = np.flatnonzero(kind[branches.placement] == number)
        asked = rng.integers(0, len(own), 300)
        t, angle = rng.uniform(0.02, 0.97, 300), rng.uniform(0.0, 2.0 * np.pi, 300)
        questions = np.stack([own[asked], t, angle, 0.0 * t], axis=1).astype(np.float32)
        position, normal = ask(device, arrays.stems, card, looks, questions)
        # One piece a branch: the same stems on the bent curves.
        bare = replace(
            geometry,
            piece_stem=branches.stem[own],
            piece_span=np.tile(np.array([0.0, 1.0], np.float32), (len(own), 1)),
        )
        world = (pose.points + branches.origin[:, None])[own][None]
        expected = bark_surface(
            bare, PosedCurves(world, sides[own][None], world[:, :, 0]), 0, asked, t, angle
        )
        assert_allclose(position, expected.position, atol=1e-5 * branches.tip[:, 2].max())
        assert np.quantile(np.sum(normal * expected.normal, axis=1), 0.02) > 0.999


def ask(device, stems, card, looks, questions):
    """Points and normals of the shader's surface."""
    answers = filled(device, np.zeros((2 * len(questions), 4), np.float32))
    resources = {0: filled(device, stems), 1: card.bent, 4: card.rest, 5: filled(device, looks)}
    resources |= {6: filled(device, questions), 7: answers}
    layout = device.create_bind_group_layout(
        entries=[
            {"binding": k, "visibility": COMPUTE, "buffer": WRITE if k == 7 else READ} for k in resources
        ]
    )
    group = device.create_bind_group(
        layout=layout,
        entries=[
            {"binding": k, "resource": {"buffer": buffer, "offset": 0, "size": buffer.size}}
            for k, buffer in resources.items()
        ],
    )
    empty = buffers_layout(device, COMPUTE)
    pipeline = device.create_compute_pipeline(
        layout=device.create_pipeline_layout(bind_group_layouts=[empty, layout]),
        compute={
            "module": device.create_shader_module(code=shader_text("bend_bark") + PROBE),
            "entry_point": "probe",
        },
    )
    encoder = device.create_command_encoder()
    stage = encoder.begin_compute_pass()
    stage.set_pipeline(pipeline)
    stage.set_bind_group(0, bind(device, empty))
    stage.set_bind_group(1, group)
    stage.dispatch_workgroups(-(-len(questions) // 64))
    stage.end()
    device.queue.submit([encoder.finish()])
    found = np.frombuffer(device.queue.read_buffer(answers), np.float32).reshape(-1, 2, 4)
    return found[:, 0, :3], found[:, 1, :3]


def test_rows_hold_unit_legs(grove):
    rows = branch_rows(grove[2])
    for name in ("leg1", "leg2", "side"):
        assert_allclose(np.linalg.norm(rows[name][:, :3], axis=1), 1.0, atol=1e-6)


def bent_branch_picture(device):
    """(120, 160, 4) one stem with flare, lobes and bulges, bent by a steady wind."""
    plain = build_plant(straight(3.0, 6, 0.28, 0.02))
    plant = replace(
        plain,
        stem_flare=np.array([0.6], np.float32),
        stem_lobes=np.array([7.0], np.float32),
        stem_lobe_depth=np.array([0.12], np.float32),
        look=Look(bark_bulges=5, bark_bulge_depth=0.08),
    )
    geometry, kind = build_geometry(plant), np.zeros(1, np.int32)
    limp = plant_branches(plant)
    limp = replace(limp, flexibility=np.full(1, 0.012, np.float32))
    branches = place_branches([limp], kind, np.zeros((1, 3), np.float32), np.zeros(1))
    ground = Ground(np.zeros((2, 2), np.float32), (-20.0, -20.0), 40.0)
    renderer = Renderer([plant], [geometry], ground, (160, 120))
    looks, rows = branch_look_rows(branches, [geometry], renderer.kinds, kind)
    bending = Bending(device, branches, rows)
    bending.step_ordered(Wind(mean=MeanWind(9.0, 0.3)), 0.0)
    renderer.beside.append(BranchDrawing(renderer, bending, looks))
    nobody = PosedPlants(
        np.zeros((0, plant.link_count, 8), np.float32), np.zeros((0, 3), np.float32), *np.zeros((2, 0))
    )
    return renderer.draw(Frame((nobody,), Camera((0.6, -4.6, 1.7), (0.6, 0.0, 1.45))))


def test_a_bent_branch_looks_as_it_did(device, tmp_path):
    skip_other_drivers()
    check_golden(bent_branch_picture(device), "bent_branch", tmp_path)
