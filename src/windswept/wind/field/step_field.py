"""step_field: the field some time later."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from windswept.errors import InputError
from windswept.wind.field.acts import Act, Agent, Body, Jet, Shower
from windswept.wind.field.bodies import body_rows, settle, wake_of
from windswept.wind.field.clamps import MAX_SPEED
from windswept.wind.field.field import Field, sample_ambient
from windswept.wind.field.flows import flow_into
from windswept.wind.field.grid import Floats
from windswept.wind.field.obstacles import middle
from windswept.wind.field.primitives import Primitive, running
from windswept.wind.field.transport import transport
from windswept.wind.mean import profile_factor

LONGEST_STEP = 0.05
"""Longer ones are divided, s: within it agents and air move along straight lines."""


def step_field(field: Field, seconds: float, agents: Sequence[Agent] = ()) -> Field:
    """Lets time pass; then bodies press as they do at the end, and rain as it did on the mean.

    Args:
        field: changed in place and returned.
        seconds: how long, s.
        agents: that act now, besides those of the plan.

    Raises:
        InputError: a time that is not above 0 s.
    """
    if not 0.0 < seconds < math.inf:
        raise InputError("field", "seconds", seconds, "a time above 0 s")
    count = math.ceil(seconds / LONGEST_STEP - 1e-9)
    begin = field.time
    rain = np.zeros(field.plan.grid.shape[:2], np.float32)
    for n in range(count):
        stop = begin + (n + 1) * seconds / count
        acts = _acts(field, (*field.plan.agents, *agents), stop)
        rain += _rain(field, acts) / np.float32(count)
        _step(field, stop, acts, rain)
    return field


def _step(field: Field, stop: float, acts: Sequence[Act], rain: Floats) -> None:
    """One step up to a time, in which rain presses with (nx, ny) N/m^2."""
    grid, seconds = field.plan.grid, stop - field.time
    field.time = stop
    field.ambient = sample_ambient(grid, field.wind, stop)
    field.profile = profile_factor(field.wind.profile, grid.heights).astype(np.float32)
    _blow(field, [act for act in acts if isinstance(act, Jet)])
    deflection = field.deflection
    transport(
        field.departure,
        field.ambient,
        field.profile,
        field.flow,
        deflection.column,
        deflection.tensor,
        np.array([seconds / cell for cell in grid.cell], np.float32),
        np.float32(math.exp(-field.plan.relaxation * seconds)),
        field.spare,
        field.velocity,
    )
    field.departure, field.spare = field.spare, field.departure
    bodies = [act for act in acts if isinstance(act, Body)]
    rows, boxes = body_rows(grid, [*bodies, *_wakes(field)], field.clamps)
    clamped = np.zeros(grid.shape[0], np.int64)
    settle(
        rows,
        boxes,
        np.array([*grid.origin, *grid.cell], np.float32),
        np.float32(seconds),
        rain,
        np.float32(MAX_SPEED),
        field.departure,
        field.velocity,
        field.push,
        clamped,
    )
    field.clamps.speeds += int(clamped.sum())


def _acts(field: Field, agents: Sequence[Agent], stop: float) -> list[Act]:
    """What all agents do in the step up to a time."""
    nx, ny, _ = field.plan.grid.shape
    area = field.plan.grid.cell[0] * field.plan.grid.cell[1]
    return [act for agent in agents for act in agent.acts(field.time, stop, (nx, ny), area)]


def _rain(field: Field, acts: Sequence[Act]) -> Floats:
    """(nx, ny) pressure of all showers, N/m^2."""
    rain = np.zeros(field.plan.grid.shape[:2], np.float32)
    for act in acts:
        if isinstance(act, Shower):
            rain += act.pressure
    return rain


def _blow(field: Field, jets: Sequence[Jet]) -> None:
    """Brings the flow of primitives and jets up to date, and sends fronts off where primitives begin or end."""
    primitives = field.plan.primitives
    now = running(primitives, field.time)
    begun, ended = now - field.running, field.running - now
    field.running = now
    for change, sign in ((begun, -1.0), (ended, 1.0)):
        if change:
            _flow(field, [primitives[i] for i in sorted(change)], ())
            _leave_behind(field, sign)
    _flow(field, [primitives[i] for i in sorted(now)], [jet for jet in jets if _is_sound(field, jet)])


def _flow(field: Field, primitives: Sequence[Primitive], jets: Sequence[Jet]) -> None:
    """Writes ``field.flow``."""
    needed = field.plan.grid.shape if primitives or jets else (0, 0, 0)
    if field.flow.shape[1:] != needed:
        field.flow = np.zeros((3, *needed), np.float32)
    if primitives or jets:
        flow_into(field.flow, field.plan.grid, primitives, jets, field.time)


def _leave_behind(field: Field, sign: float) -> None:
    """The air inside keeps its velocity while the flow round it changes: it departs by sign x deflected flow."""
    flow, deflection = field.flow.copy(), field.deflection
    felt = deflection.column >= 0
    tensor = deflection.tensor[deflection.column[felt], :9].reshape(-1, 3, 3, field.plan.grid.shape[2])
    flow[:, felt] = np.einsum("nabk,bnk->ank", tensor, flow[:, felt])
    inner = np.s_[1:-1, 1:-1, :-1]
    field.departure[(*inner, slice(0, 3))] += np.float32(sign) * flow[(slice(None), *inner)].transpose(
        1, 2, 3, 0
    )


def _is_sound(field: Field, jet: Jet) -> bool:
    """Whether a jet is made of numbers; counts it if not."""
    sound = all(map(math.isfinite, (*jet.place, jet.radius, jet.speed, jet.layer))) and jet.radius > 0.0
    field.clamps.lost += 0 if sound else 1
    return sound


def _wakes(field: Field) -> list[Body]:
    """Dead air behind the obstacles, as the air now blows at their middle."""
    wakes = []
    for obstacle in field.plan.obstacles:
        i, j, k = field.plan.grid.nearest(*middle(obstacle))
        air = field.ambient[i, j] * field.profile[k]
        if field.flow.size:
            air = air + field.flow[:, i, j, k]
        wake = wake_of(obstacle, air.tolist())
        wakes += [] if wake is None else [wake]
    return wakes
