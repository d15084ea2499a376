"""Parity of the wind: what the card samples at every probe against ``wind_at_probes``."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from stands import both, only, stand_of, winds_of_cpu, winds_on_card
from windswept.plants.air import reconfiguration
from windswept.scene.terrain import hilly_terrain
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind, Profile
from windswept.wind.waves import AS_PRINTED, Waves, WaveSchedule, WaveSet
from windswept.wind.wind import Wind, calm


def waves(form: str, power: tuple[float, ...]) -> Waves:
    count = len(power)
    return Waves(
        travel=np.linspace(-1.0, 2.0, count),
        push=np.linspace(0.5, -2.0, count),
        wavelength=np.geomspace(7.0, 70.0, count),
        speed=np.linspace(4.0, 9.0, count),
        amplitude=np.linspace(0.5, 2.5, count),
        power=np.array(power),
        phase=np.linspace(0.0, 5.0, count),
        form=form,
    )


WINDS = {
    "steady": Wind(Profile(roughness=0.5, displacement=0.6), MeanWind(7.0, 0.4)),
    "waves": Wind(waves=WaveSchedule((WaveSet(waves("corrected", (1.0, 2.0, 3.0, 2.5))),))),
    "printed": Wind(waves=WaveSchedule((WaveSet(waves(AS_PRINTED, (1.0, 3.0, 4.0))),))),
    "fading": Wind(waves=WaveSchedule((WaveSet(waves("corrected", (1.0, 2.0)), end=1.0, fade=0.98),))),
    "gusts": Wind(gusts=(Gust(-1.0, 6.0, 0.3, width=30.0), Gust(-2.0, 3.0, hold_length=np.inf))),
}


@pytest.mark.parametrize("name", WINDS)
@pytest.mark.parametrize("time", [0.0, 3600.0])
def test_the_card_samples_the_same_wind(soft_trees, soft_ladders, name, time):
    terrain = hilly_terrain(300.0, 12.0, 60.0, np.random.default_rng(2))
    stand = stand_of(soft_trees[:1], [70], depth=120.0)
    shift = np.array([time * 1e-3, 0.0, 0.0], np.float32)
    placements = replace(stand.placements[0], position=stand.placements[0].position + shift)
    scene = replace(stand, wind=WINDS[name], terrain=terrain, placements=(placements,))
    simulation, card = both(scene, [only(soft_ladders[0], 2)], soft_trees[:1])
    simulation.step_count = card.step_count = round(120.0 * time)
    simulation._sample_winds()
    card._write_wind()
    card._record(card._walk.sample_wind)
    expected = winds_of_cpu(simulation.kinds[0].sets[2])
    actual = winds_on_card(card, 2)
    assert expected.any() == (name != "fading" or time == 0.0) or name == "gusts"
    np.testing.assert_allclose(actual[..., :3], expected, atol=1e-4)
    folded = reconfiguration(soft_trees[0].material, np.linalg.norm(expected, axis=3))
    np.testing.assert_allclose(actual[..., 3], folded, atol=1e-4)


def test_calm_air_stands_exactly_still_on_the_card(soft_trees, soft_ladders):
    scene = replace(stand_of(soft_trees, [3, 2]), wind=calm())
    card = both(scene, soft_ladders, soft_trees)[1].advance(1.0)
    assert not card.card.read("state", "<f4").any()
    assert not card.wind_speeds[0].any()


def test_crowns_know_the_speed_of_their_wind(soft_trees, soft_ladders):
    simulation, card = both(stand_of(soft_trees, [3, 66]), soft_ladders, soft_trees)
    for expected, actual in zip(simulation.wind_speeds, card.wind_speeds, strict=True):
        assert expected.min() > 0.1
        np.testing.assert_allclose(actual, expected, atol=1e-4)
