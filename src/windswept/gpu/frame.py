"""What the renderer is told of one moment: where plants stand, how they are posed, who looks, and the light."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from windswept.gpu.seating import Seating
from windswept.plants.plant import Floats, Ints

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Camera:
    """A pinhole camera; +Z is up."""

    eye: Vector
    """Position, m."""
    target: Vector
    """Point it looks at, m."""
    fov_y: float = 0.7
    """Full vertical angle of view, rad."""


@dataclass(frozen=True, slots=True)
class PosedPlants:
    """P placements of one kind of plant, as they are at one moment."""

    link: Floats | None
    """(P, L, 8) ``Pose.link``; None where the frame's ``motion`` knows it."""
    position: Floats
    """(P, 3) roots in the world, m."""
    yaw: Floats
    """(P,) turn about +Z, rad."""
    flutter: Floats
    """(P,) how far a readily fluttering leaf trembles, rad; 0 in calm air. The frame's ``motion`` knows better."""
    extra_look: Ints | None = None
    """(P,) which of the renderer's extra looks each wears; None for the kind's own look."""


@dataclass(frozen=True, slots=True)
class Ground:
    """Terrain heights on a regular grid; the renderer carries it on to the horizon."""

    height: Floats
    """(ny, nx) z of the ground, m; at least 2 by 2."""
    origin: tuple[float, float]
    """x, y of ``height[0, 0]``, m."""
    spacing: float
    """Distance between neighbours, m."""


@dataclass(frozen=True, slots=True)
class CardMotion:
    """How all placements move, where that is already on the card: nothing of it is uploaded."""

    pose: Callable[[Any, Seating], None]
    """Records into a command encoder how the placements that have seats are posed at this moment."""
    speeds: Any
    """Buffer of the mean wind speed in every placement's crown, m/s, kind after kind."""


@dataclass(frozen=True, slots=True)
class MeadowMotion:
    """How the blades of a meadow lean at one moment."""

    lanes: tuple[Floats, ...]
    """``BladeState.lanes`` of every kind that moves, bed after bed; none where ``leans`` holds them."""
    ahead: float
    """Seconds since the last step; leans go on at their rate."""
    leans: Any = None
    """Buffer of the same, where that is already on the card: nothing of it is uploaded."""


@dataclass(frozen=True, slots=True)
class Frame:
    """One picture to draw."""

    plants: tuple[PosedPlants, ...]
    """One entry for each geometry the renderer holds, in its order."""
    camera: Camera
    sun: Vector = (-0.55, -0.35, 0.62)
    """Direction towards the sun, any length."""
    time: float = 0.0
    """s; drives flutter, grass and clouds, never the plants' poses."""
    wind: tuple[float, float] = (0.0, 0.0)
    """Mean horizontal wind, m/s: sways grass and drifts clouds."""
    motion: CardMotion | None = None
    """Of all plants on the card; None where each kind's ``link`` is uploaded."""
    balls: Floats = field(default_factory=lambda: np.zeros((0, 8), np.float32))
    """(n, 8) middle and radius, m, and quaternion of the balls that roll through the scene."""
    meadow: MeadowMotion | None = None
    """Of the blades that the renderer holds; None where it holds none."""


LARGEST_FLUTTER = 0.6
"""How far a readily fluttering leaf trembles in a storm, rad."""
FLUTTER_SPEED = 5.0
"""Wind speed at which it trembles with 63 % of that, m/s."""
FLAT_GROUND = Ground(np.zeros((2, 2), np.float32), (-50.0, -50.0), 100.0)
"""A level plane at z = 0."""
