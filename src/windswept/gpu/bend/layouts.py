"""NumPy types of every struct in ``shaders/bend_types.wgsl``, field for field; a test compares the two."""

from __future__ import annotations

import numpy as np

from windswept.gpu.layouts import COUNTS, REALS

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
BREEZE_WAVE = np.dtype([("phase", *REALS), ("push", *REALS)])
BREEZE_GUST = np.dtype([("place", *REALS), ("shape", *REALS), ("fade", *REALS)])
BREEZE = np.dtype(
    [
        ("mean", *REALS),
        ("counts", *COUNTS),
        ("waves", BREEZE_WAVE, (WAVE_LIMIT,)),
        ("gusts", BREEZE_GUST, (GUST_LIMIT,)),
    ]
)
BEND_PASS = np.dtype([("rows", *COUNTS), ("weights", *REALS)])
