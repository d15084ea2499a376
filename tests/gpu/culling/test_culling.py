"""Parity of what is drawn: the card's rows, ranges and arguments against ``draw_list``'s."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.gpu import layouts
from windswept.gpu.buffers import UNIFORM_STRIDE
from windswept.gpu.draw_plan import DRAWS, LEAVES, PIECES, POSES, STEMS, WORDS, batch_rows
from windswept.gpu.frame import FLUTTER_SPEED, LARGEST_FLUTTER, Camera

CAMERAS = {
    "among them": Camera((0.0, 0.0, 1.7), (10.0, 3.0, 2.0)),
    "above": Camera((-20.0, -80.0, 60.0), (0.0, 0.0, 0.0)),
    "narrow": Camera((-60.0, 0.0, 3.0), (60.0, 5.0, 2.0), 0.1),
    "away": Camera((200.0, 0.0, 3.0), (400.0, 0.0, 3.0)),
}
EXACT = ("position", "piece_limit")
CLOSE = ("heading", "leaves")


def read(device, buffer, layout, count):
    return np.frombuffer(device.queue.read_buffer(buffer), np.uint8)[
        : count * np.dtype(layout).itemsize
    ].view(layout)


@pytest.fixture(params=CAMERAS)
def chosen(request, wood, device):
    """What the card chose and what the CPU would have."""
    camera = CAMERAS[request.param]
    wood.renderer.draw(wood.frame(camera))
    plan = wood.renderer._plan
    words = read(device, plan.words, "<u4", WORDS)
    uniforms = read(device, plan.batches, f"V{UNIFORM_STRIDE}", len(plan.meshes) + 1)
    listed = np.frombuffer(uniforms[-1].tobytes()[:16], np.uint32)
    rows = read(device, plan.placements, layouts.PLACEMENT, int(listed[0]))
    return wood.listed(camera), rows, words, uniforms, listed


def by_number(rows):
    return rows[np.argsort(rows["number"][:, 0])]


def test_rows_are_those_of_the_draw_list(chosen):
    wanted, rows, *_ = chosen
    theirs, ours = by_number(wanted.placements), by_number(rows)
    np.testing.assert_array_equal(ours["number"][:, 0], theirs["number"][:, 0])
    for name in EXACT:
        np.testing.assert_array_equal(ours[name], theirs[name])
    np.testing.assert_array_equal(ours["rows"][:, 2:], theirs["rows"][:, 2:])
    np.testing.assert_array_equal(ours["first"][:, [0, 1, 3]], theirs["first"][:, [0, 1, 3]])
    for name in CLOSE:
        columns = [0, 2, 3] if name == "heading" else [0, 1, 2, 3]
        np.testing.assert_allclose(ours[name][:, columns], theirs[name][:, columns], rtol=2e-5, atol=1e-6)


def test_leaves_tremble_by_the_wind_in_each_crown(chosen):
    _, rows, *_ = chosen
    speed = np.linspace(0.0, 12.0, 470)[rows["number"][:, 0]]
    expected = LARGEST_FLUTTER * (1.0 - np.exp(-speed / FLUTTER_SPEED))
    np.testing.assert_allclose(rows["heading"][:, 1], expected, atol=1e-6)


def test_dispatches_and_draws_are_those_of_the_draw_list(chosen, wood):
    wanted, rows, words, uniforms, listed = chosen
    assert listed.tolist() == [len(rows), *wanted.chunks]
    assert words[POSES : POSES + 3].tolist() == [-(-len(rows) // 64), 1, 1]
    for word, chunks in zip((STEMS, PIECES, LEAVES), wanted.chunks, strict=True):
        assert words[word : word + 3].tolist() == [chunks, int(chunks > 0), 1]
    batches = batch_rows(wanted, wood.renderer._plan.meshes)
    ours = np.array([np.frombuffer(row.tobytes()[:32], layouts.BATCH)[0] for row in uniforms[:-1]])
    np.testing.assert_array_equal(ours["items"], batches["items"])
    np.testing.assert_array_equal(ours["scale"], batches["scale"])
    draws = words[DRAWS : DRAWS + 5 * len(batches)].reshape(-1, 5)
    indices, batch = wood.renderer._plan.meshes[:, :2].T
    items = batches["items"][:, 1].astype(int)
    np.testing.assert_array_equal(draws[:, 0], indices * np.minimum(batch, items))
    np.testing.assert_array_equal(draws[:, 1], -(-items // batch))
    assert not draws[:, 2:].any()


def test_everybody_has_a_place_of_their_own(chosen, wood, device):
    wanted, rows, *_ = chosen
    links = dict(zip(wanted.placements["number"][:, 0].tolist(), wanted.links.tolist(), strict=True))
    seats = read(device, wood.renderer.culling.seating(None).seats, "<u4", 4 * (len(rows) + 1)).reshape(-1, 4)
    assert seats[0, 0] == len(rows)
    np.testing.assert_array_equal(seats[1:, 0], rows["number"][:, 0])
    np.testing.assert_array_equal(seats[1:, 1], rows["rows"][:, 0])
    assert [links[number] for number in seats[1:, 0].tolist()] == seats[1:, 2].tolist()
    fill_once(wanted.counts[0], rows["rows"][:, 0], seats[1:, 2])
    fill_once(wanted.counts[1], rows["rows"][:, 1], rows["rows"][:, 3])
    limit = rows["piece_limit"].astype(int)
    counts = np.diff(limit, axis=1, prepend=0)
    fill_once(wanted.piece_count, rows["piece_out"].ravel(), counts.ravel())
    fill_once(wanted.leaf_count, rows["first"][:, 2], rows["leaves"][:, 0].astype(int))
    for column, of_each in ((1, rows["rows"][:, 3]), (2, limit[:, 3]), (3, rows["leaves"][:, 0])):
        chunks = -(-of_each.astype(int) // 64)
        np.testing.assert_array_equal(rows["number"][:, column], np.cumsum(chunks) - chunks)


def fill_once(total, firsts, counts):
    """Whether runs cover every place from 0 to ``total`` once."""
    taken = np.zeros(total, int)
    for first, count in zip(firsts.astype(int), counts.astype(int), strict=True):
        assert first + count <= total
        taken[first : first + count] += 1
    assert (taken == 1).all()


def test_shadows_only_come_before_those_seen(chosen):
    wanted, rows, *_ = chosen
    assert by_place(wanted, rows) == by_place(wanted, wanted.placements)


def by_place(wanted, rows):
    """Numbers of those whose leaves are out of sight, throw shadows and are seen, and are only seen."""
    places = [set(), set(), set()]
    for row in rows[rows["leaves"][:, 0] > 0]:
        first = int(row["first"][2])
        mesh = next(m for m in wanted.leaves if m.first <= first < m.first + m.total)
        tier = int(first >= mesh.first + mesh.hidden) + int(first >= mesh.first + mesh.casters)
        places[tier].add(int(row["number"][0]))
    return places
