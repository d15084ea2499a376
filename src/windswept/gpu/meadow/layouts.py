"""NumPy types of every struct in ``blades_types.wgsl``, field for field; a test compares them."""

from __future__ import annotations

import numpy as np

from windswept.gpu.layouts import COUNTS, REALS

BLADE_ROW = np.dtype([("place", *REALS), ("bits", *COUNTS)])
BLADE_RUN = np.dtype(
    [
        ("whole", *COUNTS),
        ("broken", *COUNTS),
        ("rows", *COUNTS),
        ("shape", *REALS),
        ("width", *REALS),
        ("colour", *REALS),
        ("tip", *REALS),
    ]
)
POSED_JOINT = np.dtype([("place", *REALS), ("facing", *COUNTS)])
MEADOW_PASS = np.dtype([("items", *COUNTS), ("now", *REALS)])
