"""Plants of a stated size for benchmarks: real crowns cut to an exact number of links."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from windswept.plants.plant import Plant
from windswept.plants.species import load_species
from windswept.plants.weber_penn import grow


def plant_with_links(count: int, seed: int = 0) -> Plant:
    """A black tupelo with its first ``count`` links in depth-first order; its twigs are divided until it has enough.

    Args:
        count: number of links, up to about 80,000.
        seed: of the tree.
    """
    species = load_species("black_tupelo")
    plant = grow(species, seed)
    if plant.link_count < count:
        levels = [level.model_copy() for level in species.growth.level]
        levels[-1] = levels[-1].model_copy(update={"curve_res": 8})
        growth = species.growth.model_copy(update={"level": levels})
        plant = grow(species.model_copy(update={"growth": growth}), seed)
    return cut_to_links(plant, count)


def cut_to_links(plant: Plant, count: int) -> Plant:
    """The plant's first ``count`` links in depth-first order, with the stems and leaves that they carry."""
    if plant.link_count < count:
        raise ValueError(f"the plant has {plant.link_count} links, fewer than {count}")
    stems = int(plant.link_stem[count - 1]) + 1
    leaves = int(np.searchsorted(plant.leaf_link, count))
    changes: dict[str, np.ndarray] = {}
    for name in plant.__dataclass_fields__:
        value = getattr(plant, name)
        if isinstance(value, np.ndarray):
            kept = {"stem": stems, "link": count, "leaf": leaves}[name.split("_")[0]]
            changes[name] = value[:kept]
    changes["stem_link_start"] = np.minimum(plant.stem_link_start[: stems + 1], count).astype(np.int32)
    return replace(plant, **changes)  # type: ignore[arg-type]
