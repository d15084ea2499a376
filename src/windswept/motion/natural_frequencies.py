"""natural_frequencies: those of a plant, without a model of its motion."""

from __future__ import annotations

from windswept.errors import InputError
from windswept.motion.modes import plant_frequencies
from windswept.motion.rods import Doubles, build_rods
from windswept.motion.skeleton import build_skeleton
from windswept.plants.plant import Plant


def natural_frequencies(plant: Plant, count: int = 5) -> Doubles:
    """The lowest natural frequencies of a plant in still air, all joints coupled.

    Args:
        plant: any.
        count: how many, 1 or more.

    Returns:
        (count,) Hz, ascending; fewer where the plant has fewer freedoms.

    Raises:
        InputError: a count below 1.
    """
    if count < 1:
        raise InputError("natural_frequencies", "count", count, "1 or more")
    return plant_frequencies(build_skeleton(plant), build_rods(plant), count)
