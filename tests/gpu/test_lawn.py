"""Parity of the lawn: the card's blades against ``grass_field``'s."""

from __future__ import annotations

import re
from importlib.resources import files

import numpy as np
import pytest

from windswept.gpu import layouts
from windswept.gpu.backdrop import BLADE_TRIANGLES, GRASS_BATCH
from windswept.gpu.frame import Camera, Ground
from windswept.gpu.grass_field import BLEND, MARGIN, grass_field
from windswept.gpu.lawn import LAWN_LOOK, Lawn
from windswept.gpu.matrices import camera_matrix, frustum_planes

CAMERAS = [
    Camera((0.0, -5.0, 1.5), (0.0, 5.0, 0.0), 0.9),
    Camera((-37.3, 21.8, 6.0), (-60.0, 20.0, 2.0), 0.5),
    Camera((512.2, -733.4, 2.5), (500.0, -700.0, 1.0), 1.2),
]
SOURCE = (files("windswept.gpu") / "shaders" / "lawn.wgsl").read_text()


@pytest.fixture(scope="module")
def ground() -> Ground:
    heights = np.random.default_rng(3).uniform(0.0, 2.0, (7, 9)).astype(np.float32)
    return Ground(heights, (-40.0, -30.0), 10.0)


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_same_blades_stand_in_the_same_places(device, ground, camera):
    eye, planes = np.array(camera.eye), frustum_planes(camera_matrix(camera, 1.5))
    expected = grass_field(ground, eye, planes)
    lawn = Lawn(device, ground)
    encoder = device.create_command_encoder()
    lawn.record(encoder, eye, planes, {})
    device.queue.submit([encoder.finish()])
    total = int(np.frombuffer(device.queue.read_buffer(lawn.batch), np.uint32)[1])
    rows = np.frombuffer(device.queue.read_buffer(lawn.blades), layouts.GRASS_BLADE)[:total]
    words = np.frombuffer(device.queue.read_buffer(lawn.words), np.uint32)
    assert words.tolist() == [BLADE_TRIANGLES.size * GRASS_BATCH, -(-total // GRASS_BATCH), 0, 0, 0]

    def numbered(blades):
        """Blades by their chances, which hardly two share, and where they stand to a centimetre."""
        return {
            (*chance, *np.round(root[:2]).astype(int)): root
            for chance, root in zip(blades["chance"].tolist(), blades["root"], strict=True)
        }

    ours, theirs = numbered(rows), numbered(expected)
    # Who stands on the edge of the picture or of a ring may fall on its other side, or be rounded to another metre.
    assert len(ours.keys() ^ theirs.keys()) <= 2e-3 * len(theirs) + 2
    assert len(theirs) > 1_000
    both = sorted(ours.keys() & theirs.keys())
    gap = np.abs(np.array([ours[k] for k in both]) - np.array([theirs[k] for k in both]))
    assert gap[:, :2].max() < 2e-4
    assert gap[:, 2:].max() < 2e-3


def test_blades_follow_the_order_of_their_cells(device, ground):
    """So that the same camera gets the same picture."""
    camera = CAMERAS[0]
    eye, planes = np.array(camera.eye), frustum_planes(camera_matrix(camera, 1.5))
    lawn, lists = Lawn(device, ground), []
    for _ in range(2):
        encoder = device.create_command_encoder()
        lawn.record(encoder, eye, planes, {})
        device.queue.submit([encoder.finish()])
        lists.append(bytes(device.queue.read_buffer(lawn.blades)))
    assert lists[0] == lists[1]


def test_the_look_agrees_with_the_shader():
    types = {"vec4f": layouts.REALS, "vec4u": layouts.COUNTS}
    body = re.findall(r"struct LawnLook \{(.*?)\n\}", SOURCE, re.DOTALL)[0]
    fields = []
    for name, kind in re.findall(r"^\s*(\w+): (.+?),(?: *//.*)?$", body, re.MULTILINE):
        many = re.fullmatch(r"array<(\w+), (\d+)>", kind)
        base, shape = types[many[1] if many else kind]
        fields.append((name, base, (int(many[2]), *shape) if many else shape))
    assert np.dtype(fields) == LAWN_LOOK


@pytest.mark.parametrize(
    "line",
    [
        f"const BLEND = {BLEND};",
        f"const MARGIN = {MARGIN};",
        f"const BATCH = {GRASS_BATCH}u;",
        f"const INDICES = {BLADE_TRIANGLES.size}u;",
    ],
)
def test_constants_agree_with_the_shader(line):
    assert line in SOURCE
