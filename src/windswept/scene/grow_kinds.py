"""grow_kinds: one plant for each kind of a scene."""

from __future__ import annotations

from collections.abc import Callable

from windswept.plants.plant import Plant
from windswept.plants.sources import grow_source
from windswept.scene.scene import PlantKind, Scene


def grow_kinds(scene: Scene, say: Callable[[str], None] = lambda line: None) -> list[Plant]:
    """Grow every kind of a scene, in the order of ``scene.kinds``.

    Args:
        scene: what to grow.
        say: told of each plant before it is grown.

    Raises:
        BudgetError: a plant would be larger than the budget of growth.
    """
    return [_grow_kind(kind, say) for kind in scene.kinds]


def _grow_kind(kind: PlantKind, say: Callable[[str], None]) -> Plant:
    """One plant."""
    say(f"growing {kind.source}, seed {kind.seed}")
    return grow_source(kind.source, kind.seed)
