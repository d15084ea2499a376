"""Wind -> Breeze: what blows at one moment, as the card reads it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.gpu.bend import layouts
from windswept.gpu.springs.air import card_gusts, card_waves
from windswept.wind.wind import Wind


def breeze(wind: Wind, time: float) -> NDArray[np.void]:
    """(1,) ``BREEZE`` of the sources that blow at a time, s; waves that are faded out are left out.

    Raises:
        InputError: more than WAVE_LIMIT waves or GUST_LIMIT gusts blow at once.
    """
    waves, gusts = card_waves(wind, time), card_gusts(wind, time)
    if len(waves) > layouts.WAVE_LIMIT:
        raise InputError("wind", "waves", len(waves), f"at most {layouts.WAVE_LIMIT} that blow at one time")
    if len(gusts) > layouts.GUST_LIMIT:
        raise InputError("wind", "gusts", len(gusts), f"at most {layouts.GUST_LIMIT}")
    row = np.zeros(1, layouts.BREEZE)
    row["mean"][:, :2] = wind.mean.vector
    row["counts"][:, :2] = len(waves), len(gusts)
    row["waves"][0, : len(waves)] = waves
    row["gusts"][0, : len(gusts)] = gusts
    return row
