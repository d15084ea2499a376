"""Ten thousand placed trees on the card: chosen as the CPU chooses them, and posed as far as they are seen."""

from __future__ import annotations

import numpy as np
import pytest
import wgpu

from handmade import random_tree
from windswept.geometry.detail import SOFTWARE_RULES
from windswept.gpu.draw_list import draw_list
from windswept.gpu.springs.kinds import GrownKind
from windswept.levels import build_ladder, simplify
from windswept.motion import build_model
from windswept.render.staging import frame_now
from windswept.studies.bench_forest import forest
from windswept.studies.bench_forest_gpu import forest_figures, forest_walk

PLACEMENTS = 10_000


@pytest.fixture(scope="module")
def walk():
    scene = forest(PLACEMENTS)
    models = [build_model(random_tree(seed)) for seed in range(3, 3 + len(scene.kinds))]
    kinds = [
        GrownKind(random_tree(3 + number), model, build_ladder(simplify(model)), placed)
        for number, (model, placed) in enumerate(zip(models, scene.placements, strict=True))
    ]
    return forest_walk(scene, kinds, (64, 36), SOFTWARE_RULES)


def test_everything_is_measured(walk):
    figures = forest_figures(walk, frames=1, repeats=1)
    named = {name.removeprefix(f"gpu.forest.{PLACEMENTS}."): value for name, value in figures.items()}
    assert {"bytes", "drawn", "refused", "poses", "frame.ms", "frames_per_second"} <= set(named)
    assert named["refused"] == 0
    assert all(np.isfinite(value) for value in named.values())
    if walk.simulation.stage_milliseconds:
        stages = {"levels", "wind", "simulate", "pose", "cull", "curves", "shadows", "picture"}
        assert {f"{stage}.ms" for stage in stages} <= set(named)


def test_every_buffer_is_counted_once(walk):
    figures = forest_figures(walk, frames=1, repeats=1)
    card, renderer = walk.simulation.card, walk.renderer
    lent = {id(buffer) for buffer in card.resources.values()}
    chosen = [renderer.culling._ranks, *renderer.culling._resources.values()]
    own = sum(b.size for b in chosen if isinstance(b, wgpu.GPUBuffer) and id(b) not in lent)
    assert figures[f"gpu.forest.{PLACEMENTS}.bytes"] == card.bytes + renderer.posing.bytes + own


def test_those_in_sight_are_drawn_and_no_more_of_them_is_posed_than_that(walk):
    walk.draw(1)
    renderer, frame = walk.renderer, frame_now(walk.simulation)
    view, _ = renderer._look(frame)
    wanted = draw_list(renderer.kinds, frame.plants, view, SOFTWARE_RULES)
    renderer.draw(frame)
    told = renderer.told_now
    # Sizes in single precision may tell one at the edge of a picture or of a bucket otherwise.
    assert abs(told.placements - len(wanted.placements)) <= 2
    np.testing.assert_allclose(told.wanted, wanted.counts, rtol=1e-3)
    assert told.placements < 0.4 * PLACEMENTS
    links = max(kind.model.link_count for kind in walk.simulation.kinds)
    assert told.wanted[0] < 0.5 * told.placements * links
