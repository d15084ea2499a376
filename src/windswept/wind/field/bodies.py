"""Bodies in the field: what they press, what air they drag along, and the wakes of what stands in the wind."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from windswept.wind.field.acts import Body
from windswept.wind.field.clamps import MAX_PUSH, MAX_SPEED, Clamps
from windswept.wind.field.flows import FAST_MATH
from windswept.wind.field.grid import Floats, Grid
from windswept.wind.field.obstacles import Obstacle, middle
from windswept.wind.field.quads import WIDTH

_F = np.float32
WAKE_LENGTH = 2.0
"""The air behind an obstacle is dead for so many half-widths; from there the wake drifts away."""
SHEDDING = 2.0
"""A body takes air with it at this rate times speed over radius: within the time in which the air passes it."""
STILL = 1e-3
"""Slower air leaves no wake, m/s."""
REST = _F(1e-5)
"""Components of the departure below this are put to rest, m/s."""
BODY_COLUMNS = (
    *("x_0", "y_0", "x_1", "y_1", "low", "high", "radius", "roundness"),
    *("pressure", "cover", "v_x", "v_y", "v_z", "shelter"),
)


def wake_of(obstacle: Obstacle, air: Sequence[float]) -> Body | None:
    """The dead air behind an obstacle, as wide as it; None in still air.

    Args:
        obstacle: any.
        air: (3,) undisturbed velocity at its middle, m/s.
    """
    speed = math.hypot(air[0], air[1])
    if not speed > STILL:
        return None
    along, across = obstacle.extent(math.atan2(air[1], air[0]))
    x, y, _ = middle(obstacle)
    reach = (along + WAKE_LENGTH * across) / speed
    low, high = obstacle.span
    round_end = min(across, 0.5 * (high - low))
    return Body(
        start=(x, y),
        stop=(x + reach * air[0], y + reach * air[1]),
        low=low + round_end if low > 0.0 else 0.0,
        high=high - round_end,
        radius=across,
        shelter=1.0 - obstacle.openness,
        roundness=round_end / across,
    )


def body_rows(grid: Grid, bodies: Iterable[Body], clamps: Clamps) -> tuple[Floats, NDArray[np.int32]]:
    """(R, 14) bodies as the kernel reads them, BODY_COLUMNS, and (R, 5) the nodes that each can reach.

    The nodes are first and last i, first and last j, last k. What is smaller than a cell acts on the nodes about it
    with as much less pressure, so that the force is the same.
    """
    rows, boxes = [], []
    coarsest = max(grid.cell)
    for body in bodies:
        row = _row(body, coarsest, clamps)
        if row is None:
            continue
        reach = row[6]
        sides = [
            (min(row[axis], row[axis + 2]) - reach, max(row[axis], row[axis + 2]) + reach) for axis in (0, 1)
        ]
        box = [_nodes(grid, axis, side) for axis, side in enumerate(sides)]
        top = _nodes(grid, 2, (0.0, row[5] + reach * row[7]))[1]
        rows.append(row)
        boxes.append([*box[0], *box[1], top])
    return (
        np.array(rows, np.float32).reshape(-1, len(BODY_COLUMNS)),
        np.array(boxes, np.int32).reshape(-1, 5),
    )


def _row(body: Body, coarsest: float, clamps: Clamps) -> list[float] | None:
    """One body with what is absurd held back and counted; None for what is no number."""
    pressure, velocity = body.pressure, np.array(body.velocity)
    place = (*body.start, *body.stop, body.low, body.high, body.radius, body.roundness)
    if not (np.isfinite(place).all() and math.isfinite(pressure) and body.radius > 0.0):
        clamps.lost += 1
        return None
    speed = float(np.linalg.norm(velocity))
    if not speed <= MAX_SPEED:
        clamps.speeds += 1
        velocity = velocity * (MAX_SPEED / speed) if math.isfinite(speed) else np.zeros(3)
    if not abs(pressure) <= MAX_PUSH:
        clamps.pushes += 1
        pressure = math.copysign(MAX_PUSH, pressure)
    radius = max(body.radius, coarsest)
    cover = (body.radius / radius) ** 2
    return [*place[:6], radius, body.roundness, pressure, cover, *velocity, body.shelter]


def _nodes(grid: Grid, axis: int, side: tuple[float, float]) -> tuple[int, int]:
    """First and last node between two places along an axis; the last before the first if there are none."""
    origin = (*grid.origin, 0.0)[axis]
    last = grid.shape[axis] - 1
    first_node = math.ceil(min(max((side[0] - origin) / grid.cell[axis], 0.0), last + 1.0))
    last_node = math.floor(min(max((side[1] - origin) / grid.cell[axis], -1.0), float(last)))
    return first_node, last_node


@njit(parallel=True, cache=True, fastmath=FAST_MATH)
def settle(rows, boxes, frame, seconds, rain, limit, departure, velocity, push, clamped):  # type: ignore[no-untyped-def]
    """Lets bodies act, adds the departure to the air, and holds back what is too fast or no number.

    Args:
        rows: (R, 14) BODY_COLUMNS.
        boxes: (R, 5) nodes that each reaches.
        frame: (5,) origin and cell of the grid, m.
        seconds: of the step.
        rain: (nx, ny) downward pressure, N/m^2.
        limit: greatest speed, m/s.
        departure: (nx, ny, nz, 4) of ``Field``, changed.
        velocity: (nx, ny, nz, 3) deflected ambient air, becomes the whole, m/s.
        push: (nx, ny, nz, 3) N/m^2, out.
        clamped: (nx,) nodes that were held back, out.
    """
    nx, ny, nz = departure.shape[:3]
    for i in prange(nx):
        for j in range(ny):
            for k in range(nz):
                push[i, j, k, 0] = _F(0.0)
                push[i, j, k, 1] = _F(0.0)
                push[i, j, k, 2] = -rain[i, j]
        for r in range(len(rows)):
            if boxes[r, 0] <= i <= boxes[r, 1]:
                _act(rows[r], boxes[r], frame, i, seconds, departure[i], velocity[i], push[i])
        slab, air = departure[i].reshape(-1, WIDTH), velocity[i].reshape(-1, 3)
        _put_to_rest(departure[i].reshape(-1))
        clamped[i] = _add_up(slab, air, limit)
        if clamped[i] > 0:
            _hold_back(slab, air, limit)


@njit(fastmath=FAST_MATH, forceinline=True)
def _act(row, box, frame, i, seconds, departure, velocity, push):  # type: ignore[no-untyped-def]
    """One body in one slab of equal x."""
    last_j, last_k = departure.shape[0] - 2, departure.shape[1] - 2
    inner = box[0] > 0 or i > 0
    x = frame[0] + _F(i) * frame[2]
    along_x, along_y = row[2] - row[0], row[3] - row[1]
    per_square = _F(1.0) / max(along_x * along_x + along_y * along_y, _F(1e-12))
    radius, per_radius = row[6], _F(1.0) / row[6]
    own = np.sqrt(row[10] * row[10] + row[11] * row[11] + row[12] * row[12])
    for j in range(box[2], box[3] + 1):
        y = frame[1] + _F(j) * frame[3]
        share = min(max(((x - row[0]) * along_x + (y - row[1]) * along_y) * per_square, _F(0.0)), _F(1.0))
        dx, dy = x - row[0] - share * along_x, y - row[1] - share * along_y
        aside = np.sqrt(dx * dx + dy * dy)
        for k in range(box[4] + 1):
            z = _F(k) * frame[4]
            above = max(max(z - row[5], row[4] - z), _F(0.0)) / row[7]
            inside = _F(1.0) - np.sqrt(aside * aside + above * above) * per_radius
            if inside <= _F(0.0):
                continue
            down = max(radius - aside, _F(0.0))
            size = row[8] * row[9] * inside / np.sqrt(dx * dx + dy * dy + down * down + _F(1e-12))
            push[j, k, 0] += size * dx
            push[j, k, 1] += size * dy
            push[j, k, 2] -= size * down
            if inner and 0 < j <= last_j and k <= last_k:
                _drag_along(row, own, inside, seconds, departure[j, k], velocity[j, k])


@njit(fastmath=FAST_MATH, forceinline=True)
def _drag_along(row, own, inside, seconds, departure, velocity):  # type: ignore[no-untyped-def]
    """Draws a node's air towards the body's velocity, within the time in which air passes the body."""
    u, v, w = velocity[0], velocity[1], velocity[2]
    rate = _F(SHEDDING) * (own + np.sqrt(u * u + v * v + w * w)) / row[6]
    # Whole in the inner half of the body, and less towards its surface.
    taken = row[9] * min(_F(2.0) * inside, _F(1.0)) * (_F(1.0) - np.exp(-rate * seconds))
    departure[0] += taken * (row[10] - departure[0])
    departure[1] += taken * (row[11] - departure[1])
    departure[2] += taken * (row[12] - departure[2])
    departure[3] += taken * max(row[13] - departure[3], _F(0.0))


@njit(fastmath=FAST_MATH, forceinline=True)
def _put_to_rest(numbers):  # type: ignore[no-untyped-def]
    """Very small numbers become 0: what dies away must not end in denormals."""
    for n in range(len(numbers)):
        numbers[n] = _F(0.0) if abs(numbers[n]) < REST else numbers[n]


@njit(fastmath=FAST_MATH, forceinline=True)
def _add_up(departure, velocity, limit):  # type: ignore[no-untyped-def]
    """Air that is not sheltered, plus departure, in the nodes of one slab; returns how many are out of bounds."""
    count = np.int32(0)
    for n in range(len(velocity)):
        free = _F(1.0) - departure[n, 3]
        u = velocity[n, 0] * free + departure[n, 0]
        v = velocity[n, 1] * free + departure[n, 1]
        w = velocity[n, 2] * free + departure[n, 2]
        velocity[n, 0], velocity[n, 1], velocity[n, 2] = u, v, w
        count += np.int32(0) if u * u + v * v + w * w <= limit * limit else np.int32(1)
    return count


@njit(fastmath=FAST_MATH, forceinline=True)
def _hold_back(departure, velocity, limit):  # type: ignore[no-untyped-def]
    """Air faster than the limit is slowed to it, air that is no number stands still; neither departs any more."""
    for n in range(len(velocity)):
        u, v, w = velocity[n, 0], velocity[n, 1], velocity[n, 2]
        speed = np.sqrt(u * u + v * v + w * w)
        if not speed <= limit:
            for c in range(3):
                velocity[n, c] = velocity[n, c] * (limit / speed) if speed < np.inf else _F(0.0)
            departure[n, :] = _F(0.0)
