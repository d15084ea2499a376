"""named_stream: random numbers of one part of a scene."""

from __future__ import annotations

from zlib import crc32

import numpy as np


def named_stream(seed: int, name: str, index: int = 0) -> np.random.Generator:
    """Random numbers of one part of a scene, independent of every other part."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(crc32(name.encode()), index)))
