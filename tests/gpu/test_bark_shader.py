"""Parity: the bark surface in ``bark.wgsl`` against ``geometry/bark.py``, through a compute entry of the test's own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import random_tree
from shaken import shaken_pose
from windswept.geometry.bark import bark_surface
from windswept.geometry.curves import build_geometry
from windswept.geometry.detail import DetailRules
from windswept.geometry.pose_curves import pose_curves
from windswept.gpu import layouts
from windswept.gpu.buffers import filled
from windswept.gpu.plant_buffers import plant_arrays
from windswept.gpu.wiring import COMPUTE, READ, WRITE, bind, buffers_layout, shader_text

PROBE = """
@group(1) @binding(4) var<storage, read> questions: array<vec4f>;
@group(1) @binding(5) var<storage, read_write> answers: array<vec4f>;

@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&questions) { return; }
    let question = questions[id.x];
    let piece = posed_pieces[u32(question.x)];
    let found = surface(piece, stems[piece.rows.x], question.y, question.z);
    answers[2u * id.x] = vec4f(found.position, 0.0);
    answers[2u * id.x + 1u] = vec4f(found.normal, 0.0);
}
"""


def posed_rows(geometry, curves, stem_rank):
    """``PosedPiece`` rows as ``curves.wgsl`` would write them for a placement at the origin."""
    rows = np.zeros(geometry.piece_count, layouts.POSED_PIECE)
    for k in range(4):
        rows[f"p{k}"][:, :3] = curves.points[0, :, k]
    for k in range(3):
        rows[f"side{k}"][:, :3] = curves.sides[0, :, k]
    rows["p0"][:, 3], rows["p1"][:, 3] = geometry.piece_span.T
    rows["side0"][:, 3] = 1.0
    rows["rows"][:, 0] = stem_rank[geometry.piece_stem]
    return rows


def ask(device, stems, pieces, questions):
    entries = [(0, READ), (1, READ), (4, READ), (5, WRITE)]
    layout = device.create_bind_group_layout(
        entries=[{"binding": k, "visibility": COMPUTE, "buffer": kind} for k, kind in entries]
    )
    answers = filled(device, np.zeros((2 * len(questions), 4), np.float32))
    buffers = [filled(device, stems), filled(device, pieces), filled(device, questions), answers]
    group = device.create_bind_group(
        layout=layout,
        entries=[
            {"binding": k, "resource": {"buffer": buffer, "offset": 0, "size": buffer.size}}
            for (k, _), buffer in zip(entries, buffers, strict=True)
        ],
    )
    empty = buffers_layout(device, COMPUTE)
    pipeline = device.create_compute_pipeline(
        layout=device.create_pipeline_layout(bind_group_layouts=[empty, layout]),
        compute={
            "module": device.create_shader_module(code=shader_text("bark") + PROBE),
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
    rows = np.frombuffer(device.queue.read_buffer(answers), np.float32).reshape(-1, 2, 4)
    return rows[:, 0, :3], rows[:, 1, :3]


@pytest.mark.parametrize("taper", [0.0, 0.7, 1.0, 1.4, 2.0, 2.6, 3.0])
def test_the_card_draws_the_same_surface(device, taper):
    plant = random_tree(4)
    plain = build_geometry(plant)
    stems = plain.stem_count
    geometry = replace(
        plain,
        stem_taper=np.full(stems, taper, np.float32),
        stem_flare=np.full(stems, 0.8, np.float32),
        stem_lobes=np.full(stems, 5.0, np.float32),
        stem_lobe_depth=np.full(stems, 0.1, np.float32),
        bulges=6,
        bulge_depth=0.08,
    )
    curves = pose_curves(geometry, plant.link_base, shaken_pose(plant, 5, angle=0.15))
    rng = np.random.default_rng(1)
    piece = rng.integers(0, geometry.piece_count, 400)
    t, angle = rng.uniform(0.02, 0.97, 400), rng.uniform(0.0, 2.0 * np.pi, 400)
    arrays = plant_arrays([plant], [geometry], [plant.look], DetailRules())
    pieces = posed_rows(geometry, curves, arrays.kinds[0].pose.stem_rank)
    questions = np.stack([piece, t, angle, 0.0 * t], axis=1).astype(np.float32)
    position, normal = ask(device, arrays.stems, pieces, questions)

    expected = bark_surface(geometry, curves, 0, piece, t, angle)
    np.testing.assert_allclose(position, expected.position, atol=1e-5 * plant.height)
    cosine = np.sum(normal * expected.normal, axis=1)
    # Where a rounded end or a bead closes, the slope has no bound and the shader's is capped.
    assert np.quantile(cosine, 0.1 if taper > 1.0 else 0.0) > 0.999
