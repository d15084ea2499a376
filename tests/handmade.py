"""Plants made by hand for tests: chains, forks and random small trees, in the order that Plant asks for."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from windswept.plants.plant import Look, Material, Plant

BARE_STIFF = Material(leaf_mass=0.2, damping_ratio=0.05)


@dataclass
class Stem:
    """One stem: nodes (n+1, 3), radii (n+1,), and child stems as (link index, fraction along it, Stem)."""

    nodes: np.ndarray
    radii: np.ndarray
    children: list[tuple[int, float, Stem]] = field(default_factory=list)
    leaves: int = 0
    order: int = 0


def straight(
    length: float,
    links: int,
    radius: float,
    tip_radius: float | None = None,
    direction: tuple[float, float, float] = (0.0, 0.0, 1.0),
    origin: np.ndarray | None = None,
    **more: object,
) -> Stem:
    way = np.array(direction, float) / np.linalg.norm(direction)
    start = np.zeros(3) if origin is None else origin
    nodes = start + np.linspace(0.0, length, links + 1)[:, None] * way
    radii = np.linspace(radius, radius if tip_radius is None else tip_radius, links + 1)
    return Stem(nodes, radii, **more)  # type: ignore[arg-type]


def random_stem(
    rng: np.random.Generator, origin: np.ndarray, direction: np.ndarray, order: int, last: int
) -> Stem:
    links = int(rng.integers(2, 5))
    length = 3.0 * 0.5**order * rng.uniform(0.7, 1.3)
    steps = direction + 0.25 * rng.standard_normal((links, 3))
    steps *= length / links / np.linalg.norm(steps, axis=1)[:, None]
    nodes = origin + np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])
    stem = Stem(nodes, 0.05 * 0.45**order * np.linspace(1.0, 0.4, links + 1), order=order)
    if order == last:
        stem.leaves = 4
        return stem
    for link in sorted(rng.integers(0, links, size=4), reverse=True):
        fraction = float(rng.uniform(0.2, 1.0))
        base = nodes[link] + fraction * (nodes[link + 1] - nodes[link])
        side = rng.standard_normal(3)
        child = random_stem(rng, base, side / np.linalg.norm(side) + 0.4 * direction, order + 1, last)
        stem.children.append((int(link), fraction, child))
    return stem


def random_tree(seed: int, orders: int = 3, material: Material = BARE_STIFF) -> Plant:
    rng = np.random.default_rng(seed)
    return build_plant(random_stem(rng, np.zeros(3), np.array([0.0, 0.0, 1.0]), 0, orders - 1), material)


def with_leaves(plant: Plant, count: int) -> Plant:
    """The same plant with its first ``count`` leaves alone."""
    names = ("link", "position", "axis", "normal", "length", "width")
    return replace(plant, **{f"leaf_{name}": getattr(plant, f"leaf_{name}")[:count] for name in names})


def build_plant(
    trunk: Stem, material: Material = BARE_STIFF, leaf_size: tuple[float, float] = (0.1, 0.08)
) -> Plant:
    stems: list[tuple[int, int, float, Stem]] = []  # parent stem, parent link, attach, stem
    link_start = [0]

    def walk(parent: int, parent_link: int, attach: float, stem: Stem) -> None:
        index = len(stems)
        stems.append((parent, parent_link, attach, stem))
        first = link_start[-1]
        link_start.append(first + len(stem.nodes) - 1)
        for link, fraction, child in sorted(stem.children, key=lambda c: (-c[0], -c[1])):
            walk(index, first + link, fraction, child)

    walk(-1, -1, 1.0, trunk)
    link_parent, link_stem, attach, base, tip, r0, r1 = [], [], [], [], [], [], []
    leaf_link, leaf_position, leaf_axis, leaf_normal = [], [], [], []
    for index, (_, parent_link, fraction, stem) in enumerate(stems):
        for k in range(len(stem.nodes) - 1):
            link = len(link_parent)
            link_parent.append(parent_link if k == 0 else link - 1)
            attach.append(fraction if k == 0 else 1.0)
            link_stem.append(index)
            base.append(stem.nodes[k])
            tip.append(stem.nodes[k + 1])
            r0.append(stem.radii[k])
            r1.append(stem.radii[k + 1])
            way = (tip[-1] - base[-1]) / np.linalg.norm(tip[-1] - base[-1])
            side = np.cross(way, [0.3, 0.5, 0.8])
            side /= np.linalg.norm(side)
            for leaf in range(stem.leaves):
                leaf_link.append(link)
                leaf_position.append(base[-1] + (leaf + 0.5) / stem.leaves * (tip[-1] - base[-1]))
                leaf_axis.append(side if leaf % 2 else -side)
                leaf_normal.append(np.cross(way, side))

    def ints(values: object) -> np.ndarray:
        return np.asarray(values, np.int32)

    def floats(values: object, columns: int = 0) -> np.ndarray:
        array = np.asarray(values, np.float32)
        return array.reshape(-1, columns) if columns else array

    count = len(leaf_link)
    lengths = [float(np.linalg.norm(np.diff(s.nodes, axis=0), axis=1).sum()) for *_, s in stems]
    return Plant(
        species="handmade",
        seed=0,
        material=material,
        look=Look(),
        stem_parent=ints([p for p, *_ in stems]),
        stem_order=ints([s.order for *_, s in stems]),
        stem_link_start=ints(link_start),
        stem_radius=floats([s.radii[0] for *_, s in stems]),
        stem_taper=floats([1.0 - s.radii[-1] / s.radii[0] for *_, s in stems]),
        stem_flare=floats(np.zeros(len(stems))),
        stem_lobes=floats(np.zeros(len(stems))),
        stem_lobe_depth=floats(np.zeros(len(stems))),
        stem_full_length=floats(lengths),
        stem_taper_start=floats(np.zeros(len(stems))),
        link_parent=ints(link_parent),
        link_stem=ints(link_stem),
        link_base=floats(base, 3),
        link_tip=floats(tip, 3),
        link_attach=floats(attach),
        link_radius_base=floats(r0),
        link_radius_tip=floats(r1),
        leaf_link=ints(leaf_link),
        leaf_position=floats(leaf_position, 3),
        leaf_axis=floats(leaf_axis, 3),
        leaf_normal=floats(leaf_normal, 3),
        leaf_length=floats(np.full(count, leaf_size[0])),
        leaf_width=floats(np.full(count, leaf_size[1])),
    )
