"""Field: the air and the pushes over one piece of ground, and what they come from."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from windswept.errors import InputError
from windswept.wind.field.acts import Agent
from windswept.wind.field.clamps import Clamps
from windswept.wind.field.deflect import Deflection, deflect
from windswept.wind.field.grid import Floats, Grid
from windswept.wind.field.obstacles import Obstacle
from windswept.wind.field.primitives import Primitive, running
from windswept.wind.field.quads import WIDTH
from windswept.wind.mean import profile_factor
from windswept.wind.velocity import velocity
from windswept.wind.wind import Wind


@dataclass(frozen=True)
class FieldPlan:
    """What a field is made of; never changed by a step."""

    grid: Grid
    primitives: tuple[Primitive, ...] = ()
    obstacles: tuple[Obstacle, ...] = ()
    agents: tuple[Agent, ...] = ()
    relaxation: float = 0.25
    """Rate at which wakes and other departures die, 1/s: in a wind of 5 m/s they reach some 20 m."""

    def __post_init__(self) -> None:
        if not 0.0 <= self.relaxation < np.inf:
            raise InputError("field", "relaxation", self.relaxation, "a rate of 0 per second or more")


@dataclass(slots=True)
class Field:
    """The field at a time. ``velocity`` and ``push`` are what plants read."""

    plan: FieldPlan
    wind: Wind
    """May be replaced while the field runs."""
    time: float
    """s."""
    velocity: Floats
    """(nx, ny, nz, 3) of the air, m/s."""
    push: Floats
    """(nx, ny, nz, 3) contact pressure of agents on plants, N/m^2."""
    ambient: Floats
    """(nx, ny, 3) the wind at its reference height, m/s."""
    profile: Floats
    """(nz,) its share at the height of each layer."""
    departure: Floats
    """(nx, ny, nz, 4) of the air from the deflected ambient air: velocity added, m/s, and share of the ambient air's
    velocity taken away (in a wake), 0..1."""
    spare: Floats
    """(nx, ny, nz, 4) where the next departure is written."""
    flow: Floats
    """(3, nx, ny, nz) primitives and jets, m/s; (3, 0, 0, 0) if there are none."""
    deflection: Deflection
    """By the obstacles."""
    running: frozenset[int]
    """Primitives that blow."""
    clamps: Clamps = field(default_factory=Clamps)
    """What had to be held back."""


def start_field(plan: FieldPlan, wind: Wind, time: float = 0.0) -> Field:
    """A field in undisturbed air; primitives that begin before ``time`` blow everywhere already.

    Args:
        plan: what it is made of; a few seconds go into the deflection by its obstacles.
        wind: over it.
        time: s.
    """
    grid = plan.grid
    nx, ny, nz = grid.shape
    ambient = sample_ambient(grid, wind, time)
    profile = profile_factor(wind.profile, grid.heights).astype(np.float32)
    return Field(
        plan=plan,
        wind=wind,
        time=time,
        velocity=ambient[:, :, None, :] * profile[:, None],
        push=np.zeros((nx, ny, nz, 3), np.float32),
        ambient=ambient,
        profile=profile,
        departure=np.zeros((nx, ny, nz, WIDTH), np.float32),
        spare=np.zeros((nx, ny, nz, WIDTH), np.float32),
        flow=np.zeros((3, 0, 0, 0), np.float32),
        deflection=deflect(grid, plan.obstacles),
        running=frozenset(i for i in running(plan.primitives, time) if plan.primitives[i].start < time),
    )


def sample_ambient(grid: Grid, wind: Wind, time: float) -> Floats:
    """(nx, ny, 3) the wind at its reference height, where its profile is 1, m/s."""
    points, height = _reference_points(grid, wind.profile.reference_height)
    return velocity(wind, points, height, time).reshape(*grid.shape[:2], 3)


@lru_cache(maxsize=4)
def _reference_points(grid: Grid, height: float) -> tuple[Floats, Floats]:
    """(nx * ny, 3) x and y of every column of nodes, and (nx * ny,) the one height, m."""
    points = grid.ground_points()
    return points, np.full(len(points), height, np.float32)
