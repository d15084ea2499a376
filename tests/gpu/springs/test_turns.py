"""Plants so large that a software driver would leave the loops over their links: they are walked in shares."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from stands import both, gaps, kinds_of, stand_of
from windswept.errors import GraphicsError
from windswept.gpu import layouts
from windswept.gpu.springs import simulation as simulation_module
from windswept.gpu.springs import walk
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.gpu.springs.turns import check_walked_whole, links_in_turns, steps_in_turns
from windswept.scene.simulation import Simulation
from windswept.studies.bench_plants import plant_with_links


def adapter(kind: str) -> SimpleNamespace:
    return SimpleNamespace(adapter=SimpleNamespace(info={"adapter_type": kind}))


def rungs_of(*links: int) -> np.ndarray:
    rows = np.zeros(len(links), layouts.RUNG)
    rows["links"][:, 1] = links
    return rows


@pytest.mark.parametrize(("links", "steps"), [(4000, 4), (5000, 3), (8000, 2), (16_000, 1), (40_000, 1)])
def test_a_software_driver_takes_fewer_steps_of_larger_plants(links, steps):
    assert steps_in_turns(adapter("CPU"), rungs_of(10, links), 4) == steps
    assert steps_in_turns(adapter("DiscreteGPU"), rungs_of(links), 4) == 4


def test_a_software_driver_walks_large_plants_share_by_share():
    assert links_in_turns(adapter("CPU"), rungs_of(10, 16_000), 4) == 16_000
    assert links_in_turns(adapter("CPU"), rungs_of(10, 40_000), 4) == 16_379
    assert links_in_turns(adapter("DiscreteGPU"), rungs_of(40_000), 4) == 40_000


def test_a_plant_too_large_for_a_software_driver_is_said():
    with pytest.raises(GraphicsError, match=r"70000 links .* moves 65519 at most: simulate on the CPU"):
        check_walked_whole(adapter("CPU"), rungs_of(70_000), 1)
    check_walked_whole(adapter("CPU"), rungs_of(65_000), 1)
    check_walked_whole(adapter("DiscreteGPU"), rungs_of(70_000), 1)


@pytest.mark.parametrize(("links", "seconds"), [(5000, 0.2), (18_000, 0.05)])
def test_all_links_of_a_large_plant_move(links, seconds):
    tree = plant_with_links(links)
    scene = stand_of([tree], [2])
    simulation = Simulation(scene, [tree])
    card = GpuSimulation(scene, kinds_of(simulation))
    assert gaps(simulation.advance(seconds), card.advance(seconds)).max() < 5e-6


@pytest.mark.parametrize("share", [9, 100])
def test_shares_of_a_walk_are_the_walk(soft_trees, soft_ladders, monkeypatch, share):
    scene = stand_of(soft_trees, [9, 70], depth=60.0)
    whole = both(scene, soft_ladders, soft_trees)[1].advance(0.5)
    monkeypatch.setattr(walk, "links_in_turns", lambda *_: share)
    monkeypatch.setattr(simulation_module, "steps_in_turns", lambda *_: 1)
    shared = both(scene, soft_ladders, soft_trees)[1].advance(0.5)
    assert len(shared._walk._steppers) == -(-max(tree.link_count for tree in soft_trees) // share)
    assert np.array_equal(shared.card.read("state", "<f4"), whole.card.read("state", "<f4"))
