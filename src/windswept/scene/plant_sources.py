"""Which plant a scene file's source means, and which individuals of it are grown."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.forms.read_toml import read_toml
from windswept.forms.words import nearest
from windswept.plants.sources import SPECIES_ENDING, check_source, is_path, source_names
from windswept.plants.species import LARGEST_FILE, load_species
from windswept.plants.underbrush.library import load_underbrush, underbrush_names
from windswept.scene.scene import PlantKind
from windswept.scene.spread.colony import Colony
from windswept.scene.terrain import Terrain

Reals = NDArray[np.float64]


def find_source(file: str, place: str, source: str) -> str:
    """A source as `grow_source` takes it, that means a species, a grammar or a file that is there.

    Args:
        file: the scene file.
        place: dotted key of the source.
        source: its value; a path is relative to the scene file.

    Raises:
        InputError: no such name or file, or the species file is wrong.
    """
    if not is_path(source):
        if source not in source_names():
            known = nearest(source, source_names())
            raise InputError(file, place, source, f"a built-in species or grammar, or a file: {known}")
        return source
    path = Path(file).parent / source
    if not path.is_file():
        expected = "a file, not a folder" if path.is_dir() else f"a file that exists (looked for {path})"
        raise InputError(file, place, source, expected)
    check_source(path)
    if path.suffix.lower() == SPECIES_ENDING:
        load_species(path)
    return str(path)


def find_source_or_underbrush(file: str, place: str, source: str) -> tuple[str, bool]:
    """As `find_source`, also for underbrush; and whether it is a tree (anything that `grow_source` takes).

    Args:
        file: the scene file.
        place: dotted key of the source.
        source: its value; a path is relative to the scene file.

    Raises:
        InputError: no such name or file, or the species file is wrong.
    """
    if not is_path(source):
        if source in underbrush_names():
            return source, False
        if source not in source_names():
            known = nearest(source, [*underbrush_names(), *source_names()])
            expected = f"a built-in species, underbrush or grammar, or a file: {known}"
            raise InputError(file, place, source, expected)
        return source, True
    path = Path(file).parent / source
    if path.suffix.lower() == SPECIES_ENDING and path.is_file() and is_underbrush_file(path):
        load_underbrush(path)
        return str(path), False
    return find_source(file, place, source), True


def is_underbrush_file(path: Path) -> bool:
    """Whether a species file says that it is one of underbrush."""
    return read_toml(path, LARGEST_FILE, "a species file").get("kind") == "underbrush"


@dataclass
class Nursery:
    """Collects where the plants of every kind stand, in the order in which kinds come up."""

    yaws: dict[PlantKind, list[float]] = field(default_factory=dict)
    """Radians."""
    places: dict[PlantKind, list[tuple[float, float]]] = field(default_factory=dict)
    """x and y, m."""
    tufts: dict[str, list[tuple[float, float, float]]] = field(default_factory=dict)
    """x and y, m, and yaw, radians, of the underbrush of every source."""

    def add(self, kind: PlantKind, x: float, y: float, yaw: float) -> None:
        """Put one plant in its place."""
        self.places.setdefault(kind, []).append((x, y))
        self.yaws.setdefault(kind, []).append(yaw)

    def add_shared(self, kinds: list[PlantKind], places: Reals, rng: np.random.Generator) -> None:
        """Put (n, 2) places under plants that share a few individuals evenly, each turned at random."""
        which = rng.permutation(len(places)) % len(kinds)
        yaws = rng.uniform(0.0, 2.0 * np.pi, len(places))
        for (x, y), individual, yaw in zip(places.tolist(), which, yaws.tolist(), strict=True):
            self.add(kinds[individual], x, y, yaw)

    def add_tufts(self, source: str, places: Reals, yaws: Reals) -> None:
        """Put tufts of a species of underbrush on (n, 2) places, turned by (n,) radians."""
        rows = np.column_stack([places, yaws]).tolist()
        self.tufts.setdefault(source, []).extend((x, y, yaw) for x, y, yaw in rows)

    def colonies(self, terrain: Terrain) -> tuple[Colony, ...]:
        """The underbrush that a person placed, a colony for each source, all of size 1."""
        return tuple(_colony(source, np.array(rows), terrain) for source, rows in self.tufts.items())


def _colony(source: str, rows: Reals, terrain: Terrain) -> Colony:
    """Tufts on the ground at (n, 3) rows of x, y and yaw."""
    x, y, yaw = rows.T
    position = np.stack([x, y, terrain.height(x, y)], axis=1).astype(np.float32)
    return Colony(source, position, yaw.astype(np.float32), np.ones(len(rows), np.float32))
