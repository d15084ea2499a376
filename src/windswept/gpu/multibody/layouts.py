"""NumPy types of every struct in ``shaders/multibody_types.wgsl``, field for field; a test compares them."""

from __future__ import annotations

import numpy as np

from windswept.gpu.layouts import COUNTS, REALS

ROD = np.dtype(
    [
        ("axis_1", *REALS),
        ("axis_2", *REALS),
        ("foot", *REALS),
        ("leaf_1", *REALS),
        ("leaf_2", *REALS),
        ("mass", *REALS),
        ("rows", *COUNTS),
    ]
)
COUPLED = np.dtype([("pace", *REALS), ("rows", *COUNTS)])

TIP, FOLLOWS, FORKS, LATER = 1, 2, 4, 8
"""What the walks do at a link: TIP and its neighbours of ``multibody_types.wgsl``."""
