"""A plant's natural frequencies in one call."""

from __future__ import annotations

import numpy as np
import pytest

from handmade import random_tree
from windswept.errors import InputError
from windswept.motion import build_model, plant_frequencies
from windswept.motion.natural_frequencies import natural_frequencies


def test_they_are_those_of_the_plants_own_model() -> None:
    plant = random_tree(0)
    model = build_model(plant)
    found = natural_frequencies(plant, 3)
    np.testing.assert_allclose(found, plant_frequencies(model.skeleton, model.rods, 3), rtol=1e-6)
    assert len(found) == 3
    assert (np.diff(found) >= 0.0).all()


def test_none_are_no_answer() -> None:
    with pytest.raises(InputError, match="count = 0: expected 1 or more"):
        natural_frequencies(random_tree(0), 0)
