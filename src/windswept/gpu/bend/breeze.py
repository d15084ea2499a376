"""Wind -> Breeze: what blows at one moment, as the card reads it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.gpu.bend import layouts
from windswept.wind.gusts import GUST_COLUMNS
from windswept.wind.velocity import wave_rows
from windswept.wind.wind import Wind


def breeze(wind: Wind, time: float) -> NDArray[np.void]:
    """(1,) ``BREEZE`` of the sources that blow at a time, s; waves that are faded out are left out.

    Phases and ways are taken in double precision here, so that hours do not wear out the card's single precision.

    Raises:
        InputError: more than WAVE_LIMIT waves or GUST_LIMIT gusts blow at once.
    """
    waves, gusts = wave_rows(wind, time), wind.gust_rows
    if len(waves) > layouts.WAVE_LIMIT:
        raise InputError("wind", "waves", len(waves), f"at most {layouts.WAVE_LIMIT} that blow at one time")
    if len(gusts) > layouts.GUST_LIMIT:
        raise InputError("wind", "gusts", len(gusts), f"at most {layouts.GUST_LIMIT}")
    row = np.zeros(1, layouts.BREEZE)
    row["mean"][:, :2] = wind.mean.vector
    row["counts"][:, :2] = len(waves), len(gusts)
    turns_x, turns_y, turns, push_x, push_y, bias, power, mean = waves.T
    row["waves"]["phase"][0, : len(waves)] = np.stack([turns_x, turns_y, turns, bias], axis=1)
    row["waves"]["push"][0, : len(waves)] = np.stack([push_x, push_y, power, mean], axis=1)
    column = dict(zip(GUST_COLUMNS, gusts.T, strict=True))
    place = ("position_x", "position_y", "direction_x", "direction_y")
    row["gusts"]["place"][0, : len(gusts)] = np.stack([column[name] for name in place], axis=1)
    way = column["speed"] * (time - column["start"])
    shape = (way, column["strength"], column["per_rise"], column["decay_start"])
    row["gusts"]["shape"][0, : len(gusts)] = np.stack(shape, axis=1)
    row["gusts"]["fade"][0, : len(gusts), :2] = np.stack([column["per_decay"], column["per_width"]], axis=1)
    return row
