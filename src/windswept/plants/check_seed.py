"""check_seed: what growth may start its random numbers from."""

from __future__ import annotations

import numpy as np

from windswept.errors import InputError


def check_seed(seed: object) -> None:
    """Raise InputError for a seed that is not a whole number from 0 up."""
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer) or seed < 0:
        raise InputError("seed", "", seed, "a whole number from 0 up")
