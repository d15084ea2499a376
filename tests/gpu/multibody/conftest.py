from __future__ import annotations

import pytest

from handmade import random_tree
from stands import SOFT
from windswept.levels import Ladder, build_ladder, simplify
from windswept.motion import build_model
from windswept.plants.plant import Plant
from windswept.scene import moving_kind


@pytest.fixture(autouse=True)
def no_cut_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """Levels cut for a single near plant are the CPU's alone."""
    monkeypatch.setattr(moving_kind, "NEAR", 0.0)


@pytest.fixture(scope="session")
def limp_trees() -> list[Plant]:
    return [random_tree(seed, material=SOFT) for seed in (3, 5)]


@pytest.fixture(scope="session")
def coupled_ladders(limp_trees: list[Plant]) -> list[Ladder]:
    """Levels of both motion models, in the order of what they cost."""
    return [build_ladder(simplify(build_model(tree)), multibody=True) for tree in limp_trees]
