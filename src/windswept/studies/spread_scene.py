"""The scene of Endo et al. (2003), section 5.2, at any number of plants: the meadow of the examples, larger or smaller.

The paper fills its scene, 200 tufts, in less than 3 s.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import windswept.scene
from windswept.forms.read_toml import read_toml
from windswept.scene.form import SceneForm

MEADOW = Path(windswept.scene.__path__[0]) / "examples" / "meadow.toml"
DENSITY = 24.0
"""Plants on a square metre of the meadow once it is full."""
SMALLEST = 10.0
"""Edge of the smallest ground that a scene may have, m."""


def spread_scene(count: int) -> SceneForm:
    """The meadow on ground for so many plants, with as many propagation points to the hectare and no more plants."""
    data = read_toml(MEADOW, 1 << 20, "a scene file")
    size = max(math.sqrt(count / DENSITY), SMALLEST)
    share = (size / data["ground"]["size_m"]) ** 2
    species = [_at_share(one, share) for one in data["spread"]["species"]]
    changed: dict[str, Any] = {
        "ground": data["ground"] | {"size_m": size},
        "spread": data["spread"] | {"species": species, "most": count},
    }
    return SceneForm.model_validate(data | changed)


def _at_share(species: dict[str, Any], share: float) -> dict[str, Any]:
    """A species with its points and its most in proportion to the ground."""
    scaled = {key: max(round(species[key] * share), 1) for key in ("random_points", "most") if key in species}
    return species | scaled
