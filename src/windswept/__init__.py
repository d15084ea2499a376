"""windswept grows plants, blows wind through them, and shows or exports the motion.

The line through the house; data goes down it and never back::

    species file  --grow-->     Plant            rest skeleton: stems, links, leaves
    scene file    --load-->     Scene            ground, placed plants, wind, camera
    (Plant, Scene) --compile--> Model + State    constants of motion, and what moves
    State         --step-->     State            one fixed inner step
    State         --pose-->     Pose             where every link is now
    (Geometry, Pose) --draw-->  picture, video

The rooms, in the order in which they may import each other::

    plants, wind  <  motion, geometry  <  scene  <  gpu  <  render  <  studies  <  cli

Example::

    import windswept

    simulation = windswept.Simulation(windswept.load_scene("quaking_aspen"))
    simulation.advance(1 / 60)
    simulation.pose[0].position  # (1, links, 3)
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from windswept.errors import BudgetError, GraphicsError, InputError, WindsweptError
    from windswept.plants.plant import Plant
    from windswept.plants.pose import Pose
    from windswept.plants.sources import grow_source
    from windswept.plants.species import load_species, species_names
    from windswept.plants.weber_penn import grow
    from windswept.scene.load_scene import load_scene
    from windswept.scene.scene import Scene
    from windswept.scene.simulation import Simulation

_HOMES = {
    "BudgetError": "windswept.errors",
    "GraphicsError": "windswept.errors",
    "InputError": "windswept.errors",
    "Plant": "windswept.plants.plant",
    "Pose": "windswept.plants.pose",
    "Scene": "windswept.scene.scene",
    "Simulation": "windswept.scene.simulation",
    "WindsweptError": "windswept.errors",
    "grow": "windswept.plants.weber_penn",
    "grow_source": "windswept.plants.sources",
    "load_scene": "windswept.scene.load_scene",
    "load_species": "windswept.plants.species",
    "species_names": "windswept.plants.species",
}

__all__ = [
    "BudgetError",
    "GraphicsError",
    "InputError",
    "Plant",
    "Pose",
    "Scene",
    "Simulation",
    "WindsweptError",
    "grow",
    "grow_source",
    "load_scene",
    "load_species",
    "species_names",
]


def __getattr__(name: str) -> Any:
    """Public names load their module when first used: ``import windswept`` itself costs nothing."""
    if name not in _HOMES:
        raise AttributeError(f"module 'windswept' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return __all__
