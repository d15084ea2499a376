"""Lean: the one coordinate of a blade that moves, and by which its pose is looked up.

A blade feels one load: its weight, the air's drag and whatever pushes it, spread over the blade as its weight is
(Endo, section 4: the resultant acts at the centre of mass). So gravity and wind need no two axes: a blade that stands
at a tilt in calm air hangs as an upright one does under a load at that angle. With b = load / force scale, where the
force scale would bend the tip by one length if bending went on as it begins,

    lean = b / sqrt(1 + |b|^2)

is a vector of length 0 to 1 that for a load across the flat face is the tip's displacement over the length: exact
for small loads, within 0.1 for all (heavy elastica). What oscillates is this vector, in the blade's base frame; and as
lean and load say the same, the pose of a lean is the equilibrium of its load.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.motion.blades.chain import Chain, weight_share
from windswept.motion.rods import Doubles

LARGEST_LEAN = 0.99999
"""A blade is drawn at no larger lean; its load is some 220 force scales, under which it lies along the load."""


def force_scale(chain: Chain) -> float:
    """Force that would bend the tip across the flat face by one length, were bending linear, N."""
    return chain.whole_length / _tip_compliance(chain)


def _tip_compliance(chain: Chain) -> float:
    """Tip displacement per newton spread as the weight is, of the straight chain, m/N."""
    base = np.concatenate([[0.0], np.cumsum(chain.length)[:-1]])
    centre = base + 0.5 * chain.length
    arm = np.maximum(centre - base[:, None], 0.0)
    turn = (arm @ weight_share(chain)) / chain.stiffness[:, 0]
    return float(turn @ (chain.whole_length - base))


def lean_of_load(load: NDArray[np.floating]) -> Doubles:
    """(..., 3) lean of loads (..., 3) in force scales."""
    return load / np.sqrt(1.0 + np.sum(load * load, axis=-1, keepdims=True))


def load_of_lean(lean: NDArray[np.floating]) -> Doubles:
    """(..., 3) load in force scales of leans (..., 3), which are first shortened to LARGEST_LEAN."""
    size = np.linalg.norm(lean, axis=-1, keepdims=True)
    lean = lean * np.minimum(1.0, LARGEST_LEAN / np.maximum(size, 1e-30))
    return lean / np.sqrt(1.0 - np.sum(lean * lean, axis=-1, keepdims=True))
