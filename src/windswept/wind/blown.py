"""blown: a wind made stronger or weaker, and turned."""

from __future__ import annotations

import math
from dataclasses import replace

from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind
from windswept.wind.waves import Waves, WaveSchedule, WaveSet
from windswept.wind.wind import Wind


def blown(wind: Wind, speed: float, azimuth: float) -> Wind:
    """The same wind with another mean: waves and gusts grow in proportion and turn with it about the origin.

    Crests and fronts travel as fast as before, so that nothing jumps while a slider moves. In a wind without a
    mean, waves and gusts keep their strength, since there is nothing to measure them by.

    Args:
        wind: any.
        speed: new mean speed at the reference height, m/s; 0 is exactly calm unless the mean was 0 before.
        azimuth: where the air goes to, radians counter-clockwise from +x.
    """
    share = speed / wind.mean.speed if wind.mean.speed > 0.0 else 1.0
    turn = azimuth - wind.mean.azimuth
    return replace(
        wind,
        mean=MeanWind(speed, azimuth),
        waves=WaveSchedule(tuple(_blown_set(waves, share, turn) for waves in wind.waves.sets)),
        gusts=tuple(_blown_gust(gust, share, turn) for gust in wind.gusts),
    )


def _blown_set(wave_set: WaveSet, share: float, turn: float) -> WaveSet:
    waves: Waves = wave_set.waves
    blown_waves = replace(
        waves, travel=waves.travel + turn, push=waves.push + turn, amplitude=share * waves.amplitude
    )
    return replace(wave_set, waves=blown_waves)


def _blown_gust(gust: Gust, share: float, turn: float) -> Gust:
    x, y = gust.position
    cosine, sine = math.cos(turn), math.sin(turn)
    place = (cosine * x - sine * y, sine * x + cosine * y)
    return replace(gust, strength=share * gust.strength, azimuth=gust.azimuth + turn, position=place)
