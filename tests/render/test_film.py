"""What a film on the card says of plants for which there was no room."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import random_tree
from stands import SOFT, stand_of
from windswept.gpu import posing
from windswept.gpu.springs.kinds import GrownKind
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.motion import build_model
from windswept.render.film import Shot, film_picture, film_video
from windswept.render.staging import frame_now, stage
from windswept.scene.camera import Camera

SHOT = Shot((48, 32))
COUNT = 7


@pytest.fixture
def card() -> GpuSimulation:
    """Trees that a camera sees at first; then it looks elsewhere, from far away."""
    tree = random_tree(3, material=SOFT)
    scene = stand_of([tree], [COUNT], depth=20.0)
    eye, target = [[0.0, -4.0, 2.0], [900.0, 0.0, 2.0]], [[0.0, 9.0, 2.0], [1000.0, 0.0, 2.0]]
    camera = Camera(*(np.float32(part) for part in ([0.0, 0.1], eye, target, [1.2, 1.2])))
    scene = replace(scene, camera=camera, duration=0.3, frames_per_second=10.0)
    return GpuSimulation(scene, [GrownKind(tree, build_model(tree), None, scene.placements[0])])


def test_a_film_tells_of_the_frame_that_lacked_most(card, tmp_path, monkeypatch):
    assert film_video(card, tmp_path / "all.webp", SHOT).refused == 0
    again = GpuSimulation(card.scene, card.kinds)
    monkeypatch.setattr(posing, "MOST_BYTES", 64)
    refused = film_video(again, tmp_path / "none.webp", SHOT).refused
    assert 0 < refused <= COUNT
    last = stage(again, SHOT.size)
    last.draw(frame_now(again))
    assert last.told_now.refused == 0


def test_a_picture_tells_who_is_missing(card, tmp_path, monkeypatch):
    monkeypatch.setattr(posing, "MOST_BYTES", 64)
    assert film_picture(card, tmp_path / "none.png", 0.0, SHOT).refused > 0
    assert film_picture(card, tmp_path / "away.png", 0.3, SHOT).refused == 0
