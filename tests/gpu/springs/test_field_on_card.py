"""A force field among plants on the card: their probes feel what they feel on the CPU."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest

from stands import both, gaps, only, stand_of, winds_of_cpu, winds_on_card
from windswept.errors import GraphicsError
from windswept.gpu.springs.card_field import CardField
from windswept.scene.scene import Scene
from windswept.scene.terrain import hilly_terrain
from windswept.wind.field import Ball, Cylinder, FieldPlan, Grid, Line, Path, Uniform, start_field
from windswept.wind.wind import calm


def in_a_field(scene: Scene) -> Scene:
    """Plants of which some stand in a field with a post, a vortex, a flow that begins, and a ball."""
    way = Path(np.array([0.0, 4.0]), np.array([[-5.0, 0.0], [5.0, 12.0]]))
    plan = FieldPlan(
        Grid((-7.0, -2.0), (0.9, 1.1, 0.5), (16, 18, 9)),
        primitives=(Uniform((3.0, -6.0, 1.0), 1.0, np.inf), Line((0.0, 6.0, 0.0), vortex=8.0, core=1.0)),
        obstacles=(Cylinder((2.0, 4.0), 0.8, 3.0),),
        agents=(Ball(way, radius=0.5),),
    )
    return replace(scene, field=plan, terrain=hilly_terrain(300.0, 4.0, 60.0, np.random.default_rng(2)))


def test_probes_feel_the_field_at_both_ends_of_every_interval(soft_trees, soft_ladders):
    scene = in_a_field(stand_of(soft_trees[:1], [70], depth=40.0))
    simulation, card = both(scene, [only(soft_ladders[0], 2)], soft_trees[:1])
    without = both(replace(scene, field=None), [only(soft_ladders[0], 2)], soft_trees[:1])[1]
    for _ in range(3):
        actual = winds_on_card(card, 2)[..., :3]
        np.testing.assert_allclose(actual, winds_of_cpu(simulation.kinds[0].sets[2]), atol=2e-4)
        added = np.linalg.norm(actual - winds_on_card(without, 2)[..., :3], axis=-1)
        assert added.max() > 1.0
        assert (added.max(axis=(1, 2)) == 0.0).mean() > 0.3, "far from the field there is only the wind"
        for one in (simulation, card, without):
            one.advance(1.001)


def test_plants_in_a_field_move_as_on_the_cpu(soft_trees, soft_ladders):
    scene = in_a_field(stand_of(soft_trees, [12, 7], depth=16.0))
    simulation, card = both(scene, soft_ladders, soft_trees)
    alone = both(replace(scene, field=None), soft_ladders, soft_trees)[0]
    worst, matters = np.zeros(2), np.zeros(2)
    for _ in range(20):
        for one in (simulation, card, alone):
            one.advance(0.5)
        worst = np.maximum(worst, gaps(simulation, card))
        matters = np.maximum(matters, gaps(alone, card))
    assert (matters > 0.05).all()
    assert (worst < 1e-3).all()


def test_a_field_larger_than_the_card_binds_is_refused():
    class Small:
        limits: ClassVar = {"max-storage-buffer-binding-size": 2 * 16 * 99}

    field = start_field(FieldPlan(Grid((0.0, 0.0), (1.0, 1.0, 1.0), (5, 5, 4))), calm())
    with pytest.raises(GraphicsError, match="in one buffer"):
        CardField(Small(), field)
