"""PoseTable: equilibrium poses of a blade computed beforehand, by the angle, norm and direction of its load.

The three axes, each of evenly spaced bins:

    angle      from the blade's axis at its root to the load, 0 to pi (in calm air pi less the tilt to the ground's
               normal)
    norm       of the load
    direction  of the load round the axis, from the normal (the face towards which the blade curls) to its opposite;
               the mirror image serves the other half of the circle

The norm t, in force scales, is counted as 1 - 1 / sqrt(1 + 2 t), so that bins are even in lean for small loads and
even in the length of the bent root for large ones. Between bins the turns of the joints are interpolated: sections
keep their lengths.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from windswept.errors import InputError
from windswept.motion.blades.chain import Chain, weight_share
from windswept.motion.blades.lean import LARGEST_LEAN, force_scale, load_of_lean
from windswept.motion.blades.newton import settle_rays
from windswept.motion.blades.rest_shape import SEED_TURN, natural_turns
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats

MOST_NODES = 1_000_000
"""A table with more is a mistake: at eight sections it would be 64 MB."""


@dataclass(frozen=True, slots=True)
class Bins:
    """How finely a table divides its axes."""

    angle: int = 32
    norm: int = 24
    direction: int = 24

    def validate(self) -> None:
        """Raise InputError for an axis without bins or a table without end."""
        for name in ("angle", "norm", "direction"):
            if getattr(self, name) < 2:
                raise InputError("pose table", f"{name} bins", getattr(self, name), "2 or more")
        if self.node_count > MOST_NODES:
            raise InputError("pose table", "bins", self.node_count, f"at most {MOST_NODES:,} nodes in all")

    @property
    def node_count(self) -> int:
        """Poses in the table."""
        return (self.angle + 1) * (self.norm + 1) * (self.direction + 1)


DEFAULT_BINS = Bins()
"""1.0 MB for a blade of six sections. Of random loads up to 3 force scales, 95 in 100 and more are met within 1 % of
length; the others lie where a blade that is pushed sideways or pressed down falls over to one face or the other."""


@dataclass(frozen=True, slots=True)
class PoseTable:
    """Poses of one kind of blade with K sections."""

    turns: Floats
    """(angle + 1, norm + 1, direction + 1, K, 2) joint turns, across the flat face and to the side, rad."""
    length: Floats
    """(K,) of the sections of a blade of size 1, m."""

    @property
    def section_count(self) -> int:
        """Number of sections, K."""
        return len(self.length)

    @property
    def bytes(self) -> int:
        """Memory that the table takes."""
        return self.turns.nbytes + self.length.nbytes


def build_table(chain: Chain, bins: Bins = DEFAULT_BINS) -> PoseTable:
    """Table of a blade's equilibria.

    Every ray of growing load is followed from the unloaded blade, so that of several equilibria (a stem pressed down
    along its axis) the one stands in the table to which a growing load leads.

    Args:
        chain: the blade.
        bins: how finely.

    Raises:
        InputError: fewer than two bins on an axis, or too many in all.
    """
    bins.validate()
    direction = ray_directions(bins)
    rays = direction.reshape(-1, 3)
    load = force_scale(chain) * ray_norms(bins)[None, :, None] * rays[:, None, :]
    natural = natural_turns(chain)
    turns = np.broadcast_to(natural, (*load.shape[:2], *natural.shape)).copy()
    nudge = np.where(rays[:, 1] >= 0.0, SEED_TURN, -SEED_TURN)
    settle_rays(turns, chain.length, chain.turn, chain.stiffness, weight_share(chain), load, nudge)
    turns = turns.reshape(bins.angle + 1, bins.direction + 1, bins.norm + 1, chain.section_count, 2)
    packed = np.ascontiguousarray(turns.transpose(0, 2, 1, 3, 4), dtype=np.float32)
    return PoseTable(packed, chain.length.astype(np.float32))


def ray_norms(bins: Bins) -> Doubles:
    """(norm + 1,) loads of the nodes, in force scales."""
    place = np.linspace(0.0, 1.0, bins.norm + 1) * LAST_NORM
    return 0.5 * (1.0 / (1.0 - place) ** 2 - 1.0)


def ray_directions(bins: Bins) -> Doubles:
    """(angle + 1, direction + 1, 3) unit vectors of the nodes in the base frame."""
    polar = np.linspace(0.0, np.pi, bins.angle + 1)[:, None]
    azimuth = np.linspace(0.0, np.pi, bins.direction + 1)
    along = np.broadcast_to(np.cos(polar), (bins.angle + 1, bins.direction + 1))
    return np.stack([along, np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth)], axis=2)


LAST_NORM = float(1.0 - 1.0 / np.sqrt(1.0 + 2.0 * load_of_lean(np.array([LARGEST_LEAN, 0.0, 0.0]))[0]))
"""Place of the table's last norm."""


@njit(cache=True, forceinline=True)
def table_place(lean):  # type: ignore[no-untyped-def]
    """Places 0 to 1 on the axes angle, norm and direction of a lean (3,), and -1.0 where the mirror image is meant."""
    across = np.sqrt(lean[1] * lean[1] + lean[2] * lean[2])
    size = min(np.sqrt(lean[0] * lean[0] + across * across), LARGEST_LEAN)
    norm = (1.0 - 1.0 / np.sqrt(1.0 + 2.0 * size / np.sqrt(1.0 - size * size))) / LAST_NORM
    angle = np.arctan2(across, lean[0]) / np.pi
    direction = np.arctan2(abs(lean[2]), lean[1]) / np.pi
    return angle, norm, direction, (1.0 if lean[2] >= 0.0 else -1.0)


@njit(cache=True, forceinline=True)
def cell_of(place, bins):  # type: ignore[no-untyped-def]
    """Bin of a place 0 to 1 on an axis, and how far into it."""
    x = place * bins
    cell = min(max(int(x), 0), bins - 1)
    return cell, x - cell


@njit(cache=True)
def look_up(table, lean, turns):  # type: ignore[no-untyped-def]
    """Writes the joint turns (K, 2) of a lean (3,), interpolated between the eight nodes around it."""
    angle, norm, direction, mirror = table_place(lean)
    i, u = cell_of(angle, table.shape[0] - 1)
    j, v = cell_of(norm, table.shape[1] - 1)
    k, w = cell_of(direction, table.shape[2] - 1)
    for section in range(table.shape[3]):
        for bend in range(2):
            near = (1.0 - w) * table[i, j, k, section, bend] + w * table[i, j, k + 1, section, bend]
            out = (1.0 - w) * table[i, j + 1, k, section, bend] + w * table[i, j + 1, k + 1, section, bend]
            here = (1.0 - v) * near + v * out
            near = (1.0 - w) * table[i + 1, j, k, section, bend] + w * table[i + 1, j, k + 1, section, bend]
            out = table[i + 1, j + 1, k, section, bend]
            out = (1.0 - w) * out + w * table[i + 1, j + 1, k + 1, section, bend]
            there = (1.0 - v) * near + v * out
            turns[section, bend] = ((1.0 - u) * here + u * there) * (1.0 if bend == 0 else mirror)
