"""tree-gen: ``params = {...}`` in a Python file, snake case, a list of four for the levels."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from windswept.plants.importers.draft import SpeciesDraft
from windswept.plants.importers.report import ImportReport
from windswept.plants.species_form import Growth, Level, Species

RENAMED = {"g_scale": "scale", "g_scale_v": "scale_v", "leaf_blos_num": "leaves"}
LEAF_SHAPES = {1: "oval", 2: "lance", 3: "oval", 4: "oval", 5: "round", 6: "lobed", 7: "lobed", 8: "needle"}
"""tree-gen numbers its leaves; these are the nearest of ours."""
SAME = tuple(key for key in Growth.model_fields if key != "level")


def import_tree_gen(path: Path, params: dict[str, Any]) -> tuple[Species, ImportReport]:
    """Species of a tree-gen preset.

    Args:
        path: the file.
        params: its dictionary.

    Raises:
        InputError: a value is no number.
    """
    draft = SpeciesDraft(path, "a tree-gen preset")
    for name in sorted(params, key=lambda key: key == "branches"):
        _take(draft, name, params[name])
    return draft.finish(), draft.report


def _take(draft: SpeciesDraft, name: str, value: object) -> None:
    """Take one entry."""
    key = RENAMED.get(name, name)
    if name == "branches":
        numbers = draft.numbers(name, value)
        draft.take_trunks(f"{name}[0]", numbers[0])
        for level, number in enumerate(numbers[1:], 1):
            draft.take(f"{name}[{level}]", number, "branches", level)
    elif name == "tropism" and isinstance(value, list | tuple) and len(value) == 3:
        draft.take("tropism[2]", value[2], "attraction_up")
        for axis in (0, 1):
            if draft.number(f"tropism[{axis}]", value[axis]):
                draft.skip(f"tropism[{axis}]")
    elif name == "leaf_shape":
        number = round(draft.number(name, value))
        draft.look["leaf_shape"] = LEAF_SHAPES.get(number, "oval")
        draft.report.taken.append(name)
    elif name == "base_size" and isinstance(value, list | tuple):
        sizes = draft.numbers(name, value)
        draft.take("base_size[0]", sizes[0], "base_size")
    elif key in SAME:
        draft.take(name, value, key)
    elif name in Level.model_fields:
        draft.take_levels(name, value, name)
    else:
        draft.skip(name)
