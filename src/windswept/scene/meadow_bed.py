"""Bed: the blades of one species of underbrush that stand in the same air at a like distance, and their motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.motion.blades import (
    BladeKind,
    Blades,
    BladeState,
    TuftPlaces,
    build_kind,
    plant_tufts,
    pose_blades,
    rest_blades,
)
from windswept.plants.underbrush import BladePose, Tuft, grow_tuft, load_underbrush
from windswept.plants.underbrush.thin_tuft import thin_tuft
from windswept.scene.sight import Sight
from windswept.scene.spread.colony import Colony
from windswept.scene.streams import named_stream
from windswept.scene.terrain import Terrain
from windswept.wind.field import Grid

INDIVIDUALS = 3
"""Different tufts that are grown of every species and shared by its places."""
NEAREST_BAND = 3.0
"""Nearer than this every blade stands for itself, m; each band beyond reaches twice as far as the one before."""
BLADE_PIXELS = 1.2
"""Farther away, so few blades stand for all that they are about so wide on the screen."""
STALK = 3.0
"""Width of a stalk that counts here over its own."""
FEWEST = 3.0
"""Blades of a kind that a thinned tuft keeps; to go below, tufts are left out and the others stand for them."""


@dataclass(frozen=True, slots=True)
class Bed:
    """The blades of one species, kind by kind in the order of its components."""

    source: str
    blades: tuple[Blades, ...]
    states: tuple[BladeState | None, ...]
    """One for each of ``blades``; None for a kind that no wind moves to speak of."""
    stands_for: tuple[float, ...]
    """How many blades of the species each blade of a kind stands for: it is drawn as much wider."""
    in_field: bool
    """Whether it stands in the scene's force field; otherwise it feels the wind alone."""

    @property
    def air(self) -> int:
        """Which of the fields of ``MeadowAir.sample`` it feels."""
        return int(self.in_field)

    @property
    def count(self) -> int:
        """Number of blades of all kinds."""
        return sum(blades.count for blades in self.blades)

    def pose(self, ahead: float) -> list[BladePose]:
        """Where every section of every blade is, kind by kind, ``ahead`` seconds after the last step."""
        poses: list[BladePose] = []
        for blades, state in zip(self.blades, self.states, strict=True):
            parents = None if blades.parent_kind < 0 else poses[blades.parent_kind]
            poses.append(pose_blades(blades, state, parents, ahead))
        return poses


@dataclass(frozen=True, slots=True)
class Ground:
    """What colonies are planted on, and how they will be seen."""

    terrain: Terrain
    field: Grid | None
    """Of the scene's force field; None where there is none."""
    sight: Sight
    seed: int
    """Of the first tuft of every species."""


def plant_beds(
    colonies: tuple[Colony, ...], ground: Ground, say: Callable[[str], None] = lambda line: None
) -> tuple[Bed, ...]:
    """The blades of all colonies, at rest.

    Args:
        colonies: where tufts stand.
        ground: what they stand on.
        say: told of every species before its tables are computed.

    Raises:
        InputError: a species file has gone or changed for the worse since it was named.
    """
    grown: dict[str, tuple[list[Tuft], list[BladeKind]]] = {}
    beds: list[Bed] = []
    for number, colony in enumerate(colonies):
        if colony.source not in grown:
            say(f"growing {colony.source}")
            species = load_underbrush(colony.source)
            tufts = [grow_tuft(species, ground.seed + individual) for individual in range(INDIVIDUALS)]
            grown[colony.source] = tufts, [build_kind(blade) for blade in tufts[0].kinds]
        chance = named_stream(ground.seed, "thinning", number).random(colony.count)
        inside = _covers(ground.field, colony)
        band = _bands(ground.sight.distance(colony.position))
        for which in np.unique(band).tolist():
            for members, in_field in (((band == which) & inside, True), ((band == which) & ~inside, False)):
                if members.any():
                    away = NEAREST_BAND * 2.0 ** (which - 1) if which else 0.0
                    beds += _plant_bed(colony, members, chance, *grown[colony.source], ground, away, in_field)
    return tuple(beds)


def _plant_bed(
    colony: Colony,
    members: NDArray[np.bool_],
    chance: NDArray[np.float64],
    tufts: Sequence[Tuft],
    kinds: Sequence[BladeKind],
    ground: Ground,
    away: float,
    in_field: bool,
) -> list[Bed]:
    """The (P,) members of a colony, seen from no nearer than ``away``; nothing where all are left out."""
    share = _shares(tufts, ground.sight.pixel * away)
    whole = np.array([[np.sum(tuft.blade_kind == kind) for kind in range(len(kinds))] for tuft in tufts])
    rooted = [kind for kind, blade in enumerate(tufts[0].kinds) if not blade.component.parent]
    stay = min(1.0, float((share * whole.mean(axis=0))[rooted].max()) / FEWEST)
    chosen = np.flatnonzero(members & (chance < stay))
    if len(chosen) == 0:
        return []
    thinned = [thin_tuft(tuft, np.minimum(share / stay, 1.0).tolist()) for tuft in tufts]
    left = np.array([[np.sum(tuft.blade_kind == kind) for kind in range(len(kinds))] for tuft in thinned])
    stands_for = whole.sum(axis=0) / np.maximum(left.sum(axis=0), 1) / stay
    blades = tuple(plant_tufts(thinned, kinds, _places(colony, chosen, ground.terrain)))
    states = tuple(None if one.kind.still else rest_blades(one) for one in blades)
    return [Bed(colony.source, blades, states, tuple(stands_for.tolist()), in_field)]


def _shares(tufts: Sequence[Tuft], pixel: float) -> NDArray[np.float64]:
    """(C,) share of the blades of every kind that suffices where a pixel is so large, m."""
    kinds = tufts[0].kinds
    share = np.ones(len(kinds))
    names = [blade.component.name for blade in kinds]
    for kind in range(len(kinds) - 1, -1, -1):
        component = kinds[kind].component
        least = max(BLADE_PIXELS * pixel, 1e-9)
        # A few thick stalks would look like posts: they stay thin, and more of them.
        width = 1e-3 * component.width_mm * (STALK if component.shape == "round" else 1.0)
        enough = min(width / least, 1.0) * min(1e-3 * component.length_mm / least, 1.0)
        carried = [share[k] for k in range(kind + 1, len(kinds)) if kinds[k].component.parent == names[kind]]
        share[kind] = max([enough, *carried])
    return share


def _places(colony: Colony, chosen: NDArray[np.intp], terrain: Terrain) -> TuftPlaces:
    """The tufts of some members of a colony; neighbours are different individuals."""
    position = colony.position[chosen]
    return TuftPlaces(
        tuft=chosen.astype(np.int32) % INDIVIDUALS,
        position=position,
        yaw=colony.yaw[chosen],
        normal=terrain.normal(position[:, 0], position[:, 1]).astype(np.float32),
        size=colony.size[chosen],
    )


def _bands(distance: NDArray[np.float32]) -> NDArray[np.int64]:
    """(P,) band of distances: 0 near, 1 up to twice NEAREST_BAND, 2 up to four times, and so on."""
    return np.maximum(np.floor(np.log2(np.maximum(distance, 1e-3) / NEAREST_BAND)) + 1.0, 0.0).astype(
        np.int64
    )


def _covers(field: Grid | None, colony: Colony) -> NDArray[np.bool_]:
    """(P,) which tufts stand inside the force field."""
    if field is None:
        return np.zeros(colony.count, np.bool_)
    low = np.array(field.origin)
    high = low + np.array(field.cell[:2]) * (np.array(field.shape[:2]) - 1)
    place = colony.position[:, :2]
    return np.asarray(np.all((place >= low) & (place <= high), axis=1))
