"""Levels of both motion models on one ladder on the card, beside the CPU's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from stands import blending, both, check_seats, come_near, eye_at, fly, gaps, kinds_of, only, stand_of
from windswept.errors import GraphicsError
from windswept.gpu import layouts
from windswept.gpu.multibody import walk
from windswept.gpu.multibody.simulation import CoupledSimulation
from windswept.gpu.springs import turns
from windswept.levels import Ladder, measured_ladder
from windswept.motion.multibody import link_velocities


def with_a_whole_plant_coupled(ladder: Ladder) -> Ladder:
    """The ladder with its coarsest group that swings, which stands on the ground, as a level of `multibody`."""
    place = ladder.merged(coupled=False)[-1]
    assert ladder.levels[place].link_count == 0
    levels = list(ladder.levels)
    levels[place] = replace(levels[place], coupled=True)
    return replace(ladder, levels=tuple(levels))


def shortened(ladder: Ladder) -> Ladder:
    """All links coupled, and merged levels of springs."""
    places = [0, int(ladder.merged(coupled=False)[0])]
    return replace(
        ladder,
        levels=tuple(ladder.levels[place] for place in places),
        error=np.array([0.0, 0.05]),
        tolerance=ladder.tolerance[places],
    )


def test_ten_gusty_seconds_at_every_level(soft_trees, coupled_ladders):
    tree, ladder = soft_trees[0], coupled_ladders[0]
    ladders = [only(ladder, place) for place in range(len(ladder.levels))]
    whole = with_a_whole_plant_coupled(ladder)
    ladders.append(only(whole, int(whole.merged(coupled=True)[-1])))
    count = len(ladders)
    simulation, card = both(stand_of([tree] * count, [2] * count), ladders, [tree] * count, CoupledSimulation)
    worst, far = np.zeros(count), np.zeros(count)
    for _ in range(10):
        worst = np.maximum(worst, gaps(simulation.advance(1.0), card.advance(1.0)))
        far = np.maximum(far, [np.abs(pose.position - tree.link_base).max() for pose in simulation.pose])
    assert [kind.at.tolist() for kind in simulation.kinds] == [levels.tolist() for levels in card.levels_now]
    still = len(ladder.levels) - 1
    assert np.delete(far, still).min() > 0.02 * tree.height
    assert far[still] < 1e-6
    # Single precision, added up in another order; asked are 1e-3.
    assert worst.max() < 5e-6


def test_a_storm_pulls_merged_branches_as_on_the_cpu(soft_trees, coupled_ladders):
    # Where the air's pull on groups is what holds their carriers: without it 1e-5 to 5e-5.
    tree, ladder = soft_trees[1], coupled_ladders[1]
    ladders = [only(ladder, int(place)) for place in ladder.merged(coupled=True)]
    count = len(ladders)
    scene = stand_of([tree] * count, [2] * count)
    scene = replace(scene, wind=replace(scene.wind, mean=replace(scene.wind.mean, speed=40.0)))
    simulation, card = both(scene, ladders, [tree] * count, CoupledSimulation)
    for _ in range(8):
        assert gaps(simulation.advance(0.25), card.advance(0.25)).max() < 2e-6


def test_plants_pass_between_the_models_as_on_the_cpu(soft_trees, coupled_ladders):
    simulation, card = both(stand_of(soft_trees, [30, 21]), coupled_ladders, soft_trees, CoupledSimulation)
    way = -2.0 - 60.0 * (1.0 - np.cos(np.arange(100) * 3.0 / 16.0))
    passed, worst = set(), []
    before = [kind.at.copy() for kind in simulation.kinds]
    for _ in fly(simulation, card, way, seconds=0.1):
        for kind, levels, last in zip(simulation.kinds, card.levels_now, before, strict=True):
            assert np.array_equal(kind.at, levels)
            named = [(s.level.coupled, s.level.group_count > 0) for s in kind.sets]
            passed |= {(named[a], named[b]) for a, b in zip(last, levels, strict=True) if a != b}
        assert blending(card) == sum(len(kind.blends) for kind in simulation.kinds)
        assert card.stepped_count == simulation.stepped_count
        before = [kind.at.copy() for kind in simulation.kinds]
        worst.append(gaps(simulation, card).max())
    check_seats(card)
    assert card.refused_count == 0
    links, merged, springs = (True, False), (True, True), (False, True)
    for one, other in ((links, merged), (merged, springs), (links, springs)):
        assert {(one, other), (other, one)} <= passed
    assert max(worst) < 2e-6


def test_links_that_join_carry_what_their_joints_say(soft_trees, coupled_ladders):
    ladders = [shortened(ladder) for ladder in coupled_ladders]
    # Two blocks, the second not full.
    _, card = both(stand_of(soft_trees, [90, 5]), ladders, soft_trees, CoupledSimulation)
    card.eye = eye_at(-4000.0)
    card.advance(2.0)
    assert all((levels == 1).all() for levels in card.levels_now)
    card.eye = replace(eye_at(0.0), tolerance=1e-9)
    card.card.write_moment(card._moment(0, 0))
    card._record(card._walk.change_levels)
    assert not any(levels.any() for levels in card.levels_now)
    for kind, state in zip(card.kinds, card.states, strict=True):
        for placement in range(state.placement_count):
            tile, lane = divmod(placement, 8)
            ours = state.carried[tile, :, :, lane]
            expected = link_velocities(kind.model, state.angles(placement), state.velocities(placement))
            assert np.abs(ours - expected).max() < 1e-5 * np.abs(expected).max()
            assert np.abs(expected).max() > 1e-2


def test_who_stays_keeps_what_its_links_carry(soft_trees, coupled_ladders):
    simulation, card = both(
        stand_of(soft_trees, [90, 40], depth=300.0), coupled_ladders, soft_trees, CoupledSimulation
    )
    coupled, rng = card._arrays.coupled, np.random.default_rng(4)
    at, shifted = card.card.read("motions", layouts.MOTION)["at"], 0
    for _ in fly(simulation, card, rng.uniform(-100.0, 300.0, 12), seconds=0.3):
        check_seats(card)
        assert card.stepped_count == simulation.stepped_count
        assert gaps(simulation, card).max() < 1e-5
        before, at = at, card.card.read("motions", layouts.MOTION)["at"]
        stayed = coupled[at[:, 0]] & (at[:, 0] == before[:, 0])
        shifted += int((at[stayed, 1] != before[stayed, 1]).sum())
    assert shifted > 10


def test_a_change_of_model_is_not_seen(soft_trees, coupled_ladders):
    # PHYSICS D2.2: the second difference of every link's place less the same where all links are coupled, in pixels.
    ladder = measured_ladder(coupled_ladders[1])
    tree, scene = soft_trees[1], stand_of(soft_trees[1:], [3], depth=2.0)
    simulation, card = both(scene, [ladder], [tree], CoupledSimulation)
    without = CoupledSimulation(
        scene, [replace(kinds_of(simulation)[0], ladder=None, multibody=True)], picture_height=1080
    )
    apart, pixels, coupled, merged = [], [], [], set()
    for frame in range(240):
        card.eye = eye_at(-3.0 - 150.0 * (1.0 - np.cos(2.0 * np.pi * frame / 240.0)))
        levels = card.advance(1.0 / 60.0).levels_now[0]
        apart.append(card.pose[0].position - without.advance(1.0 / 60.0).pose[0].position)
        distance = np.linalg.norm(scene.placements[0].position - card.eye.position, axis=1)
        pixels.append(card.eye.metres(distance))
        coupled.append([ladder.levels[level].coupled for level in levels])
        merged |= set(levels) & set(ladder.merged(coupled=True))
    assert merged
    joined = np.array(coupled)
    assert (joined[:-1] & ~joined[1:]).any(axis=0).all()
    assert (~joined[:-1] & joined[1:]).any(axis=0).all()
    jump = np.linalg.norm(np.diff(apart, n=2, axis=0), axis=-1) / np.array(pixels)[1:-1, :, None]
    assert np.percentile(jump, 99) < 0.25
    assert jump.max() < 1.0


def test_frame_rate_does_not_matter(soft_trees, coupled_ladders):
    ends = []
    for rate in (30, 144):
        card = both(stand_of(soft_trees, [5, 4]), coupled_ladders, soft_trees, CoupledSimulation)[1]
        card.eye = eye_at(-60.0)
        for frame in range(2 * rate):
            if frame == rate:
                card.eye = eye_at(0.0)
            card.advance(1.0 / rate)
        ends.append([card.card.read(name, "<f4").tobytes() for name in ("state", "carried")])
    assert ends[0] == ends[1]
    assert any(ends[0][1])


def test_who_finds_no_room_stays_and_is_counted(soft_trees, coupled_ladders):
    simulation, full = both(stand_of(soft_trees, [200, 40]), coupled_ladders, soft_trees, CoupledSimulation)
    # Less than the records of all would need, more than their joints do.
    room = 200 * 16 * 3 * soft_trees[0].link_count
    card = CoupledSimulation(simulation.scene, full.kinds, picture_height=1080, room=room)
    rooms = card._arrays.rungs["room"][:, 3]
    assert rooms[0] < 200 <= rooms[len(coupled_ladders[0].levels) - 1]
    assert max(card.bytes[name] for name in ("carried", "records", "slots")) <= room
    come_near(card)


def test_a_ladder_of_springs_alone_runs_too(soft_trees, coupled_ladders):
    springs = [
        replace(ladder, levels=tuple(replace(level, coupled=False) for level in ladder.levels))
        for ladder in coupled_ladders
    ]
    simulation, card = both(stand_of(soft_trees, [3, 2]), springs, soft_trees, CoupledSimulation)
    assert gaps(simulation.advance(1.0), card.advance(1.0)).max() < 5e-6


def test_levels_that_do_not_fit_are_said(soft_trees, coupled_ladders):
    simulation, _ = both(stand_of(soft_trees, [3, 2]), coupled_ladders, soft_trees, CoupledSimulation)
    with pytest.raises(GraphicsError, match=r"needs .* MB .* on the CPU"):
        CoupledSimulation(simulation.scene, kinds_of(simulation), room=1_000)


def test_a_merged_level_too_large_for_a_software_driver_is_said(soft_trees, coupled_ladders, monkeypatch):
    simulation, _ = both(stand_of(soft_trees, [3, 2]), coupled_ladders, soft_trees, CoupledSimulation)
    monkeypatch.setattr(turns, "is_software", lambda device: True)
    monkeypatch.setattr(walk, "LADEN_TURNS", 6000)
    with pytest.raises(GraphicsError, match=r"1\d links .* moves 10 at most: simulate on the CPU"):
        CoupledSimulation(simulation.scene, kinds_of(simulation))
    # A level without groups has no loop over them.
    finest = [replace(kind, ladder=None, multibody=True) for kind in kinds_of(simulation)]
    assert CoupledSimulation(simulation.scene, finest).advance(0.1).step_count == 12
