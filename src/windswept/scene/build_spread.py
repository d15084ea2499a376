"""From the spread table of a scene file to trees and colonies of underbrush."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.forms.words import nearest
from windswept.scene.area import Area
from windswept.scene.build_ground import build_nutrients
from windswept.scene.form import SceneForm
from windswept.scene.place_plants import build_area, check_on_ground
from windswept.scene.plant_sources import Nursery, find_source_or_underbrush
from windswept.scene.scene import PlantKind
from windswept.scene.spread.colony import Colony
from windswept.scene.spread.ecology import Ecology
from windswept.scene.spread.plot import Plot, build_plot
from windswept.scene.spread.population import Population
from windswept.scene.spread.spread import spread
from windswept.scene.spread.spread_form import SpreadForm, SpreadSpeciesForm
from windswept.scene.streams import named_stream
from windswept.scene.terrain import Terrain

Reals = NDArray[np.float64]
Ints = NDArray[np.int64]

PLACED_FOOT = 0.3
"""Radius of ground kept clear around a placed plant of a species that does not spread, m."""


@dataclass(frozen=True, slots=True)
class Sorts:
    """The S species of a spread, checked."""

    forms: list[SpreadSpeciesForm]
    sources: list[str]
    """As `grow_source` or the library of underbrush takes them."""
    is_tree: list[bool]

    def number_of(self, source: str) -> int:
        """Which species a source is; one past the last for a source that does not spread."""
        return self.sources.index(source) if source in self.sources else len(self.sources)


def build_spread(source: str, form: SceneForm, terrain: Terrain, nursery: Nursery) -> tuple[Colony, ...]:
    """Let a scene's plants spread around those that stand already.

    Args:
        source: the scene file, for error messages and paths.
        form: what it says.
        terrain: the ground.
        nursery: the plants that stand already; trees that come up are added to it.

    Returns:
        The underbrush that came up, a colony for each species of which there is any.

    Raises:
        InputError: unknown species or nutrients, points off the ground, or ground on which nothing comes up.
    """
    nutrients = build_nutrients(source, form.nutrient, terrain.size, form.seed)
    if form.spread is None:
        return ()
    sorts = _find_sorts(source, form.spread)
    area = None if form.spread.area is None else build_area(source, "spread.area", form.spread.area, terrain)
    plot = build_plot(terrain, nutrients, area)
    ecology = _build_ecology(source, sorts, [nutrient.name for nutrient in nutrients])
    placed = _placed_plants(sorts, nursery)
    points = _points(source, sorts, plot, area, form.seed, placed)
    rng = named_stream(form.seed, "spread")
    key = int(rng.integers(2**62))
    plants = spread(plot, ecology, points, placed, form.spread.rounds, form.spread.most, key)
    if plants.count == 0:
        expected = (
            f"ground, light and nutrients that suit a plant: none came up in {form.spread.rounds} rounds"
        )
        raise InputError(source, "spread", None, expected)
    return _hand_out(sorts, plants, terrain, nursery, form.seed, rng)


def _find_sorts(source: str, form: SpreadForm) -> Sorts:
    """Species with known sources and ranges the right way round."""
    found = []
    for number, sort in enumerate(form.species):
        place = f"spread.species[{number}]"
        found.append(find_source_or_underbrush(source, f"{place}.source", sort.source))
        for key in ("light", "slope_degrees", "ground_m"):
            low, high = getattr(sort, key)
            if low > high:
                raise InputError(source, f"{place}.{key}", [low, high], "the lower number first")
        if sort.spacing_m is not None and sort.spacing_m < 2.0 * sort.radius_m:
            expected = f"at least twice radius_m, {2.0 * sort.radius_m:g}"
            raise InputError(source, f"{place}.spacing_m", sort.spacing_m, expected)
    return Sorts(form.species, [name for name, _ in found], [is_tree for _, is_tree in found])


def _build_ecology(source: str, sorts: Sorts, nutrients: list[str]) -> Ecology:
    """The species' numbers, and after them those of plants that only stand in the way."""
    forms = sorts.forms
    foot = [form.radius_m for form in forms]
    own_spacing = [form.spacing_m or 2.0 * form.radius_m for form in forms]
    reach = [form.reach_m or 2.0 * form.radius_m for form in forms]
    size_v = [0.0 if tree else form.size_v for form, tree in zip(forms, sorts.is_tree, strict=True)]
    slope = np.tan(np.radians([form.slope_degrees for form in forms]))
    return Ecology(
        foot=np.array([*foot, PLACED_FOOT]),
        spacing=np.array([*own_spacing, 2.0 * PLACED_FOOT]),
        reach=np.array([*reach, PLACED_FOOT]),
        height=np.array([form.height_m for form in forms] + [0.0]),
        size_v=np.array([*size_v, 0.0]),
        need=np.concatenate([_needs(source, sorts, nutrients), np.zeros((1, len(nutrients)))]),
        shade=-np.log(1.0 - np.array([form.shade for form in forms] + [0.0])),
        light=np.array([form.light for form in forms] + [(0.0, 1.0)]),
        slope=np.concatenate([slope, [[0.0, np.inf]]]),
        ground=np.array([form.ground_m for form in forms] + [(-np.inf, np.inf)]),
        vigour=np.array([form.vigour for form in forms] + [1.0]),
        turnover=np.array([form.turnover for form in forms] + [0.0]),
        offspring=np.array([form.offspring for form in forms] + [0]),
        distance=np.array([form.distance_m for form in forms] + [1.0]),
        most=np.array([form.most for form in forms] + [0]),
    )


def _needs(source: str, sorts: Sorts, nutrients: list[str]) -> Reals:
    """(S, M) amounts of nutrients."""
    need = np.zeros((len(sorts.forms), len(nutrients)))
    for number, form in enumerate(sorts.forms):
        for which, wanted in enumerate(form.need):
            place = f"spread.species[{number}].need[{which}].nutrient"
            if wanted.nutrient not in nutrients:
                known = nearest(wanted.nutrient, nutrients) if nutrients else "there is none"
                raise InputError(source, place, wanted.nutrient, f"the name of a [[nutrient]]: {known}")
            column = nutrients.index(wanted.nutrient)
            if need[number, column] > 0.0:
                raise InputError(source, place, wanted.nutrient, "each nutrient once")
            need[number, column] = wanted.amount
    return need


def _points(
    source: str, sorts: Sorts, plot: Plot, area: Area | None, seed: int, placed: Population
) -> Population:
    """The propagation points of all species."""
    species, places = [], []
    for number, form in enumerate(sorts.forms):
        for which, point in enumerate(form.points):
            place = f"spread.species[{number}].points[{which}]"
            check_on_ground(source, place, list(point), plot.terrain)
        if not (form.points or form.random_points or np.any(placed.species == number)):
            expected = "at least one, or random_points, or a [[plant]] of this source"
            raise InputError(source, f"spread.species[{number}].points", None, expected)
        rng = named_stream(seed, f"spread points {form.source}", number)
        anywhere = _anywhere(plot, area, form.random_points, rng)
        places.append(np.concatenate([np.reshape(form.points, (-1, 2)), anywhere]))
        species += [number] * len(places[-1])
    return _grown(np.array(species, np.int32), np.concatenate(places), placed=False)


def _anywhere(plot: Plot, area: Area | None, count: int, rng: np.random.Generator) -> Reals:
    """(count, 2) places on the plot."""
    if area is None:
        return rng.uniform(plot.low, plot.high, (count, 2))
    found = np.zeros((0, 2))
    while len(found) < count:
        darts = rng.uniform(plot.low, plot.high, (max(count, 256), 2))
        found = np.concatenate([found, darts[area.contains(darts)]])
    return found[:count]


def _placed_plants(sorts: Sorts, nursery: Nursery) -> Population:
    """Plants that a person placed: of a species that spreads, or of the last one, which does not."""
    species, places = [], []
    for kind, stands in nursery.places.items():
        species += [sorts.number_of(kind.source)] * len(stands)
        places += stands
    for source, tufts in nursery.tufts.items():
        species += [sorts.number_of(source)] * len(tufts)
        places += [(x, y) for x, y, _ in tufts]
    return _grown(np.array(species, np.int32), np.reshape(places, (-1, 2)), placed=True)


def _grown(species: NDArray[np.int32], places: Reals, placed: bool) -> Population:
    """Plants of size 1."""
    x, y = places.astype(np.float32).T
    count = len(species)
    return Population(species, x, y, np.ones(count, np.float32), np.full(count, placed))


def _hand_out(
    sorts: Sorts, plants: Population, terrain: Terrain, nursery: Nursery, seed: int, rng: np.random.Generator
) -> tuple[Colony, ...]:
    """Trees to the nursery; the underbrush as colonies."""
    colonies = []
    for number, (form, name, is_tree) in enumerate(
        zip(sorts.forms, sorts.sources, sorts.is_tree, strict=True)
    ):
        mine = plants.only(plants.species == number)
        if is_tree:
            kinds = [PlantKind(name, seed + individual) for individual in range(form.individuals)]
            nursery.add_shared(kinds, np.stack([mine.x, mine.y], axis=1).astype(np.float64), rng)
        elif mine.count:
            height = terrain.height(mine.x, mine.y)
            position = np.stack([mine.x, mine.y, height], axis=1).astype(np.float32)
            yaw = rng.uniform(0.0, 2.0 * math.pi, mine.count).astype(np.float32)
            colonies.append(Colony(name, position, yaw, mine.size))
    return tuple(colonies)
