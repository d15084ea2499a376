"""Which leaves of a plant throw shadows does not depend on who else is drawn, neither on the CPU nor on the card."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from handmade import random_tree, with_leaves
from windswept.geometry.curves import build_geometry
from windswept.geometry.detail import LEAF_MESHES, LEAF_RUN, DetailRules
from windswept.gpu import layouts
from windswept.gpu.buffers import UNIFORM_STRIDE
from windswept.gpu.draw_list import draw_list
from windswept.gpu.draw_plan import SHADOW_LEAF_STEP, batch_rows
from windswept.gpu.frame import Camera, Frame, PosedPlants
from windswept.gpu.renderer import Renderer
from windswept.plants.plant import Plant
from windswept.plants.pose import rest_pose
from woods import RULES, SIZE, Wood, wood_of, wood_renderer

FULL = DetailRules(leaf_pixels=0.1)
"""Every leaf is drawn, at its own size."""
CAMERA = Camera((0.0, 0.0, 1.7), (10.0, 3.0, 2.0))


def odd_tree(seed: int) -> Plant:
    tree = random_tree(seed)
    assert tree.leaf_count % 2 == 0
    return with_leaves(tree, tree.leaf_count - 1)


@pytest.fixture(scope="module")
def odd_wood(device: Any) -> Wood:
    plants = [odd_tree(4), odd_tree(7)]
    return wood_of(wood_renderer(plants), plants, (140, 71), 40.0)


def throwers(placements: np.ndarray, batches: np.ndarray) -> dict[int, list[int]]:
    """Ranks of the leaves that throw a shadow, by the number of their placement."""
    taken = [first + step * np.arange(items) for first, items, step, _ in batches["items"][-LEAF_MESHES:]]
    rows = placements[placements["leaves"][:, 0] > 0]
    first, count = rows["first"][:, 2].astype(int), rows["leaves"][:, 0].astype(int)
    found: dict[int, list[int]] = {}
    for item in np.concatenate(taken):
        owner = int(np.flatnonzero((first <= item) & (item < first + count))[0])
        found.setdefault(int(rows["number"][owner, 0]), []).append(int(item - first[owner]))
    return found


def throwers_of_cpu(wood: Wood, placed: tuple[PosedPlants, ...]) -> dict[int, list[int]]:
    view, _ = wood.renderer._look(wood.frame(CAMERA))
    wanted = draw_list(wood.renderer.kinds, placed, view, RULES)
    return throwers(wanted.placements, batch_rows(wanted, wood.renderer._plan.meshes))


def throwers_of_card(wood: Wood, placed: tuple[PosedPlants, ...], device: Any) -> dict[int, list[int]]:
    wood.renderer.draw(replace(wood.frame(CAMERA), plants=placed))
    plan = wood.renderer._plan
    uniforms = np.frombuffer(device.queue.read_buffer(plan.batches), np.uint8).reshape(-1, UNIFORM_STRIDE)
    batches = uniforms[: len(plan.meshes), : layouts.BATCH.itemsize].copy().view(layouts.BATCH)[:, 0]
    rows = np.frombuffer(device.queue.read_buffer(plan.placements), layouts.PLACEMENT)
    return throwers(rows[: wood.renderer._tally.now(0).placements], batches)


def nearer(placed: tuple[PosedPlants, ...]) -> tuple[PosedPlants, ...]:
    """The same placements, the others of which have gone: the last of the first kind, and all of the second."""
    first, second = placed
    return (
        replace(first, position=first.position[:50], yaw=first.yaw[:50], flutter=first.flutter[:50]),
        replace(second, position=second.position[:0], yaw=second.yaw[:0], flutter=second.flutter[:0]),
    )


def test_runs_hold_whole_steps_of_shadows():
    assert LEAF_RUN % SHADOW_LEAF_STEP == 0


def test_every_plants_leaves_throw_shadows_from_its_first_on(odd_wood, device):
    of_cpu = throwers_of_cpu(odd_wood, odd_wood.placed)
    assert len(of_cpu) > 30
    assert len({len(ranks) for ranks in of_cpu.values()}) > 3, "in various detail"
    for ranks in of_cpu.values():
        assert ranks == list(range(0, 2 * len(ranks), 2))
    assert throwers_of_card(odd_wood, odd_wood.placed, device) == of_cpu


def test_who_has_gone_changes_nobodys_shadow(odd_wood, device):
    fewer = nearer(odd_wood.placed)
    for all_of_them, some_of_them in (
        (throwers_of_cpu(odd_wood, odd_wood.placed), throwers_of_cpu(odd_wood, fewer)),
        (
            throwers_of_card(odd_wood, odd_wood.placed, device),
            throwers_of_card(odd_wood, fewer, device),
        ),
    ):
        assert 5 < len(some_of_them) < len(all_of_them)
        assert some_of_them == {number: all_of_them[number] for number in some_of_them}


def rest_frame(plants: list[Plant], positions: list[tuple[float, float, float]], **changes: Any) -> Frame:
    placed = [
        PosedPlants(
            rest_pose(plant, 1).link,
            np.array([place], np.float32),
            np.zeros(1, np.float32),
            np.zeros(1, np.float32),
        )
        for plant, place in zip(plants, positions, strict=True)
    ]
    return Frame(tuple(placed), Camera((0.0, -9.0, 2.0), (0.0, 0.0, 1.5)), **changes)


def test_a_plant_out_of_sight_leaves_the_picture_as_it_is():
    """It stands behind the camera, and its shadow falls away from what is seen."""
    plants = [random_tree(4), odd_tree(7)]
    renderer = Renderer(plants, [build_geometry(plant) for plant in plants], size=SIZE, rules=FULL)
    near, gone = (
        rest_frame(plants, [(0.0, 0.0, 0.0), (0.0, y, 0.0)], sun=(0.3, 0.9, 0.6)) for y in (-15.0, -1000.0)
    )
    wanted = [draw_list(renderer.kinds, f.plants, renderer._look(f)[0], FULL) for f in (near, gone)]
    hidden = [sum(mesh.hidden for mesh in each.leaves) for each in wanted]
    assert hidden == [plants[1].leaf_count + 1, 0], "its leaves stand before those of the other"
    np.testing.assert_array_equal(renderer.draw(near), renderer.draw(gone))


def test_a_single_leaf_keeps_its_size(device):
    plant = with_leaves(random_tree(4), 1)
    renderer = Renderer([plant], [build_geometry(plant)], size=SIZE, rules=FULL)
    renderer.draw(rest_frame([plant], [(0.0, -7.0, 0.0)]))
    leaves = np.frombuffer(device.queue.read_buffer(renderer.posing.posed_leaves.buffer), layouts.POSED_LEAF)
    np.testing.assert_allclose(leaves["position"][:2, 3], [plant.leaf_length[0], 0.0], rtol=1e-6)
    np.testing.assert_allclose(leaves["axis"][:2, 3], [plant.leaf_width[0], 0.0], rtol=1e-6)
    np.testing.assert_array_equal(leaves["position"][0, :3], leaves["position"][1, :3])
