"""air_rows: the wind of a moment as the card reads it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.gpu import layouts
from windswept.gpu.springs.rows import Rows
from windswept.scene.terrain import Terrain
from windswept.wind.gusts import GUST_COLUMNS
from windswept.wind.velocity import wave_rows
from windswept.wind.wind import Wind


@dataclass(frozen=True, slots=True)
class AirRows:
    """The wind at both ends of an interval; nothing in it grows with the number of placements."""

    ends: Rows
    """(2,) ``AIR``"""
    waves: Rows
    """``WAVE``, first those of the start."""
    gusts: Rows
    """``GUST``, first those of the start."""


def air_rows(wind: Wind, terrain: Terrain, start: float, stop: float) -> AirRows:
    """The wind at two times, s.

    Phases and ways are taken in double precision here, so that hours do not wear out the card's single precision.
    """
    waves = [card_waves(wind, time) for time in (start, stop)]
    gusts = [card_gusts(wind, time) for time in (start, stop)]
    ends = np.zeros(2, layouts.AIR)
    profile = wind.profile
    last_cell = len(terrain.heights) - 2
    for end, row in enumerate(ends):
        row["profile"] = (
            profile.displacement,
            1.0 / profile.roughness,
            profile.join_height,
            profile.attenuation,
        )
        row["mean"] = *wind.mean.vector, 1.0 / profile.log_reference, 0.0
        row["ground"] = 1.0 / terrain.spacing, 0.5 * (last_cell + 1), last_cell, 0.0
        row["sources"] = end * len(waves[0]), len(waves[end]), end * len(gusts[0]), len(gusts[end])
    return AirRows(ends, np.concatenate(waves), np.concatenate(gusts))


def card_waves(wind: Wind, time: float) -> Rows:
    """``WAVE`` rows of the waves that blow at a time, s."""
    turns_x, turns_y, turns, push_x, push_y, bias, power, mean = wave_rows(wind, time).T
    rows = np.zeros(len(turns), layouts.WAVE)
    rows["phase"] = np.stack([turns_x, turns_y, turns, bias], axis=1)
    rows["push"] = np.stack([push_x, push_y, power, mean], axis=1)
    return rows


def card_gusts(wind: Wind, time: float) -> Rows:
    """``GUST`` rows of all gusts at a time, s."""
    column = dict(zip(GUST_COLUMNS, wind.gust_rows.T, strict=True))
    rows = np.zeros(len(wind.gust_rows), layouts.GUST)
    place = ("position_x", "position_y", "direction_x", "direction_y")
    rows["place"] = np.stack([column[name] for name in place], axis=1)
    way = column["speed"] * (time - column["start"])
    rows["shape"] = np.stack([way, *(column[n] for n in ("strength", "per_rise", "decay_start"))], axis=1)
    rows["fade"][:, 0], rows["fade"][:, 1] = column["per_decay"], column["per_width"]
    return rows
