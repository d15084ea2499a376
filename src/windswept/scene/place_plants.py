"""From the plant and stand tables of a scene file to kinds and placements."""

from __future__ import annotations

import math

import numpy as np

from windswept.errors import BudgetError, InputError
from windswept.scene.area import Area, ellipse, rectangle
from windswept.scene.form import SceneForm
from windswept.scene.plant_sources import Nursery, find_source_or_underbrush
from windswept.scene.planting_form import AreaForm, PlantForm, StandForm
from windswept.scene.scatter import Ground, Sort, scatter, share_out
from windswept.scene.scene import Placements, PlantKind
from windswept.scene.streams import named_stream
from windswept.scene.terrain import Terrain

PLACEMENT_BUDGET = 50_000
"""Most plants that one scene file may place; larger landscapes are baked tile by tile."""


def place_plants(source: str, form: SceneForm, terrain: Terrain) -> Nursery:
    """Every plant and stand of a scene in its place; stands keep clear of what was placed before them.

    Args:
        source: the scene file, for error messages.
        form: what it says.
        terrain: the ground.

    Raises:
        InputError: unknown species, a place off the ground, or a stand in which not all plants fit.
        BudgetError: more plants than PLACEMENT_BUDGET.
    """
    _check_budget(source, form)
    nursery = Nursery()
    ground = Ground()
    for i, plant in enumerate(form.plant):
        _place_one(source, f"plant[{i}]", plant, terrain, ground, nursery)
    for i, stand in enumerate(form.stand):
        rng = named_stream(form.seed, "stand", i)
        _place_stand(source, f"stand[{i}]", stand, form.seed, terrain, ground, nursery, rng)
    return nursery


def _check_budget(source: str, form: SceneForm) -> None:
    """There is something to place and not too much of it."""
    counts = [stand.count for stand in form.stand]
    total = len(form.plant) + sum(counts)
    if total == 0 and form.spread is None:
        raise InputError(source, "", None, "at least one [[plant]] or [[stand]], or a [spread]")
    if total > PLACEMENT_BUDGET:
        largest = f"stand[{int(np.argmax(counts))}].count" if counts else "the number of [[plant]] tables"
        raise BudgetError(f"{source}: {total:,} plants, at most {PLACEMENT_BUDGET:,}: lower {largest}")


def _place_one(
    source: str, place: str, form: PlantForm, terrain: Terrain, ground: Ground, nursery: Nursery
) -> None:
    """One [[plant]]."""
    x, y = form.position
    check_on_ground(source, f"{place}.position", list(form.position), terrain)
    name, is_tree = find_source_or_underbrush(source, f"{place}.source", form.source)
    yaw = math.radians(form.yaw_degrees)
    ground.take(x, y, 0.0)
    if is_tree:
        nursery.add(PlantKind(name, form.seed), x, y, yaw)
    else:
        nursery.add_tufts(name, np.array([[x, y]]), np.array([yaw]))


def _place_stand(
    source: str,
    place: str,
    form: StandForm,
    seed: int,
    terrain: Terrain,
    ground: Ground,
    nursery: Nursery,
    rng: np.random.Generator,
) -> None:
    """One [[stand]]: its plants shared out by weight, scattered, and given to a few individuals."""
    sources = [
        find_source_or_underbrush(source, f"{place}.source[{i}].source", s.source)
        for i, s in enumerate(form.source)
    ]
    area = build_area(source, f"{place}.area", form.area, terrain)
    counts = share_out(form.count, [sort.weight for sort in form.source])
    sorts = [Sort(n, s.spacing_m, s.depth_bias) for n, s in zip(counts, form.source, strict=True)]
    into = None if form.deeper_degrees is None else math.radians(form.deeper_degrees)
    found = scatter(area, sorts, ground, rng, into)
    if sum(map(len, found)) < form.count:
        most = _most_that_fit(form, [len(places) for places in found])
        expected = f"at most {most}, as no more fit: lower it or spacing_m, or enlarge the area"
        raise InputError(source, f"{place}.count", form.count, expected)
    for (name, is_tree), places in zip(sources, found, strict=True):
        if is_tree:
            nursery.add_shared([PlantKind(name, seed + i) for i in range(form.individuals)], places, rng)
        elif len(places):
            nursery.add_tufts(name, places, rng.uniform(0.0, 2.0 * math.pi, len(places)))


def _most_that_fit(form: StandForm, fitted: list[int]) -> int:
    """Largest count of which no source's share is more than what fitted of it."""
    weights = [sort.weight for sort in form.source]
    for count in range(sum(fitted), 0, -1):
        if all(share <= fit for share, fit in zip(share_out(count, weights), fitted, strict=True)):
            return count
    return 0


def build_area(source: str, place: str, form: AreaForm, terrain: Terrain) -> Area:
    """The area of a stand.

    Raises:
        InputError: not exactly one shape, a shape without an inside, or one that leaves the ground.
    """
    given = [name for name in AreaForm.model_fields if getattr(form, name) is not None]
    if len(given) != 1:
        raise InputError(source, place, given, f"exactly one of {', '.join(AreaForm.model_fields)}")
    key, value = f"{place}.{given[0]}", getattr(form, given[0])
    if form.rectangle is not None:
        west, south, east, north = form.rectangle
        if not (east > west and north > south):
            raise InputError(source, key, list(value), "west below east and south below north")
        area = rectangle(west, south, east, north)
    elif form.ellipse is not None:
        if not min(form.ellipse[2:]) > 0.0:
            raise InputError(source, key, list(value), "radii above 0")
        area = ellipse(*form.ellipse)
    else:
        area = Area(np.array(form.polygon, dtype=np.float64))
    if not area.greatest_depth > 0.0:
        raise InputError(source, key, None, "corners around a piece of ground")
    for corner in area.bounds:
        check_on_ground(source, key, corner.tolist(), terrain)
    return area


def check_on_ground(source: str, place: str, position: list[float], terrain: Terrain) -> None:
    """A place lies on the terrain."""
    half = 0.5 * terrain.size
    if max(map(abs, position)) > half:
        expected = f"x and y from {-half:g} to {half:g}, on the ground (ground.size_m = {terrain.size:g})"
        raise InputError(source, place, position, expected)


def build_placements(source: str, nursery: Nursery, terrain: Terrain) -> tuple[Placements, ...]:
    """Placements of every kind, on the ground.

    Args:
        source: the scene file, for error messages.
        nursery: all plants of the scene.
        terrain: the ground.

    Raises:
        BudgetError: more plants than PLACEMENT_BUDGET.
    """
    total = sum(map(len, nursery.places.values()))
    if total > PLACEMENT_BUDGET:
        raise BudgetError(
            f"{source}: {total:,} plants, at most {PLACEMENT_BUDGET:,}: lower most of spread.species"
        )
    return tuple(_placements(nursery, kind, terrain) for kind in nursery.places)


def _placements(nursery: Nursery, kind: PlantKind, terrain: Terrain) -> Placements:
    """Placements of one kind, on the ground."""
    x, y = np.array(nursery.places[kind]).T
    position = np.stack([x, y, terrain.height(x, y)], axis=1).astype(np.float32)
    return Placements(position=position, yaw=np.array(nursery.yaws[kind], dtype=np.float32))
