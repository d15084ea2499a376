"""What the air does to a leaf, as far as growth and motion both need it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.plants.plant import Floats, Material

AIR_DENSITY = 1.2
"""kg/m^3, at 20 degrees Celsius and sea level."""


def reconfiguration(material: Material, speed: NDArray[np.floating]) -> Floats:
    """Factor on leaf drag at an air speed in m/s, of any shape: leaves fold (PHYSICS B4)."""
    ratio = speed / material.reconfiguration_speed
    return ((1.0 + ratio * ratio) ** (0.5 * material.reconfiguration)).astype(np.float32)
