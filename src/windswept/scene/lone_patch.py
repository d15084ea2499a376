"""A scene with a patch of one species of underbrush: what its name means where a scene is asked for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from windswept.plants.check_seed import check_seed
from windswept.plants.underbrush import load_underbrush
from windswept.scene.build_camera import frame_patch
from windswept.scene.lone_plant import empty_scene
from windswept.scene.scene import Scene
from windswept.scene.spread.colony import Colony
from windswept.scene.streams import named_stream

EDGE = 2.0
"""Of the patch, m."""
TUFTS_ACROSS = 8
"""Tufts in a row of the patch, each somewhere in a cell of its own."""


def lone_patch(source: str, seed: int = 0) -> Scene:
    """A square of underbrush on the ground and in the wind that a lone plant has, and a camera that frames it.

    Args:
        source: name of a built-in species of underbrush, or path of a .toml file of one.
        seed: of the tufts, their places and the turbulence.

    Raises:
        InputError: no such source, or its file is wrong.
    """
    check_seed(seed)
    rooted = [one for one in load_underbrush(source).component if not one.parent]
    height = 1e-3 * max(one.length_mm for one in rooted)
    rng = named_stream(seed, "patch")
    row, column = np.divmod(np.arange(TUFTS_ACROSS**2), TUFTS_ACROSS)
    cell = np.stack([column, row], axis=1) + rng.uniform(0.0, 1.0, (TUFTS_ACROSS**2, 2))
    position = np.zeros((TUFTS_ACROSS**2, 3), np.float32)
    position[:, :2] = EDGE * (cell / TUFTS_ACROSS - 0.5)
    yaw = rng.uniform(0.0, 2.0 * np.pi, len(cell)).astype(np.float32)
    colony = Colony(source, position, yaw, np.ones(len(cell), np.float32))
    return replace(empty_scene(source, seed, height, frame_patch(height, EDGE)), colonies=(colony,))
