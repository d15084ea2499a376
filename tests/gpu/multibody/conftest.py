from __future__ import annotations

import pytest

from windswept.levels import Ladder, build_ladder, simplify
from windswept.motion import build_model
from windswept.plants.plant import Plant
from windswept.scene import moving_kind


@pytest.fixture(autouse=True)
def no_cut_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """Levels cut for a single near plant are the CPU's alone."""
    monkeypatch.setattr(moving_kind, "NEAR", 0.0)


@pytest.fixture(scope="session")
def coupled_ladders(soft_trees: list[Plant]) -> list[Ladder]:
    """Levels of both motion models, in the order of what they cost."""
    return [build_ladder(simplify(build_model(tree)), multibody=True) for tree in soft_trees]
