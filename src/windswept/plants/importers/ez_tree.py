"""ez-tree: JSON with a dictionary for every quantity, keyed by level "0" to "3"; lengths are absolute.

ez-tree gives every level its own length, thickness relative to the parent's section and number of children per
branch; Weber and Penn's lengths are fractions of the parent's. A child stands on average half-way along the part
of its parent that bears any, where Weber and Penn would shorten it by 0.6 of the offset: that is divided out.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from windswept.errors import InputError
from windswept.forms.read_text import read_text, shown_path
from windswept.forms.words import shown
from windswept.plants.importers.draft import SpeciesDraft
from windswept.plants.importers.report import ImportReport
from windswept.plants.species_form import Species
from windswept.plants.weber_penn.formulas import LENGTH_FALL

LARGEST_FILE = 1 << 20
CYLINDRICAL, CONICAL = 3, 0
"""Shapes of deciduous and evergreen crowns."""
PULL = 60.0
"""AttractionUp per unit of ez-tree's force: its typical 0.01 to 0.02 then bends twigs visibly."""


def import_ez_tree(path: Path) -> tuple[Species, ImportReport]:
    """Species of an ez-tree preset.

    Raises:
        InputError: it is not JSON, or a value is no number.
    """
    draft = SpeciesDraft(path, "ez-tree JSON")
    data = _read_json(path)
    branch, leaves = _table(draft, data, "branch"), _table(draft, data, "leaves", {})
    if branch is None:
        raise InputError(draft.source, "branch", None, "this key to be given: a table of branches")
    evergreen = str(data.get("type", "")).lower() == "evergreen"
    draft.take("type", CONICAL if evergreen else CYLINDRICAL, "shape")
    levels = round(draft.number("branch.levels", branch.get("levels", 3))) + 1
    draft.take("branch.levels", levels, "levels")
    _take_lengths(draft, branch)
    _take_angles(draft, branch)
    _take_leaves(draft, leaves or {}, min(int(draft.tree["levels"]), 3))
    for table in ("bark", "trellis"):
        if table in data:
            draft.skip(table)
    return draft.finish(str(data.get("name") or "")), draft.report


def _read_json(path: Path) -> dict[str, Any]:
    """The object in a JSON file."""
    source, text = shown_path(path), read_text(path, LARGEST_FILE, "a preset")
    try:
        data = json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(source, f"line {error.lineno}", None, f"valid JSON ({error.msg})") from None
    except (ValueError, RecursionError):
        raise InputError(source, "", None, "valid JSON (a number or a nesting is too large)") from None
    if not isinstance(data, dict):
        raise InputError(source, "", shown(data), "a JSON object")
    return data


def _table(draft: SpeciesDraft, data: dict[str, Any], key: str, default: Any = None) -> dict[str, Any] | None:
    """A table inside the file."""
    value = data.get(key, default)
    if value is not None and not isinstance(value, dict):
        raise InputError(draft.source, key, shown(value), "a table")
    return value


def _levels(draft: SpeciesDraft, branch: dict[str, Any], key: str) -> dict[int, float]:
    """Numbers of a quantity by level."""
    table = _table(draft, branch, key, {}) or {}
    wanted = {str(i): i for i in range(4)}
    for name in table:
        if name not in wanted:
            draft.skip(f"branch.{key}.{name}"[:60])
    return {
        level: draft.number(f"branch.{key}.{name}", table[name])
        for name, level in wanted.items()
        if name in table
    }


def _take_lengths(draft: SpeciesDraft, branch: dict[str, Any]) -> None:
    """Absolute lengths and relative radii as Weber and Penn's fractions."""
    length, radius = _levels(draft, branch, "length"), _levels(draft, branch, "radius")
    start, children = _levels(draft, branch, "start"), _levels(draft, branch, "children")
    trunk = max(length.get(0, 10.0), 1e-3)
    draft.take("branch.length.0", trunk, "scale")
    draft.take("branch.radius.0", radius.get(0, 0.02 * trunk) / trunk, "ratio")
    draft.take("branch.start.1", start.get(1, 0.0), "base_size")
    draft.levels[0]["length"] = 1.0
    for level in range(1, 4):
        if level not in length:
            continue
        ratio = max(length[level], 0.0) / max(length.get(level - 1, trunk), 1e-3)
        shortening = 1.0 - LENGTH_FALL * 0.5 * (1.0 + start.get(level, 0.0)) if level > 1 else 1.0
        draft.take(f"branch.length.{level}", ratio / max(shortening, 0.1), "length", level)
        if level - 1 in children:
            draft.take(f"branch.children.{level - 1}", children[level - 1], "branches", level)
    if 1 in length and 0 < length[1] < trunk and 0 < radius.get(1, 0.0) < 1:
        power = math.log(radius[1]) / math.log(length[1] / trunk)
        draft.take("branch.radius.1", power, "ratio_power")


def _take_angles(draft: SpeciesDraft, branch: dict[str, Any]) -> None:
    """Angles, sections, taper and the growth force."""
    for level, angle in _levels(draft, branch, "angle").items():
        if level:
            draft.take(f"branch.angle.{level}", angle, "down_angle", level)
            draft.levels[level] |= {"down_angle_v": 8.0, "rotate": 137.5, "rotate_v": 20.0}
    sections = _levels(draft, branch, "sections")
    for level, count in sections.items():
        draft.take(f"branch.sections.{level}", count, "curve_res", level)
    for level, gnarl in _levels(draft, branch, "gnarliness").items():
        wander = math.degrees(abs(gnarl)) * math.sqrt(max(sections.get(level, 8.0), 1.0))
        draft.take(f"branch.gnarliness.{level}", wander, "curve_v", level)
    for level, taper in _levels(draft, branch, "taper").items():
        draft.take(f"branch.taper.{level}", min(max(taper, 0.0), 1.0), "taper", level)
    force = _table(draft, branch, "force", {}) or {}
    direction = _table(draft, force, "direction", {}) or {}
    if "strength" in force:
        up = draft.number("branch.force.direction.y", direction.get("y", 1.0))
        strength = draft.number("branch.force.strength", force["strength"])
        draft.take("branch.force", PULL * strength * (1.0 if up >= 0 else -1.0), "attraction_up")
    for key in branch:
        if key in ("twist", "segments"):
            draft.skip(f"branch.{key}")


def _take_leaves(draft: SpeciesDraft, leaves: dict[str, Any], level: int) -> None:
    """Leaves: a count for every last branch, a size, an angle."""
    for key, value in leaves.items():
        place = f"leaves.{key}"[:60]
        if key == "count":
            draft.take(place, value, "leaves")
        elif key == "size":
            draft.take(place, value, "leaf_scale")
        elif key == "angle":
            draft.take(place, value, "down_angle", level)
        elif key == "tint" and isinstance(value, int) and 0 <= value < 1 << 24:
            draft.skip(place)
        else:
            draft.skip(place)
