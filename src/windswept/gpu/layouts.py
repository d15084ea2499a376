"""NumPy types of every struct in ``shaders/types.wgsl``, field for field; a test compares the two."""

from __future__ import annotations

import numpy as np

MATRIX = ("<f4", (4, 4))
REALS = ("<f4", (4,))
COUNTS = ("<u4", (4,))

FRAME = np.dtype(
    [
        ("view_projection", *MATRIX),
        ("clip_to_world", *MATRIX),
        ("sun_projection", *MATRIX),
        ("eye", *REALS),
        ("sun", *REALS),
        ("sun_light", *REALS),
        ("sky_light", *REALS),
        ("haze", *REALS),
        ("wind", *REALS),
        ("terrain", *REALS),
    ]
)
PLACEMENT = np.dtype(
    [
        ("position", *REALS),
        ("heading", *REALS),
        ("rows", *COUNTS),
        ("first", *COUNTS),
        ("piece_limit", *COUNTS),
        ("piece_out", *COUNTS),
        ("leaves", *REALS),
    ]
)
LOOK = np.dtype([("bark", *REALS), ("leaf", *REALS), ("back", *REALS)])
LINK_POSE = np.dtype([("position", *REALS), ("rotation", *REALS)])
STEM = np.dtype([("profile", *REALS), ("extent", *REALS), ("attach", *REALS), ("rows", *COUNTS)])
PIECE = np.dtype(
    [
        ("p0", *REALS),
        ("p1", *REALS),
        ("p2", *REALS),
        ("p3", *REALS),
        ("side0", *REALS),
        ("side1", *REALS),
        ("rows", *COUNTS),
    ]
)
LEAF = np.dtype(
    [("position", *REALS), ("axis", *REALS), ("normal", *REALS), ("outward", *REALS), ("rows", *COUNTS)]
)
STEM_SHIFT = np.dtype([("offset", *REALS), ("total", *REALS)])
POSED_PIECE = np.dtype(
    [
        ("p0", *REALS),
        ("p1", *REALS),
        ("p2", *REALS),
        ("p3", *REALS),
        ("side0", *REALS),
        ("side1", *REALS),
        ("side2", *REALS),
        ("rows", *COUNTS),
    ]
)
POSED_LEAF = LEAF
GRASS_BLADE = np.dtype([("root", *REALS), ("chance", *REALS)])
BATCH = np.dtype([("items", *COUNTS), ("scale", *REALS)])

NONE = 0xFFFFFFFF
"""Row number that stands for no row."""
LOOK_LIMIT = 64
"""Kinds of plants a renderer can hold: the length of the shaders' ``looks``."""
