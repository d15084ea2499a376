from __future__ import annotations

from typing import Any

import pytest

from handmade import random_tree
from woods import Wood, wood_of, wood_renderer


@pytest.fixture(scope="module")
def wood(device: Any) -> Wood:
    plants = [random_tree(4), random_tree(7)]
    return wood_of(wood_renderer(plants), plants, (300, 170), 60.0)
