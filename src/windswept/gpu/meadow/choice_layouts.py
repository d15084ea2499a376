"""NumPy types of every struct in ``blade_choice_types.wgsl``, field for field; a test compares them."""

from __future__ import annotations

import numpy as np

from windswept.gpu.layouts import COUNTS, REALS

PLANES = ("<f4", (5, 4))
SECTION_NUMBERS = ("<u4", (4, 4))
MOST_SECTION_NUMBERS = 16
"""Different numbers of sections that a meadow's blades may have."""

CHUNK_ROW = np.dtype([("ball", *REALS), ("size", *REALS), ("rows", *COUNTS), ("sections", *COUNTS)])
CHOICE_LOOK = np.dtype(
    [
        ("eye", *REALS),
        ("planes", *PLANES),
        ("rules", *REALS),
        ("now", *REALS),
        ("counts", *COUNTS),
        ("sections", *SECTION_NUMBERS),
    ]
)
