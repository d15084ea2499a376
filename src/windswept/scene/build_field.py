"""From the field tables of a scene file to a FieldPlan."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from windswept.errors import InputError
from windswept.scene.field_form import AgentForm, FieldForm, ObstacleForm, PrimitiveForm
from windswept.wind.field import (
    Ball,
    Box,
    Cylinder,
    FieldPlan,
    Grid,
    Helicopter,
    Line,
    Path,
    Rain,
    Spheroid,
    Uniform,
    Walker,
)
from windswept.wind.field.acts import Agent
from windswept.wind.field.grid import MOST_NODES
from windswept.wind.field.obstacles import Obstacle
from windswept.wind.field.primitives import Primitive

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
KEYS_OF_AGENTS = {
    "ball": {"stop", "radius_m", "pressure_n_m2"},
    "person": {"stop", "mass_kg"},
    "helicopter": {"stop", "radius_m", "mass_kg"},
    "rain": {"rate_mm_h", "drop_mm", "start_s", "end_s"},
}
"""What may be said of each kind."""
KEYS_OF_OBSTACLES = {
    "sphere": {"radius_m", "bottom_m"},
    "crown": {"radius_m", "bottom_m", "top_m"},
    "post": {"radius_m", "bottom_m", "top_m"},
    "box": {"size_m", "top_m", "yaw_degrees"},
}
KEYS_OF_LINES = {"position", "strength_m2_s", "core_m", "axis", "drift_m_s"}
KEYS_OF_PRIMITIVES = dict.fromkeys(("source", "sink", "vortex"), KEYS_OF_LINES) | {
    "uniform": {"velocity_m_s"}
}


def build_field(source: str, form: FieldForm, size: float, seed: int) -> FieldPlan:
    """The field of a scene.

    Args:
        source: the scene file, for error messages.
        form: its [field] table.
        size: edge of the ground, m.
        seed: of the rain.

    Raises:
        InputError: keys that contradict each other, an area off the ground, or too many nodes.
    """
    return FieldPlan(
        grid=_build_grid(source, form, size),
        primitives=tuple(
            _build_primitive(source, f"field.primitive[{i}]", one) for i, one in enumerate(form.primitive)
        ),
        obstacles=tuple(
            _build_obstacle(source, f"field.obstacle[{i}]", one) for i, one in enumerate(form.obstacle)
        ),
        agents=tuple(
            _build_agent(source, f"field.agent[{i}]", one, seed + i) for i, one in enumerate(form.agent)
        ),
        relaxation=form.relaxation_per_s,
    )


def _build_grid(source: str, form: FieldForm, size: float) -> Grid:
    """Nodes over the area, the last at or just beyond its border."""
    half = 0.5 * size
    west, south, east, north = form.area or (-half, -half, half, half)
    if not (west < east and south < north):
        raise InputError(source, "field.area", list(form.area or ()), "west below east and south below north")
    if max(abs(west), abs(south), abs(east), abs(north)) > half:
        expected = f"an area on the ground, x and y from {-half:g} to {half:g}"
        raise InputError(source, "field.area", list(form.area or ()), expected)
    lengths = (east - west, north - south, form.height_m)
    cell = (form.cell_m, form.cell_m, form.layer_m)
    nx, ny, nz = (max(math.ceil(a / c - 1e-9) + 1, 4) for a, c in zip(lengths, cell, strict=True))
    if nx * ny * nz > MOST_NODES:
        coarser = math.ceil(102.0 * form.cell_m * math.sqrt(nx * ny * nz / MOST_NODES)) / 100.0
        expected = f"at least {coarser:g} for a field of at most {MOST_NODES:,} nodes, not {nx * ny * nz:,}"
        raise InputError(source, "field.cell_m", form.cell_m, expected)
    return Grid((west, south), cell, (nx, ny, nz))


def _build_primitive(source: str, place: str, form: PrimitiveForm) -> Primitive:
    """One flow primitive."""
    _check_keys(source, place, form, KEYS_OF_PRIMITIVES)
    start, end = _span(source, place, form)
    if form.kind == "uniform":
        _check_given(source, place, form, ("velocity_m_s",))
        assert form.velocity_m_s is not None
        return Uniform(form.velocity_m_s, start, end)
    _check_given(source, place, form, ("position", "strength_m2_s"))
    assert form.position is not None
    assert form.strength_m2_s is not None
    if form.kind != "vortex" and form.strength_m2_s < 0.0:
        other = "sink" if form.kind == "source" else "source"
        expected = f'a number of 0 or more, or kind = "{other}"'
        raise InputError(source, f"{place}.strength_m2_s", form.strength_m2_s, expected)
    return Line(
        position=form.position,
        source={"source": 1.0, "sink": -1.0, "vortex": 0.0}[form.kind] * form.strength_m2_s,
        vortex=form.strength_m2_s if form.kind == "vortex" else 0.0,
        core=form.core_m,
        axis=AXES[form.axis],
        drift=form.drift_m_s,
        start=start,
        end=end,
    )


def _build_obstacle(source: str, place: str, form: ObstacleForm) -> Obstacle:
    """One obstacle."""
    _check_keys(source, place, form, KEYS_OF_OBSTACLES)
    _check_given(source, place, form, ("size_m" if form.kind == "box" else "radius_m",))
    radius = form.radius_m or 0.0
    if form.kind == "sphere":
        return Spheroid((*form.position, form.bottom_m + radius), radius, radius, form.openness)
    _check_given(source, place, form, ("top_m",))
    assert form.top_m is not None
    if not form.top_m > form.bottom_m:
        expected = f"a height above bottom_m = {form.bottom_m:g}"
        raise InputError(source, f"{place}.top_m", form.top_m, expected)
    if form.kind == "crown":
        middle, half = 0.5 * (form.top_m + form.bottom_m), 0.5 * (form.top_m - form.bottom_m)
        return Spheroid((*form.position, middle), radius, half, form.openness)
    if form.kind == "post":
        return Cylinder(form.position, radius, form.top_m, form.bottom_m, form.openness)
    assert form.size_m is not None
    return Box(form.position, form.size_m, form.top_m, math.radians(form.yaw_degrees), form.openness)


def _build_agent(source: str, place: str, form: AgentForm, seed: int) -> Agent:
    """One agent."""
    _check_keys(source, place, form, KEYS_OF_AGENTS)
    if form.kind == "rain":
        _check_given(source, place, form, ("rate_mm_h",))
        assert form.rate_mm_h is not None
        return Rain(form.rate_mm_h, form.drop_mm, seed, *_span(source, place, form))
    path = _build_path(source, place, form)
    if form.kind == "person":
        return Walker(path, **_given(mass=form.mass_kg))
    if form.kind == "ball":
        return Ball(path, **_given(radius=form.radius_m, pressure=form.pressure_n_m2))
    return Helicopter(path, **_given(mass=form.mass_kg, rotor_radius=form.radius_m))


def _build_path(source: str, place: str, form: AgentForm) -> Path:
    """The way of an agent from stop to stop."""
    if len(form.stop) < 2:
        raise InputError(source, f"{place}.stop", len(form.stop), "two stops or more")
    times = np.array([stop.time_s for stop in form.stop])
    for i in np.flatnonzero(np.diff(times) <= 0.0) + 1:
        raise InputError(
            source, f"{place}.stop[{i}].time_s", float(times[i]), f"a time after {times[i - 1]:g}"
        )
    return Path(times, np.array([stop.position for stop in form.stop]))


def _span(source: str, place: str, form: PrimitiveForm | AgentForm) -> tuple[float, float]:
    """Start and end, s."""
    start = -math.inf if form.start_s is None else form.start_s
    end = math.inf if form.end_s is None else form.end_s
    if not end > start:
        raise InputError(source, f"{place}.end_s", form.end_s, f"a time after start_s = {start:g}")
    return start, end


def _check_keys(
    source: str, place: str, form: PrimitiveForm | ObstacleForm | AgentForm, keys: dict[str, set[str]]
) -> None:
    """Refuses keys that belong to another kind."""
    others = set().union(*keys.values()) - keys[form.kind]
    for key in sorted(form.model_fields_set & others):
        own = ", ".join(sorted(keys[form.kind]))
        raise InputError(source, f"{place}.{key}", None, f"no such key of a {form.kind}: it takes {own}")


def _check_given(
    source: str, place: str, form: PrimitiveForm | ObstacleForm | AgentForm, keys: Sequence[str]
) -> None:
    """Refuses a kind without the keys that it needs."""
    for key in keys:
        if getattr(form, key) is None:
            raise InputError(source, f"{place}.{key}", None, f"this key to be given for a {form.kind}")


def _given(**values: float | None) -> dict[str, Any]:
    """Those that are not left out."""
    return {name: value for name, value in values.items() if value is not None}
