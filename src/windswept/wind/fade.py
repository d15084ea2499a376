"""The one smooth step that waves and gusts come and go with."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def smooth_step(progress: ArrayLike) -> NDArray[np.float64]:
    """3 p^2 - 2 p^3 between 0 and 1, constant outside: value and slope are continuous."""
    p = np.clip(np.asarray(progress, dtype=np.float64), 0.0, 1.0)
    return p * p * (3.0 - 2.0 * p)
