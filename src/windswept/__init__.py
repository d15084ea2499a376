"""windswept grows plants, blows wind through them, and shows the motion; plants at rest are exported.

The line through the house; data goes down it and never back::

    species file  --grow-->     Plant            rest skeleton: stems, links, leaves
    scene file    --load-->     Scene            ground, placed plants, wind, camera
    (Plant, Scene) --compile--> Model + State    constants of motion, and what moves
    State         --step-->     State            one fixed inner step
    State         --pose-->     Pose             where every link is now
    (Geometry, Pose) --draw-->  picture, video

The rooms, in the order in which they may import each other::

    errors < forms < plants, wind < motion, geometry < levels < scene < gpu < render, export < studies < cli

Example::

    import windswept

    simulation = windswept.Simulation(windswept.load_scene("quaking_aspen"))
    simulation.advance(1 / 60)
    simulation.pose[0].position  # (1, links, 3), of scene.kinds[0], in the plant's own frame

docs/python.md has a longer one.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from windswept.errors import BudgetError, GraphicsError, InputError, WindsweptError
    from windswept.motion.natural_frequencies import natural_frequencies
    from windswept.plants.plant import Plant
    from windswept.plants.pose import Pose
    from windswept.plants.sources import grow_source
    from windswept.plants.species import load_species, species_names
    from windswept.plants.underbrush.library import underbrush_names
    from windswept.plants.weber_penn import grow
    from windswept.scene.load_scene import load_scene
    from windswept.scene.scene import Scene
    from windswept.scene.simulation import Simulation
    from windswept.scene.world_links import world_links

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
    "natural_frequencies": "windswept.motion.natural_frequencies",
    "species_names": "windswept.plants.species",
    "underbrush_names": "windswept.plants.underbrush.library",
    "world_links": "windswept.scene.world_links",
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
    "natural_frequencies",
    "species_names",
    "underbrush_names",
    "world_links",
]


if not TYPE_CHECKING:  # or every name would be one to a type checker

    def __getattr__(name: str) -> Any:
        """Public names load their module when first used: ``import windswept`` itself costs nothing."""
        if name not in _HOMES:
            raise AttributeError(f"module 'windswept' has no attribute {name!r}")
        return getattr(importlib.import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return __all__
