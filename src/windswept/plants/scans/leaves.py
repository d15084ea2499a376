"""add_leaves: covers the outer stems of a scanned tree with leaves of a total area.

A scan in winter holds no leaf, one in summer only their fog. Where nothing is known, leaf area follows from the
trunk: a forest broadleaf bears about 0.3 m^2 of leaf for every cm^2 of its trunk's section ("chosen", within the
0.2 to 0.4 m^2 that pipe-model studies quote for sapwood). Inclinations are drawn from de Wit's distributions.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np

from windswept.plants.plant import LEAF_FILL, Plant
from windswept.plants.scans.cylinders import Indices, Reals

Angles = Literal["spherical", "planophile"]

AREA_PER_SECTION = 3000.0
"""Leaf area over area of the trunk's section."""
LEAF_LENGTH, LEAF_WIDTH = 0.12, 0.09
"""Of one leaf, m; larger where there would be more than `MOST_LEAVES`."""
MOST_LEAVES = 60_000


def add_leaves(plant: Plant, area: float, rng: np.random.Generator, angles: Angles = "planophile") -> Plant:
    """The same plant with leaves spread evenly over the length of its terminal stems.

    Args:
        plant: bare.
        area: of all leaves, one-sided, m^2; 0 leaves the plant bare.
        rng: draws seats and directions.
        angles: how the leaves' normals are inclined: as on a sphere, or mostly level.
    """
    count = min(round(area / (LEAF_FILL * LEAF_LENGTH * LEAF_WIDTH)), MOST_LEAVES)
    if count < 1:
        return plant
    grow = np.sqrt(area / (count * LEAF_FILL * LEAF_LENGTH * LEAF_WIDTH))
    link, share = _seats(plant, count, rng)
    along = (plant.link_tip - plant.link_base).astype(np.float64)[link]
    normal = _normals(count, rng, angles)
    outward = along / np.linalg.norm(along, axis=1)[:, None] + 0.8 * rng.standard_normal((count, 3))
    axis = outward - np.einsum("ij,ij->i", outward, normal)[:, None] * normal
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    position = plant.link_base[link] + share[:, None] * along
    return replace(
        plant,
        leaf_link=link.astype(np.int32),
        leaf_position=position.astype(np.float32),
        leaf_axis=axis.astype(np.float32),
        leaf_normal=normal.astype(np.float32),
        leaf_length=np.full(count, grow * LEAF_LENGTH, np.float32),
        leaf_width=np.full(count, grow * LEAF_WIDTH, np.float32),
    )


def usual_leaf_area(plant: Plant) -> float:
    """Leaf area that the trunks would bear, m^2."""
    first = plant.stem_link_start[:-1][plant.stem_order == 0]
    return AREA_PER_SECTION * float(np.pi * np.sum(plant.link_radius_base[first].astype(np.float64) ** 2))


def _seats(plant: Plant, count: int, rng: np.random.Generator) -> tuple[Indices, Reals]:
    """(N,) link, ascending, and place along it of leaves at even distances along the terminal stems."""
    length = np.linalg.norm(plant.link_tip.astype(np.float64) - plant.link_base, axis=1)
    is_terminal = np.ones(plant.stem_count, bool)
    is_terminal[plant.stem_parent[plant.stem_parent >= 0]] = False
    running = np.cumsum(np.where(is_terminal[plant.link_stem], length, 0.0))
    wanted = (np.arange(count) + rng.random(count)) * (running[-1] / count)
    link = np.minimum(np.searchsorted(running, wanted), plant.link_count - 1)
    share = np.clip(1.0 - (running[link] - wanted) / length[link], 0.0, 1.0)
    return link, share


def _normals(count: int, rng: np.random.Generator, angles: Angles) -> Reals:
    """(N, 3) upper faces; inclination from the vertical by de Wit's density 2/pi (1 + cos 2a), or as on a sphere."""
    if angles == "spherical":
        inclination = np.arccos(rng.random(count))
    else:
        table = np.linspace(0.0, 0.5 * np.pi, 256)
        inclination = np.interp(rng.random(count), (2.0 * table + np.sin(2.0 * table)) / np.pi, table)
    heading = rng.uniform(0.0, 2.0 * np.pi, count)
    level = np.sin(inclination)
    return np.stack((level * np.cos(heading), level * np.sin(heading), np.cos(inclination)), axis=1)
