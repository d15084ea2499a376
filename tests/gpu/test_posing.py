"""Parity: what the card poses against the NumPy reference."""

from __future__ import annotations

import numpy as np
import pytest

from shaken import shaken_pose
from windswept.geometry.detail import detail_order
from windswept.geometry.pose_curves import pose_curves, rotate
from windswept.gpu import layouts
from windswept.gpu.draw_list import draw_list
from windswept.gpu.wiring import SHADER_SETS


def read_rows(device, buffer, layout, count):
    return np.frombuffer(device.queue.read_buffer(buffer, 0, count * layout.itemsize), layout)


def listed(stand, frame):
    view, _ = stand.renderer._look(frame)
    return draw_list(stand.renderer.kinds, frame.plants, view, stand.renderer._rules)


def drawn(stand, frame):
    told = stand.renderer.draw_aside(frame)
    wanted = listed(stand, frame)
    assert (told.pieces, told.leaves) == (wanted.piece_count, wanted.leaf_count)
    return wanted


def turned_about_z(points, yaw):
    cosine, sine = np.cos(yaw), np.sin(yaw)
    x, y, z = points[..., 0], points[..., 1], points[..., 2]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1)


@pytest.fixture(scope="module")
def posed(stand, device):
    """Frame with shaken plants, the draw list it leads to, and what the card made of it."""
    poses = [shaken_pose(plant, seed, angle=0.3) for seed, plant in enumerate(stand.plants)]
    frame = stand.frame(poses)
    wanted = drawn(stand, frame)
    pieces = read_rows(
        device, stand.renderer.posing.posed_pieces.buffer, layouts.POSED_PIECE, wanted.piece_count
    )
    leaves = read_rows(
        device, stand.renderer.posing.posed_leaves.buffer, layouts.POSED_LEAF, wanted.leaf_count
    )
    return frame, poses, wanted, pieces, leaves


def placements_of(wanted, frame, look):
    """(row of the draw list, number of the placement) for every drawn placement of a kind."""
    plants = frame.plants[look]
    for row in wanted.placements:
        if row["first"][3] == look:
            gap = np.abs(plants.position - row["position"][:3]).sum(axis=1)
            yield row, int(np.argmin(gap))


@pytest.mark.parametrize("look", [0, 1])
def test_pieces_agree_with_the_reference(stand, posed, look):
    frame, poses, wanted, pieces, _ = posed
    geometry, plant = stand.geometries[look], stand.plants[look]
    curves = pose_curves(geometry, plant.link_base, poses[look])
    order = detail_order(geometry).piece_order
    tolerance = 1e-5 * plant.height
    for row, number in placements_of(wanted, frame, look):
        place, yaw = frame.plants[look].position[number], frame.plants[look].yaw[number]
        first = 0
        for bucket in range(4):
            count = int(row["piece_limit"][bucket]) - first
            own = pieces[row["piece_out"][bucket] :][:count]
            rest = order[first : first + count]
            expected = place + turned_about_z(curves.points[number, rest], yaw)
            actual = np.stack([own[name][:, :3] for name in ("p0", "p1", "p2", "p3")], axis=1)
            np.testing.assert_allclose(actual, expected, atol=tolerance)
            sides = turned_about_z(curves.sides[number, rest], yaw)
            actual = np.stack([own[name][:, :3] for name in ("side0", "side1", "side2")], axis=1)
            np.testing.assert_allclose(actual, sides, atol=2e-5)
            first += count


@pytest.mark.parametrize("look", [0, 1])
def test_calm_leaves_are_carried_by_their_links(stand, posed, look):
    frame, poses, wanted, _, leaves = posed
    geometry, plant = stand.geometries[look], stand.plants[look]
    shift = pose_curves(geometry, plant.link_base, poses[look]).shift
    order = detail_order(geometry).leaf_order
    for row, number in placements_of(wanted, frame, look):
        place, yaw = frame.plants[look].position[number], frame.plants[look].yaw[number]
        count = int(row["leaves"][0])
        own, rest = leaves[row["first"][2] :][:count], order[:count]
        link = geometry.leaf_link[rest]
        rotation = poses[look].rotation[number, link]
        offset = geometry.leaf_position[rest] - plant.link_base[link]
        attached = poses[look].position[number, link] + rotate(rotation, offset)
        expected = place + turned_about_z(attached + shift[number, geometry.leaf_stem[rest]], yaw)
        np.testing.assert_allclose(own["position"][:, :3], expected, atol=1e-5 * plant.height)
        axis = turned_about_z(rotate(rotation, geometry.leaf_axis[rest]), yaw)
        np.testing.assert_allclose(own["axis"][:, :3], axis, atol=1e-5)


def test_leaves_tremble_in_wind_and_stay_square(stand, device):
    calm = stand.frame(time=1.0)
    windy = stand.frame(time=1.0, flutter=0.3)
    axes = []
    for frame in (calm, windy):
        wanted = drawn(stand, frame)
        rows = read_rows(
            device, stand.renderer.posing.posed_leaves.buffer, layouts.POSED_LEAF, wanted.leaf_count
        )
        assert np.abs(np.sum(rows["axis"][:, :3] * rows["normal"][:, :3], axis=1)).max() < 1e-5
        axes.append(rows["normal"][:, :3])
    turn = np.arccos(np.clip(np.sum(axes[0] * axes[1], axis=1), -1.0, 1.0))
    assert 0.01 < turn.mean() < 0.3


def test_items_of_all_placements_fill_their_ranges_once(stand):
    frame = stand.frame()
    wanted = listed(stand, frame)
    taken = np.zeros(wanted.piece_count, int)
    for row in wanted.placements:
        first = 0
        for bucket in range(4):
            count = int(row["piece_limit"][bucket]) - first
            taken[row["piece_out"][bucket] : row["piece_out"][bucket] + count] += 1
            first += count
    assert (taken == 1).all()


def test_every_shader_file_is_part_of_a_set():
    from importlib.resources import files

    names = {path.name.removesuffix(".wgsl") for path in (files("windswept.gpu") / "shaders").iterdir()}
    assert names == {part for parts in SHADER_SETS.values() for part in parts}
