"""What the card cannot hold is said in one line, before it is asked for."""

from __future__ import annotations

import numpy as np
import pytest
import wgpu

from handmade import random_tree
from windswept.errors import GraphicsError
from windswept.geometry.curves import build_geometry
from windswept.geometry.detail import DetailRules
from windswept.gpu import buffers, layouts
from windswept.gpu.buffers import GrowingBuffer, filled, table
from windswept.gpu.plant_buffers import plant_arrays
from windswept.gpu.renderer import Renderer

ROW_BYTES = layouts.LINK_POSE.itemsize


def test_arrays_beyond_a_binding_are_refused(device, monkeypatch):
    monkeypatch.setattr(buffers, "binding_limit", lambda device: 1024)
    assert filled(device, np.zeros(256, np.float32)).size == 1024
    with pytest.raises(GraphicsError, match=r"0\.00 MB on this card: place fewer plants"):
        filled(device, np.zeros(257, np.float32))


def test_memory_that_an_array_does_not_find_is_said(device, monkeypatch):
    def full(**_asked):
        raise wgpu.GPUOutOfMemoryError("Out of Memory")

    monkeypatch.setattr(device, "create_buffer_with_data", full)
    with pytest.raises(GraphicsError, match="too little memory for holding the scene"):
        filled(device, np.zeros(4, np.float32))


@pytest.mark.parametrize("part", ["pieces", "leaves"])
def test_plants_of_more_parts_than_a_binding_takes(stand, monkeypatch, part):
    looks = [plant.look for plant in stand.plants]
    size = getattr(plant_arrays(stand.plants, stand.geometries, looks, DetailRules()), part).nbytes
    monkeypatch.setattr(buffers, "binding_limit", lambda device: size - 1)
    with pytest.raises(GraphicsError, match="MB are needed in one buffer"):
        Renderer(stand.plants, stand.geometries, size=(32, 32))


def test_a_growing_buffer_keeps_to_its_most(device):
    store = GrowingBuffer(device, layouts.LINK_POSE, 1000 * ROW_BYTES + 5)
    assert (store.rows, store.most_rows) == (64, 1000)
    store.reserve(400)
    assert store.rows == 500
    store.reserve(900)
    assert store.rows == 1000
    store.reserve(1001)
    assert store.rows == 1001


def test_a_growing_buffer_holds_a_row_at_least(device):
    assert GrowingBuffer(device, layouts.LINK_POSE, 1).rows == 1


def test_a_growing_buffer_stays_within_what_the_device_binds(device, monkeypatch):
    monkeypatch.setattr(buffers, "binding_limit", lambda device: 100 * ROW_BYTES)
    store = GrowingBuffer(device, layouts.LINK_POSE)
    store.reserve(90)
    assert store.rows == 100
    with pytest.raises(GraphicsError, match="MB are needed in one buffer"):
        store.reserve(101)


def test_what_frames_pose_keeps_to_its_most(stand, monkeypatch):
    monkeypatch.setattr("windswept.gpu.posing.MOST_BYTES", 100 * layouts.POSED_PIECE.itemsize)
    posing = Renderer(stand.plants, stand.geometries, size=(32, 32)).posing
    posing.reserve(posing.affordable((10**6,) * 4))
    assert all(
        store.buffer.size <= 100 * layouts.POSED_PIECE.itemsize < store.buffer.size + store.row_bytes
        for store in posing._stores
    )


def test_tables_are_filled_up_and_never_cut_off():
    rows = table(np.ones((3, 4), np.float32), 5, "kinds of plants")
    assert rows.sum(axis=1).tolist() == [4, 4, 4, 0, 0]
    with pytest.raises(GraphicsError, match="up to 2 kinds of plants, and there are 3"):
        table(np.ones(3), 2, "kinds of plants")


def test_a_picture_of_more_kinds_than_one_reads_at_once(monkeypatch):
    # The kinds beyond the 64th were the first that pictures could not hold.
    plant = random_tree(4)
    geometry = build_geometry(plant)
    Renderer([plant] * 65, [geometry] * 65, size=(32, 32), extra_looks=(plant.look,) * 8)
    many = layouts.KIND_LIMIT + 1
    with pytest.raises(
        GraphicsError, match=f"up to {layouts.KIND_LIMIT} kinds of plants, and there are {many}"
    ):
        Renderer([plant] * many, [geometry] * many, size=(32, 32))
    beyond = (plant.look,) * layouts.LOOK_LIMIT
    with pytest.raises(GraphicsError, match="looks of plants"):
        Renderer([plant], [geometry], size=(32, 32), extra_looks=beyond)
