"""Plants so large that a software driver would leave the loops over their links."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from stands import gaps, stand_of
from windswept.errors import GraphicsError
from windswept.gpu import layouts
from windswept.gpu.springs.kinds import kinds_of
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.gpu.springs.turns import steps_in_turns
from windswept.scene.simulation import Simulation
from windswept.studies.bench_plants import plant_with_links


def adapter(kind: str) -> SimpleNamespace:
    return SimpleNamespace(adapter=SimpleNamespace(info={"adapter_type": kind}))


def rungs_of(*links: int) -> np.ndarray:
    rows = np.zeros(len(links), layouts.RUNG)
    rows["links"][:, 1] = links
    return rows


@pytest.mark.parametrize(("links", "steps"), [(4000, 4), (5000, 3), (8000, 2), (16_000, 1)])
def test_a_software_driver_takes_fewer_steps_of_larger_plants(links, steps):
    assert steps_in_turns(adapter("CPU"), rungs_of(10, links), 4) == steps
    assert steps_in_turns(adapter("DiscreteGPU"), rungs_of(links), 4) == 4


def test_a_plant_too_large_for_a_software_driver_is_said():
    with pytest.raises(GraphicsError, match=r"20000 links .* moves 16379 at most: simulate on the CPU"):
        steps_in_turns(adapter("CPU"), rungs_of(20_000), 4)
    assert steps_in_turns(adapter("DiscreteGPU"), rungs_of(20_000), 4) == 4


def test_all_links_of_a_large_plant_move():
    tree = plant_with_links(5000)
    scene = stand_of([tree], [2])
    simulation = Simulation(scene, [tree])
    card = GpuSimulation(scene, kinds_of(simulation))
    assert gaps(simulation.advance(0.2), card.advance(0.2)).max() < 5e-6
