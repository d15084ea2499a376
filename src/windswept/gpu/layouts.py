"""NumPy types of every struct in ``shaders/types.wgsl`` and ``motion.wgsl``, field for field; a test compares them."""

from __future__ import annotations

import numpy as np

MATRIX = ("<f4", (4, 4))
REALS = ("<f4", (4,))
COUNTS = ("<u4", (4,))
COUNT = ("<u4",)

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
        ("number", *COUNTS),
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
BALL = np.dtype([("place", *REALS), ("rotation", *REALS)])
"""Of ``balls.wgsl``."""
GRASS_BLADE = np.dtype([("root", *REALS), ("chance", *REALS)])
LISTED = np.dtype([("counts", *COUNTS)])
BATCH = np.dtype([("items", *COUNTS), ("scale", *REALS)])

KIND = np.dtype([("ladder", *COUNTS), ("joints", *COUNTS), ("size", *REALS)])
RUNG = np.dtype(
    [("links", *COUNTS), ("groups", *COUNTS), ("probes", *COUNTS), ("room", *COUNTS), ("air", *REALS)]
)
LINK = np.dtype(
    [
        ("axis_1", *REALS),
        ("axis_2", *REALS),
        ("foot", *REALS),
        ("vector", *REALS),
        ("leaf_1", *REALS),
        ("leaf_2", *REALS),
        ("swing", *REALS),
        ("more", *REALS),
        ("rows", *COUNTS),
    ]
)
GROUP = np.dtype(
    [
        ("centre", *REALS),
        ("leaf_1", *REALS),
        ("leaf_2", *REALS),
        ("wood_1", *REALS),
        ("wood_2", *REALS),
        ("couple_x", *REALS),
        ("couple_y", *REALS),
        ("couple_z", *REALS),
        ("sway_x", *REALS),
        ("sway_y", *REALS),
        ("sway_z", *REALS),
        ("swing", *REALS),
        ("rows", *COUNTS),
    ]
)
SHAPE = np.dtype(
    [
        ("linear_1", *REALS),
        ("square_1", *REALS),
        ("mixed_1", *REALS),
        ("linear_2", *REALS),
        ("square_2", *REALS),
        ("mixed_2", *REALS),
    ]
)
ROOTED = np.dtype([("position", *REALS), ("heading", *REALS), ("rows", *COUNTS)])
MOTION = np.dtype([("at", *COUNTS), ("origin", *COUNTS), ("wish", *COUNTS)])
MOMENT = np.dtype(
    [("eye", *REALS), ("view", *REALS), ("time", *REALS), ("steps", *COUNTS), ("counts", *COUNTS)]
)
AIR = np.dtype([("profile", *REALS), ("mean", *REALS), ("ground", *REALS), ("sources", *COUNTS)])
WAVE = np.dtype([("phase", *REALS), ("push", *REALS)])
GUST = np.dtype([("place", *REALS), ("shape", *REALS), ("fade", *REALS)])
SHIFT = np.dtype([("rung", *COUNT), ("before", *COUNT), ("after", *COUNT), ("placement", *COUNT)])
ROW = np.dtype(REALS)
"""A bare ``vec4f``."""
WORD = np.dtype("<u4")
"""A bare ``u32``."""

LANES = 64
"""Placements in one block: LANES of ``motion.wgsl``."""
CARRIED_ROWS, RECORD_ROWS, SLOT_ROWS = 2, 5, 8
"""Of a coupled link that last, of one within a step, and of a depth within a walk; see ``multibody_types.wgsl``."""
STILL, SPRINGS, MULTIBODY = 0, 1, 2
"""What moves the plants of a rung: as in ``motion.wgsl``."""
KIND_LIMIT, RUNG_LIMIT = 512, 800
"""Kinds, and simulation levels of all kinds, that the shaders' uniform tables hold."""
NONE = 0xFFFFFFFF
"""Row number that stands for no row."""
LOOK_LIMIT = KIND_LIMIT + 32
"""Looks that the shaders' uniform table holds: those of all kinds, and others that placements may wear instead."""
