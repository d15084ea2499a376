"""The step of blades as plain formulas in double precision: what the kernel in step_blades.py must equal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from windswept.motion.blades.constraint import constraint_step, resolves
from windswept.motion.blades.field import PackedField
from windswept.motion.blades.kind import BladeKind, bending_lean
from windswept.motion.blades.lean import lean_of_load
from windswept.motion.lanes import WIDTH
from windswept.motion.rods import Doubles
from windswept.plants.plant import Floats


@dataclass(frozen=True, slots=True)
class PlainState:
    """Motion of B blades of one kind."""

    lean: Doubles
    """(B, 3) from rest, along axis, normal and side."""
    rate: Doubles
    """(B, 3) 1/s."""
    broken: np.ndarray
    """(B,) bool."""


def rest_lean(kind: BladeKind, frame: Doubles | Floats, broken: np.ndarray | bool = False) -> Doubles:
    """(B, 3) lean of blades with base frames (B, 3, 3) under their weight alone."""
    return lean_of_load(_weight(kind, frame, np.broadcast_to(broken, len(frame))))


def drag_of_air(kind: BladeKind, velocity: Doubles) -> Doubles:
    """(..., 3) drag on a whole blade of size 1 from air in its base frame (..., 3), in force scales (PHYSICS B4).

    F = 1/2 rho C_d A |U| U (1 + (U / U_c)^2)^(V / 2), less where the air comes along the blade or at its edge.
    """
    material = kind.blade.component
    speed = np.linalg.norm(velocity, axis=-1, keepdims=True)
    folded = (1.0 + (speed / material.reconfiguration_speed) ** 2) ** (0.5 * material.reconfiguration)
    return kind.drag * folded * speed * velocity * kind.drag_share


def step_plain(
    kind: BladeKind,
    frame: Doubles,
    size: Doubles,
    state: PlainState,
    velocity: Doubles,
    push: Doubles,
    time_step: float,
) -> PlainState:
    """One step of B blades with base frames (B, 3, 3) in air of (B, 3) velocity, m/s, and pressure, N/m^2."""
    softer = np.where(state.broken, 1.0 / kind.broken_scale, 1.0) * size**-1.5
    steps = [
        constraint_step(omega / np.sqrt(size), kind.damping_ratio, time_step) for omega in kind.frequency
    ]
    reach = (size * resolves(steps[0]))[:, None] * np.concatenate([[0.0], kind.reach])
    moving = np.einsum("bi,bij->bj", reach * state.rate, frame)
    damping = -2.0 * kind.drag * softer * reach[:, 1] * steps[0][:, 2]
    speed = np.linalg.norm(velocity - moving, axis=1)
    air = velocity - moving / (1.0 + damping * speed)[:, None]
    force = drag_of_air(kind, np.einsum("bij,bj->bi", frame, air))
    force = softer[:, None] * (force + kind.push * np.einsum("bij,bj->bi", frame, push))
    weight = _weight(kind, frame, state.broken)
    target = lean_of_load(weight + force) - lean_of_load(weight)
    xx, xv, vx, vv = np.stack([steps[0], steps[0], steps[1]], axis=2).transpose(1, 0, 2)
    y = state.lean - target
    lean, rate = target + xx * y + xv * state.rate, vx * y + vv * state.rate
    bent = lean_of_load(weight) + lean
    shorter = np.minimum(1.0 / np.linalg.norm(bent, axis=1, keepdims=True), 1.0)
    broken = state.broken | (bending_lean(bent) > kind.breaking_lean)
    return PlainState(lean + (shorter - 1.0) * bent, shorter * rate, broken)


def sample_plain(field: PackedField, place: Doubles) -> tuple[Doubles, Doubles]:
    """Velocity and pressure (B, 3) at places (B, 3): x, y, height; trilinear, outside the grid as on its border."""
    grid = field.grid
    nodes = field.nodes.reshape(grid.nodes_x, grid.nodes_y, grid.nodes_z, WIDTH).astype(np.float64)
    origin = np.array([grid.origin_x, grid.origin_y, 0.0])
    cells = (place - origin) * np.array([grid.per_x, grid.per_y, grid.per_z])
    most = np.array(nodes.shape[:3]) - 1
    cells = np.clip(cells, 0.0, most)
    first = np.minimum(cells.astype(int), most - 1)
    part = cells - first
    total = np.zeros((len(place), WIDTH))
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(corner, part, 1.0 - part), axis=1)
        i, j, k = (first + corner).T
        total += weight[:, None] * nodes[i, j, k]
    return total[:, :3], total[:, 4:7]


def _weight(kind: BladeKind, frame: Doubles | Floats, broken: np.ndarray) -> Doubles:
    """(B, 3) weight in the base frame, in the force scales of whole or broken blades."""
    softer = np.where(broken, 1.0 / kind.broken_scale, 1.0)
    return -kind.weight * softer[:, None] * frame[:, :, 2]
