"""Where the links of a plant are now: the one thing that motion hands to geometry."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.plants.plant import Floats, Ints, Plant


@dataclass(frozen=True, slots=True)
class Pose:
    """Pose of P placements of one plant with L links, each in the plant's own frame (before placing)."""

    link: Floats
    """(P, L, 8) per link: joint position x, y, z in m, 0, rotation from the rest pose as a quaternion x, y, z, w.

    A point c of the rest plant that link l carries is now at ``position + rotate(rotation, c - link_base[l])``.
    """

    @property
    def position(self) -> Floats:
        """(P, L, 3) joint at the base of every link, m."""
        return self.link[..., :3]

    @property
    def rotation(self) -> Floats:
        """(P, L, 4) rotation of every link from its rest pose, quaternion x, y, z, w."""
        return self.link[..., 4:]

    def ends(self, vector: NDArray[np.floating], links: Ints | None = None) -> Floats:
        """(P, n, 3) where the far ends of links are, m.

        Args:
            vector: (L, 3) of every link from its joint to its end, at rest, m.
            links: (n,) which; None for all.
        """
        which = slice(None) if links is None else links
        q, d = self.rotation[:, which], vector[which].astype(np.float32)
        t = 2.0 * np.cross(q[..., :3], d)
        return self.position[:, which] + d + q[..., 3:] * t + np.cross(q[..., :3], t)


def rest_pose(plant: Plant, placement_count: int = 1) -> Pose:
    """Pose of a plant in calm air.

    Args:
        plant: the plant.
        placement_count: P, how many placements share it.
    """
    link = np.zeros((placement_count, plant.link_count, 8), np.float32)
    link[..., :3] = plant.link_base
    link[..., 7] = 1.0
    return Pose(link)
