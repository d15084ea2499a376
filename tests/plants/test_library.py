"""The species library: what its summaries promise grows, and frequencies are those of plants."""

import re

import numpy as np
import pytest

from windswept.motion.modes import plant_frequencies
from windswept.motion.rods import build_rods
from windswept.motion.skeleton import build_skeleton
from windswept.plants.species import load_species, species_names
from windswept.plants.weber_penn import grow


@pytest.mark.parametrize("name", species_names())
def test_heights_are_those_of_the_summary(name: str) -> None:
    low, high = re.search(r"of ([\d.]+)-([\d.]+) m", load_species(name).summary).groups()
    heights = [grow(name, seed).height for seed in range(3)]
    assert 0.92 * float(low) <= min(heights)
    assert max(heights) <= 1.08 * float(high)


@pytest.mark.parametrize("name", species_names())
def test_frequency_is_that_of_a_plant(name: str) -> None:
    # Measured plants lie between f sqrt(H) = 0.4 (soft grass) and about 6 (stout open-grown trees).
    plant = grow(name)
    lowest = plant_frequencies(build_skeleton(plant), build_rods(plant), 1)[0]
    assert 0.3 < lowest * np.sqrt(plant.height) < 6.0
    assert plant.leaf_area.sum() > 0
    assert plant.link_count < 40_000


def test_every_kind_of_plant_is_there() -> None:
    names = set(species_names())
    assert len(names) >= 24
    assert {"european_beech", "norway_spruce", "coconut_palm", "fan_palm", "elder"} <= names
    assert {"bracken", "common_reed", "wheat", "tall_grass", "soft_rush"} <= names
