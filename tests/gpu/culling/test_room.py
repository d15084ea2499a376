"""Where there is no room for all, they are drawn in less detail, and beyond that the nearest are; room grows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from windswept.gpu import fitting, layouts, posing
from windswept.gpu.culling.standing_rows import shortening
from windswept.gpu.culling.tally import LATE
from windswept.gpu.frame import Camera
from woods import Wood, wood_renderer

CAMERA = Camera((0.0, 0.0, 1.7), (10.0, 3.0, 2.0))


def another(wood: Wood) -> Wood:
    """The same wood with a renderer of its own."""
    return replace(wood, renderer=wood_renderer(wood.plants))


def told_of(wood: Wood, camera: Camera):
    return wood.renderer.draw_aside(wood.frame(camera))


@pytest.mark.parametrize("share", [0.7, 0.4, 0.05])
@pytest.mark.parametrize("column", range(4))
def test_the_nearest_find_seats_and_the_others_are_counted(wood, device, monkeypatch, share, column):
    wanted = wood.listed(CAMERA)
    row_bytes = [store.row_bytes for store in wood.renderer.posing._stores]
    monkeypatch.setattr(posing, "MOST_BYTES", int(share * wanted.counts[column]) * row_bytes[column])
    monkeypatch.setattr(fitting, "LEAST_DETAIL", 1.0)
    poor = another(wood)
    poor.renderer.draw(poor.frame(CAMERA))
    told = poor.renderer._tally.now(0)
    room = poor.renderer.posing.room
    assert told.wanted == wanted.counts
    assert told.placements + told.refused == len(wanted.placements)
    rows = device.queue.read_buffer(poor.renderer._plan.placements)
    drawn = set(np.frombuffer(rows, layouts.PLACEMENT)["number"][: told.placements, 0].tolist())

    numbers = wanted.placements["number"][:, 0]
    centres = np.concatenate(
        [
            p.position + kind.centre * [0, 0, 1]
            for p, kind in zip(wood.placed, poor.renderer.kinds, strict=True)
        ]
    )
    away = np.linalg.norm(centres[numbers] - np.array(CAMERA.eye), axis=1)
    is_drawn = np.array([number in drawn for number in numbers.tolist()])
    # Bands are a fourteenth of their distance wide, and centres stand a little beside their roots.
    assert away[is_drawn].max(initial=0.0) < 1.2 * away[~is_drawn].min() + 1.0
    limit = wanted.placements["piece_limit"][:, 3].astype(int)
    leaves = wanted.placements["leaves"][:, 0].astype(int)
    needs = np.column_stack([wanted.links, wanted.placements["rows"][:, 3], limit, leaves])
    assert (needs[is_drawn].sum(axis=0) <= room).all()
    assert told.refused > 0


def room_for(wood: Wood, share: float, monkeypatch):
    """Leaves every buffer room for a share of the one that needs most."""
    counts, stores = wood.listed(CAMERA).counts, wood.renderer.posing._stores
    needed = [count * store.row_bytes for count, store in zip(counts, stores, strict=True)]
    monkeypatch.setattr(posing, "MOST_BYTES", int(share * max(needed)))


@pytest.mark.parametrize("share", [0.95, 0.85])
def test_the_card_takes_the_detail_that_a_list_takes(wood, monkeypatch, share):
    room_for(wood, share, monkeypatch)
    poor, listing = another(wood).renderer, another(wood).renderer
    poor.draw(wood.frame(CAMERA))
    listing.draw(wood.uploaded(CAMERA))
    assert poor.told_now == listing._told
    assert poor.told_now.refused == 0
    assert poor.told_now.leaves < wood.listed(CAMERA).leaf_count


def test_a_window_finds_its_detail_and_goes_back(wood, monkeypatch):
    room_for(wood, 0.85, monkeypatch)
    poor = another(wood)
    away = Camera((200.0, 0.0, 3.0), (400.0, 0.0, 3.0))
    told_of(poor, away)
    told = [told_of(poor, CAMERA) for _ in range(30 * LATE)]
    assert any(one.refused for one in told)
    assert told[-1].refused == 0
    detail = poor.renderer._detail
    assert fitting.LEAST_DETAIL < detail < 1.0
    for _ in range(60 * LATE):
        told_of(poor, away)
    assert poor.renderer._detail == 1.0


def test_listed_plants_are_drawn_in_less_detail_where_there_is_no_room(wood, monkeypatch):
    wanted = wood.listed(CAMERA)
    away = Camera((200.0, 0.0, 3.0), (0.0, 0.0, 3.0))
    far = another(wood).renderer.draw(wood.uploaded(away))
    room_for(wood, 0.9, monkeypatch)
    poor = another(wood).renderer
    poor.draw(wood.uploaded(CAMERA))
    told = poor._told
    assert told.placements == len(wanted.placements)
    assert told.wanted == poor.posing.affordable(told.wanted)
    assert 0 < told.leaves < wanted.leaf_count
    # Nothing of it is remembered.
    np.testing.assert_array_equal(poor.draw(wood.uploaded(away)), far)


def test_with_room_for_nobody_only_ground_and_sky_are_drawn(wood, monkeypatch):
    monkeypatch.setattr(posing, "MOST_BYTES", 64)
    poor = another(wood)
    nobody = tuple(
        replace(p, position=p.position[:0], yaw=p.yaw[:0], flutter=p.flutter[:0]) for p in wood.placed
    )
    picture = poor.renderer.draw(poor.frame(CAMERA))
    empty = poor.renderer.draw(replace(poor.frame(CAMERA), plants=nobody))
    told = poor.renderer._tally.now(0)
    assert told.placements == 0
    np.testing.assert_array_equal(picture, empty)


def test_room_grows_some_frames_after_a_window_lacked_it(wood, monkeypatch):
    grown = another(wood)
    away = Camera((200.0, 0.0, 3.0), (400.0, 0.0, 3.0))
    told_of(grown, away)
    before = grown.renderer.posing.room
    told = [told_of(grown, CAMERA) for _ in range(4 * LATE)]
    wanted = wood.listed(CAMERA)
    assert before[3] < wanted.leaf_count <= grown.renderer.posing.room[3]
    assert any(one.refused for one in told)
    assert told[-1].refused == 0
    assert told[-1].placements == len(wanted.placements)
    assert (told[-1].pieces, told[-1].leaves) == (wanted.piece_count, wanted.leaf_count)


def test_a_picture_never_lacks_room_that_there_is(wood):
    fresh = another(wood)
    fresh.renderer.draw(fresh.frame(Camera((200.0, 0.0, 3.0), (400.0, 0.0, 3.0))))
    fresh.renderer.draw(fresh.frame(CAMERA))
    assert fresh.renderer._tally.now(0).refused == 0
    assert fresh.renderer._tally.now(0).placements == len(wood.listed(CAMERA).placements)


def test_needs_beyond_32_bits_are_shortened(wood):
    kinds = wood.renderer.kinds
    assert shortening(wood.placed, kinds) == 0
    most = max(max(len(k.pose.link_order), len(k.order.leaf_order), len(k.order.piece_order)) for k in kinds)
    crowd = np.broadcast_to(np.zeros(3, np.float32), (1 << 31, 3))
    many = tuple(replace(p, position=crowd) for p in wood.placed)
    bits = shortening(many, kinds)
    assert (2 * (1 << 31) * (most + 1)) >> bits < 1 << 33
    assert bits > 0


def test_placements_that_stay_are_sent_once(wood):
    culling = another(wood).renderer.culling
    assert culling.place(wood.placed)
    assert not culling.place(wood.placed)
    assert not culling.place(tuple(replace(p, flutter=p.flutter + 1.0) for p in wood.placed))
    assert culling.place(tuple(replace(p, yaw=p.yaw.copy()) for p in wood.placed))
