from __future__ import annotations

import pytest

from handmade import random_tree
from stands import SOFT
from windswept.levels import Ladder, build_ladder, simplify
from windswept.motion import build_model
from windswept.plants.plant import Plant


@pytest.fixture(scope="session")
def soft_trees() -> list[Plant]:
    return [random_tree(seed, material=SOFT) for seed in (3, 5)]


@pytest.fixture(scope="session")
def soft_ladders(soft_trees: list[Plant]) -> list[Ladder]:
    return [build_ladder(simplify(build_model(tree))) for tree in soft_trees]
