"""What the card simulates: plants that are grown and compiled, and where they stand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from windswept.levels import Ladder, build_ladder, measured_ladder, simplify
from windswept.motion import Level, Model, build_model, finest_level
from windswept.plants.plant import Plant
from windswept.scene.grow_kinds import grow_kinds
from windswept.scene.scene import Placements, Scene


@dataclass(frozen=True, slots=True)
class GrownKind:
    """One plant with its constants of motion, and its P placements."""

    plant: Plant
    model: Model
    ladder: Ladder | None
    """None where every placement is simulated at level 0."""
    placements: Placements
    multibody: bool = False
    """Whether `multibody` moves those at level 0; a ladder says so itself."""

    @property
    def levels(self) -> tuple[Level, ...]:
        """Finest first."""
        if self.ladder is not None:
            return self.ladder.levels
        return (replace(finest_level(self.model), coupled=self.multibody),)

    @property
    def radius(self) -> float:
        """Of a ball round the root that holds the plant, m."""
        return float(np.linalg.norm(self.plant.link_tip, axis=1).max())


def grown_kinds(
    scene: Scene,
    levels: bool = False,
    say: Callable[[str], None] = lambda line: None,
    multibody: bool = False,
) -> list[GrownKind]:
    """Grows and compiles the kinds of a scene.

    Args:
        scene: what stands where.
        levels: whether plants far from the camera are simulated at coarser levels.
        say: told of each plant that is grown.
        multibody: whether `multibody` moves those at level 0; with levels it is the first of them, and errors are
            against it.
    """
    kinds = []
    for plant, placements in zip(grow_kinds(scene, say), scene.placements, strict=True):
        model = build_model(plant)
        ladder = measured_ladder(build_ladder(simplify(model), multibody)) if levels else None
        kinds.append(GrownKind(plant, model, ladder, placements, multibody))
    return kinds
