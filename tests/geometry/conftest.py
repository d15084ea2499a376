from __future__ import annotations

import pytest

from handmade import random_tree
from windswept.geometry.curves import build_geometry
from windswept.geometry.geometry import Geometry
from windswept.plants.plant import Plant
from windswept.plants.weber_penn import grow


@pytest.fixture(scope="session", params=["random", "quaking_aspen"])
def plant(request: pytest.FixtureRequest) -> Plant:
    return random_tree(4) if request.param == "random" else grow("quaking_aspen", 3)


@pytest.fixture(scope="session")
def geometry(plant: Plant) -> Geometry:
    return build_geometry(plant)


@pytest.fixture(scope="session")
def aspen() -> Geometry:
    return build_geometry(grow("quaking_aspen", 3))
