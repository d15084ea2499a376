"""What the tests of L-systems share."""

import numpy as np
import pytest

from windswept.plants.lsystem.derive import MODULE_BUDGET, Rewriter, derive
from windswept.plants.lsystem.interpret import interpret
from windswept.plants.lsystem.read_system import read_system
from windswept.plants.lsystem.turtle import draw


@pytest.fixture(scope="session")
def derived():
    """String that a grammar derives."""

    def run(text, seed=0, budget=MODULE_BUDGET):
        return str(derive(read_system(text, "test.l"), np.random.default_rng(seed), budget))

    return run


@pytest.fixture(scope="session")
def drawn():
    """Sketch that a grammar draws."""

    def run(text, seed=0, aspect=0.5):
        system = read_system(text, "test.l")
        dice = np.random.default_rng(seed)
        word = derive(system, dice)
        return draw(interpret(word, Rewriter(system, dice, MODULE_BUDGET)), system.reading, aspect, "test.l")

    return run
