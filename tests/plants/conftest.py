"""What the tests of growth share."""

import pytest

from windswept.plants.species import Species


@pytest.fixture(scope="session")
def sample_species():
    """Maker of small species: ``growth`` over defaults, one dict per level over a plain stem."""

    def make(growth=None, *levels):
        tree = {"shape": 3, "levels": max(1, len(levels) - 1), "scale": 10.0, "ratio": 0.02} | (growth or {})
        tree["level"] = [{"length": 1.0} | level for level in levels or ({},)]
        return Species.model_validate({"name": "sample", "common_name": "Sample", "growth": tree})

    return make
