"""NumPy types of every struct in ``lean_types.wgsl`` and of ``AirGrid``, field for field; a test compares them."""

from __future__ import annotations

import numpy as np

from windswept.gpu.layouts import COUNTS, REALS

AIR_LIMIT = 2
"""Fields of air at one time, at most: the wind alone, and the scene's force field."""

LEAN_BLOCK = np.dtype([("rows", *COUNTS)])
LEAN_KIND = np.dtype([("share", *REALS), ("air", *REALS), ("bounds", *REALS)])
AIR_GRID = np.dtype([("nodes", *COUNTS), ("origin", *REALS), ("per_metre", *REALS)])
LEAN_PASS = np.dtype([("steps", *COUNTS)])
