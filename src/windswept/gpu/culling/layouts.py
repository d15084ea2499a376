"""NumPy types of every struct in ``shaders/cull_types.wgsl``, field for field; a test compares them."""

from __future__ import annotations

import numpy as np

from windswept.gpu.layouts import COUNTS, REALS

PLANES = ("<f4", (5, 4))

STANDING = np.dtype([("position", *REALS), ("turn", *REALS), ("rows", *COUNTS)])
DRAWN_KIND = np.dtype([("ball", *REALS), ("leaf", *REALS), ("first", *COUNTS), ("counts", *COUNTS)])
SIGHT = np.dtype(
    [
        ("eye", *REALS),
        ("planes", *PLANES),
        ("sun", *REALS),
        ("shadow", *REALS),
        ("stem_pixels", *REALS),
        ("leaf_pixels", *REALS),
        ("counts", *COUNTS),
        ("room", *COUNTS),
    ]
)
CHOICE = np.dtype([("piece_limit", *COUNTS), ("leaves", *REALS), ("reach", *COUNTS), ("rows", *COUNTS)])
NEEDS = np.dtype([("pieces", *COUNTS), ("leaves", *COUNTS), ("poses", *COUNTS), ("chunks", *COUNTS)])

CLASSES = 3
"""Placements that only throw shadows, that are seen and do, that are only seen."""
GROUP = 64
"""Placements of a workgroup."""
BANDS = 128
"""Of distance."""
MESH_LIMIT = 16
"""Draws that the shaders' table holds."""
