"""grow_tuft: a species of underbrush and a seed, to a tuft."""

from __future__ import annotations

import zlib
from dataclasses import replace

import numpy as np

from windswept.errors import BudgetError
from windswept.plants.check_seed import check_seed
from windswept.plants.plant import Floats
from windswept.plants.underbrush.blade import Blade, Doubles, build_blade
from windswept.plants.underbrush.form import Component, UnderbrushSpecies
from windswept.plants.underbrush.tuft import Tuft

MOST_BLADES = 20_000
"""Blades of one tuft: a meadow is made of many tufts, not of a large one."""
GROUND = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""Axis, normal and side of the ground: a blade without tilt stands up and curls towards +x."""


def grow_tuft(species: UnderbrushSpecies, seed: int = 0) -> Tuft:
    """One tuft.

    Every component draws from a stream of its own, so that a component added to the file moves no other.

    Args:
        species: what to grow.
        seed: 0 or more.

    Raises:
        InputError: a negative seed.
        BudgetError: more than MOST_BLADES blades.
    """
    check_seed(seed)
    names = [component.name for component in species.component]
    start = np.zeros(len(names) + 1, np.int64)
    columns: list[list[np.ndarray]] = []
    for kind, component in enumerate(species.component):
        rng = np.random.default_rng([seed, zlib.crc32(component.name.encode())])
        above = names.index(component.parent) if component.parent else -1
        parents = np.arange(start[above], start[above + 1]) if above >= 0 else np.array([-1])
        columns.append(_sprout(species, kind, parents, MOST_BLADES - int(start[kind]), rng))
        start[kind + 1] = start[kind] + len(columns[-1][0])
    kind_of, parent, attach, root, frame, size = (
        np.concatenate(column) for column in zip(*columns, strict=True)
    )
    tuft = Tuft(
        species=species.name,
        seed=seed,
        kinds=carrying(species),
        blade_kind=kind_of.astype(np.int32),
        blade_parent=parent.astype(np.int32),
        blade_attach=attach.astype(np.float32),
        blade_root=root.astype(np.float32),
        blade_frame=frame.astype(np.float32),
        blade_size=size.astype(np.float32),
    )
    tuft.validate()
    return tuft


def carrying(species: UnderbrushSpecies) -> tuple[Blade, ...]:
    """Blades of all components; each section has the mass and the area of what hangs on it as well."""
    blades = [build_blade(component) for component in species.component]
    names = [component.name for component in species.component]
    for kind in range(len(blades) - 1, -1, -1):
        component = species.component[kind]
        if not component.parent:
            continue
        above = names.index(component.parent)
        place = np.linspace(component.attach_from, component.attach_to, component.count)
        parent = blades[above]
        section = np.minimum((place * parent.section_count).astype(int), parent.section_count - 1)
        size = _mean_sizes(component, component.count)
        mass, area = size ** blades[kind].mass_power, size ** blades[kind].area_power
        hung_mass, hung_area = (np.bincount(section, part, parent.section_count) for part in (mass, area))
        blades[above] = replace(
            parent,
            mass=parent.mass + hung_mass * blades[kind].mass.sum(),
            area=parent.area + hung_area * blades[kind].area.sum(),
        )
    return tuple(blades)


def _sprout(
    species: UnderbrushSpecies, kind: int, parents: np.ndarray, room: int, rng: np.random.Generator
) -> list[np.ndarray]:
    """Columns of Tuft for the blades of one component on all its parents, of which there may be as many as room."""
    component = species.component[kind]
    columns: list[list[np.ndarray]] = []
    for parent in parents:
        count = component.count
        if component.count_v:
            count = max(1, count + int(rng.integers(-component.count_v, component.count_v + 1)))
        room -= count
        if room < 0:
            raise BudgetError(f"{species.name}: more than {MOST_BLADES:,} blades in a tuft")
        frame = _frames(component, count, rng)
        attach = np.linspace(component.attach_from, component.attach_to, count)
        root = np.zeros((count, 3))
        if parent < 0:
            frame, attach = frame @ GROUND, np.zeros(count)
            root[:, :2] = _roots(component, frame, rng)
        size = _mean_sizes(component, count) * (1.0 + component.length_v * rng.uniform(-1.0, 1.0, count))
        columns.append([np.full(count, kind), np.full(count, parent), attach, root, frame, size])
    return [np.concatenate(column) for column in zip(*columns, strict=True)]


def _mean_sizes(component: Component, count: int) -> Doubles:
    """(count,) size of the first to the last one on a parent."""
    return np.linspace(1.0, component.last_size, count) if component.parent else np.ones(count)


def _frames(component: Component, count: int, rng: np.random.Generator) -> Doubles:
    """(count, 3, 3) base frames in those of the parent: tilted from its axis, turned round it."""
    tilt = component.tilt_deg + component.tilt_v_deg * rng.uniform(-1.0, 1.0, count)
    yaw = rng.uniform(0.0, 360.0) + component.rotate_deg * np.arange(count)
    yaw = np.radians(yaw + component.rotate_v_deg * rng.uniform(-1.0, 1.0, count))
    return tilted_frames(np.radians(tilt), yaw)


def tilted_frames(tilt: Doubles | Floats, yaw: Doubles | Floats) -> Doubles:
    """(n, 3, 3) rows axis, normal, side: tilted (n,) from the first axis towards the yaw (n,) from the second, rad."""
    up, out = np.cos(tilt), np.sin(tilt)
    x, y = np.cos(yaw), np.sin(yaw)
    axis = np.stack([up, out * x, out * y], axis=-1)
    normal = np.stack([-out, up * x, up * y], axis=-1)
    return np.stack([axis, normal, np.cross(axis, normal)], axis=-2)


def _roots(component: Component, frame: Doubles, rng: np.random.Generator) -> Doubles:
    """(count, 2) places in the root patch, m: a blade stands on the side to which it leans."""
    outward = frame[:, 1, :2] / np.maximum(np.linalg.norm(frame[:, 1, :2], axis=1, keepdims=True), 1e-9)
    radius = 1e-3 * component.spread_mm * np.sqrt(rng.uniform(0.0, 1.0, (len(frame), 1)))
    return outward * radius
