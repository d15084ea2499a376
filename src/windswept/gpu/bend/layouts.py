"""NumPy types of every struct in ``bend_types.wgsl`` and ``bend_air.wgsl``, field for field; a test compares them."""

from __future__ import annotations

import numpy as np

from windswept.gpu.layouts import COUNTS, GUST, REALS, WAVE

WAVE_LIMIT, GUST_LIMIT = 16, 8
"""Waves and gusts that blow at one time, at most: lengths of the arrays in ``Breeze``."""

BRANCH = np.dtype(
    [
        ("leg0", *REALS),
        ("leg1", *REALS),
        ("leg2", *REALS),
        ("side", *REALS),
        ("tip", *REALS),
        ("rows", *COUNTS),
    ]
)
BRANCH_LOOK = np.dtype([("origin", *REALS), ("shade", *REALS)])
BENT_BRANCH = np.dtype([("p0", *REALS), ("p1", *REALS), ("p2", *REALS), ("p3", *REALS)])
BREEZE = np.dtype(
    [
        ("mean", *REALS),
        ("counts", *COUNTS),
        ("waves", WAVE, (WAVE_LIMIT,)),
        ("gusts", GUST, (GUST_LIMIT,)),
    ]
)
BEND_PASS = np.dtype([("rows", *COUNTS), ("weights", *REALS)])
