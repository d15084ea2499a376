"""The same stand of plants simulated on the CPU and on the card."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from windswept.gpu import layouts
from windswept.gpu.springs.kinds import GrownKind
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.levels import Eye, Ladder
from windswept.plants.plant import Material, Plant
from windswept.scene.level_set import LevelSet
from windswept.scene.load_scene import load_scene
from windswept.scene.moving_kind import MovingKind
from windswept.scene.scene import Placements, PlantKind, Scene
from windswept.scene.simulation import Simulation
from windswept.wind.field import start_field
from windswept.wind.gusts import Gust

SOFT = Material(damping_ratio=0.2, youngs_modulus=2e8)


def stand_of(plants: list[Plant], counts: list[int], depth: float = 40.0) -> Scene:
    """Placements of each plant one behind the other, in turbulent wind with gusts that pass."""
    rng = np.random.default_rng(0)
    placements = []
    for count in counts:
        position = np.zeros((count, 3), np.float32)
        position[:, 0], position[:, 1] = rng.uniform(-6.0, 6.0, count), np.linspace(0.0, depth, count)
        placements.append(Placements(position, rng.uniform(0.0, 6.0, count).astype(np.float32)))
    scene = load_scene("hazel")
    gusts = tuple(Gust(start, 7.0, azimuth=0.4, width=80.0) for start in (0.5, 4.0, 7.0))
    return replace(
        scene,
        wind=replace(scene.wind, gusts=gusts),
        kinds=tuple(PlantKind("handmade", k) for k in range(len(plants))),
        placements=tuple(placements),
    )


def both(
    scene: Scene, ladders: list[Ladder], plants: list[Plant], card: type[GpuSimulation] = GpuSimulation
) -> tuple[Simulation, GpuSimulation]:
    """The same scene on the CPU and on the card, each kind on the levels of its ladder."""
    simulation = Simulation(scene, plants, picture_height=1080)
    simulation.kinds = [
        MovingKind(plant, placements, scene.terrain, True, ladder)
        for plant, placements, ladder in zip(plants, scene.placements, ladders, strict=True)
    ]
    simulation.change_levels(at_once=True)
    if scene.field is not None:
        simulation.field = start_field(scene.field, scene.wind)
    simulation._sample_winds()
    return simulation, card(scene, kinds_of(simulation), picture_height=1080)


def kinds_of(simulation: Simulation) -> list[GrownKind]:
    """The kinds of a simulation on the CPU, with the ladders that it has built."""
    return [GrownKind(kind.plant, kind.model, kind.ladder, kind.placements) for kind in simulation.kinds]


def only(ladder: Ladder, place: int) -> Ladder:
    """The ladder with one level that every eye asks for."""
    return replace(ladder, error=np.where(np.arange(len(ladder.levels)) <= place, 0.0, np.inf))


def gaps(simulation: Simulation, card: GpuSimulation) -> np.ndarray:
    """(K,) greatest distance between a link of both, in heights of the plant, kind by kind."""
    return np.array(
        [
            np.abs(ours.position - theirs.position).max() / kind.plant.height
            for kind, theirs, ours in zip(simulation.kinds, simulation.pose, card.pose, strict=True)
        ]
    )


def winds_on_card(card: GpuSimulation, rung: int) -> np.ndarray:
    """(P, B, 2, 4) what the card holds of the wind at one rung."""
    row = card._arrays.rungs[rung]
    probes, room = int(row["probes"][1]), int(row["room"][3])
    count = room * probes * 2
    rows = card.card.read("wind", "<f4", 4 * int(row["room"][2]), 4 * count)
    width = min(room, layouts.LANES)
    by_lane = rows.reshape(room // width, probes, 2, width, 4)
    members = int(card.card.read("populations", "<u4")[rung])
    return by_lane.transpose(0, 3, 1, 2, 4).reshape(room, probes, 2, 4)[:members]


def winds_of_cpu(level_set: LevelSet) -> np.ndarray:
    """(P, B, 2, 3) what a set on the CPU holds of it."""
    assert level_set.winds is not None
    return np.stack(level_set.winds, axis=2)


def eye_at(y: float) -> Eye:
    """Who looks all round from a place in front of the stand, or in it."""
    return Eye(np.array([0.0, y, 2.0], np.float32), float(np.radians(60.0)), 1080)


def fly(
    simulation: Simulation, card: GpuSimulation, ways: Iterable[float | Eye], seconds: float = 1.0 / 30.0
) -> Iterator[None]:
    """Moves both eyes along y and lets time pass; yields at every place."""
    for where in ways:
        simulation.eye = card.eye = where if isinstance(where, Eye) else eye_at(where)
        simulation.advance(seconds)
        card.advance(seconds)
        yield


def blending(card: GpuSimulation) -> int:
    """Placements that are on their way from one level to another."""
    return int((card.card.read("motions", layouts.MOTION)["origin"][:, 0] != layouts.NONE).sum())


def come_near(card: GpuSimulation) -> None:
    """Lets an eye look at the stand from within until plants find no more room; who finds none stays and is counted."""
    rooms = card._arrays.rungs["room"][:, 3]
    card.eye = eye_at(20.0)
    for _ in range(8):
        card.advance(0.2)
        check_seats(card)
        assert (card.card.read("populations", "<u4") <= rooms).all()
    assert card.refused_count > 0
    assert np.isfinite(card.pose[0].position).all()


def check_seats(card: GpuSimulation) -> None:
    """Every placement stands in the slots that it knows of, and no slot is taken twice or left open."""
    motions = card.card.read("motions", layouts.MOTION)
    members, populations = card.card.read("members", "<u4"), card.card.read("populations", "<u4")
    seats = 0
    for field in ("at", "origin"):
        for placement, (rung, slot) in enumerate(motions[field][:, :2]):
            if rung != layouts.NONE:
                seats += 1
                assert slot < populations[rung]
                assert members[card._arrays.rungs["probes"][rung, 3] + slot] == placement
    assert seats == populations.sum()
