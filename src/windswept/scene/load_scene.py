"""load_scene: from a scene file, or anything that a plant can come from, to a Scene."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from windswept.errors import InputError
from windswept.forms.check_form import check_form
from windswept.forms.read_toml import read_toml
from windswept.forms.words import nearest, one_line, shown
from windswept.plants.sources import ENDINGS, SPECIES_ENDING, is_path, source_names
from windswept.plants.underbrush import underbrush_names
from windswept.scene.build_camera import build_camera
from windswept.scene.build_field import build_field
from windswept.scene.build_ground import build_terrain
from windswept.scene.build_spread import build_spread
from windswept.scene.build_wind import build_wind
from windswept.scene.form import SceneForm
from windswept.scene.lone_patch import lone_patch
from windswept.scene.lone_plant import lone_plant
from windswept.scene.place_plants import build_placements, place_plants
from windswept.scene.scene import Scene, sun_towards

LARGEST_FILE = 16 << 20
"""A scene file of more bytes than this is a mistake: 100,000 plants take 8 MiB."""
PLANT_ENDINGS = tuple(ending for ending in ENDINGS if ending != SPECIES_ENDING)
"""Of files that can only be plants; a .toml file may be a scene too."""


def load_scene(source: str | Path, seed: int | None = None) -> Scene:
    """Read a scene; the source of one plant means that plant on flat ground, that of underbrush a patch of it.

    Args:
        source: path of a scene file, anything that `grow_source` takes, or underbrush: a name or a .toml file.
        seed: replaces the scene file's seed, or is that of the lone plant; None keeps the file's, or 0.

    Raises:
        InputError: what is wrong, with file and dotted key.
        BudgetError: the scene holds more plants than its budget.
    """
    if not isinstance(source, str | Path):
        raise InputError(
            "load_scene", "source", shown(source), "the path of a scene file, or the name of a plant"
        )
    name = str(source)
    if not is_path(source):
        if source in underbrush_names():
            return lone_patch(name, seed or 0)
        known = source_names()
        if source not in known:
            hint = nearest(name, [*known, *underbrush_names()])
            raise InputError(
                one_line(name) or "scene", "", None, f"a scene file, or a plant's name or file: {hint}"
            )
        return lone_plant(name, seed or 0)
    if Path(source).suffix.lower() in PLANT_ENDINGS:
        return lone_plant(name, seed or 0)
    data = read_toml(Path(source), LARGEST_FILE, "a scene file")
    if "growth" in data:
        return lone_plant(name, seed or 0)
    if data.get("kind") == "underbrush":
        return lone_patch(name, seed or 0)
    return build_scene(name, data, seed)


def build_scene(source: str, data: dict[str, Any], seed: int | None = None) -> Scene:
    """The scene that the tables of a scene file say.

    Args:
        source: the scene file, for error messages and for paths relative to it.
        data: its tables.
        seed: replaces the file's.
    """
    form = check_form(source, SceneForm, data if seed is None else data | {"seed": seed})
    terrain = build_terrain(source, form.ground, form.seed)
    nursery = place_plants(source, form, terrain)
    colonies = build_spread(source, form, terrain, nursery)
    return Scene(
        seed=form.seed,
        terrain=terrain,
        wind=build_wind(source, form.wind, form.seed),
        kinds=tuple(nursery.places),
        placements=build_placements(source, nursery, terrain),
        camera=build_camera(source, form.camera, terrain),
        sun_direction=sun_towards(
            math.radians(form.sun.azimuth_degrees), math.radians(form.sun.elevation_degrees)
        ),
        duration=form.time.duration_s,
        frames_per_second=form.time.fps,
        colonies=nursery.colonies(terrain) + colonies,
        field=None if form.field is None else build_field(source, form.field, terrain.size, form.seed),
    )
