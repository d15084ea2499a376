"""A species on its way from a foreign file: collects values, keeps them in range, and reports."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from annotated_types import Ge, Gt, Le
from pydantic import BaseModel

from windswept.errors import InputError
from windswept.forms.check_form import check_form
from windswept.forms.read_text import shown_path
from windswept.forms.words import shown
from windswept.plants.importers.report import ImportReport
from windswept.plants.species import check_lengths
from windswept.plants.species_form import Growth, Level, Species

LEVELS = 4
"""Per-level values come in fours."""
MOST_ENTRIES = 200
"""Keys of a file that a report names; a file with more unknown ones is not a preset."""
TREE_DEFAULTS: dict[str, Any] = {"shape": 0, "levels": 3, "scale": 10.0, "ratio": 0.02}
LEVEL_DEFAULTS: tuple[dict[str, Any], ...] = (
    {"length": 1.0, "curve_res": 8},
    {"length": 0.5, "curve_res": 5, "branches": 20, "down_angle": 50.0, "rotate": 137.5},
    {"length": 0.4, "curve_res": 3, "branches": 10, "down_angle": 45.0, "rotate": 137.5},
    {"length": 0.4, "curve_res": 1, "branches": 5, "down_angle": 45.0, "rotate": 137.5},
)


class SpeciesDraft:
    """Growth values as they come in.

    Args:
        path: the foreign file.
        format_name: which kind it is, for the report.
    """

    def __init__(self, path: Path, format_name: str) -> None:
        self.source = shown_path(path)
        self.stem = path.stem
        self.report = ImportReport(format_name)
        self.tree: dict[str, Any] = {}
        self.levels: list[dict[str, Any]] = [{} for _ in range(LEVELS)]
        self.look: dict[str, Any] = {}
        self._trunks = 1

    def take(self, place: str, value: object, key: str, level: int | None = None) -> None:
        """Put a number of the file into the form; out of range it is clamped, and the report says so.

        Args:
            place: what the file calls it, for errors and the report.
            value: a number, or a text that is one.
            key: field of Growth, or of Level.
            level: which level; None for Growth.
        """
        number = self.number(place, value)
        form: type[BaseModel] = Growth if level is None else Level
        kept = _in_range(form, key, number)
        if not math.isclose(kept, number, rel_tol=1e-9):
            self.report.clamped.append(f"{place} {number:g} -> {kept:g}")
        (self.tree if level is None else self.levels[level])[key] = kept
        self._took(place)

    def number(self, place: str, value: object) -> float:
        """A finite number.

        Raises:
            InputError: it is none.
        """
        wanted = "a finite number"
        if isinstance(value, bool) or not isinstance(value, int | float | str):
            raise InputError(self.source, place, shown(value), wanted)
        try:
            number = float(value)
        except (ValueError, OverflowError):
            raise InputError(self.source, place, shown(value), wanted) from None
        if not math.isfinite(number):
            raise InputError(self.source, place, shown(value), wanted)
        return number

    def numbers(self, place: str, value: object) -> list[float]:
        """One to four numbers for the levels; a single one serves all.

        Raises:
            InputError: the value is neither a number nor a list of one to four.
        """
        if not isinstance(value, list | tuple):
            return [self.number(place, value)] * LEVELS
        if not 1 <= len(value) <= LEVELS + 1:
            raise InputError(self.source, place, shown(value), "a number for each of 1 to 4 levels")
        return [self.number(f"{place}[{i}]", item) for i, item in enumerate(value)][:LEVELS]

    def take_levels(self, place: str, value: object, key: str) -> None:
        """Put a list of the file into one field of every level."""
        for level, number in enumerate(self.numbers(place, value)):
            self.take(f"{place}[{level}]", number, key, level)

    def skip(self, place: str) -> None:
        """Note a key that has no counterpart."""
        if len(self.report.without_counterpart) >= MOST_ENTRIES:
            raise InputError(self.source, "", None, f"{self.report.format} (too many unknown keys)")
        self.report.without_counterpart.append(place if len(place) <= 60 else place[:57] + "...")

    def take_trunks(self, place: str, value: object) -> None:
        """Several trunks from one foot: here they part at the end of a first, short segment."""
        trunks = round(self.number(place, value))
        if trunks > 1:
            splits = self.tree.get("base_splits", 0) + trunks - 1
            self.tree["base_splits"] = int(_in_range(Growth, "base_splits", splits))
            self._trunks = min(trunks, self.tree["base_splits"] + 1)
            self.report.clamped.append(f"{place} {trunks:g} trunks -> {self.tree['base_splits']} base_splits")
            trunk = self.levels[0]
            trunk.setdefault("split_angle", trunk.get("down_angle", 0.0))
            trunk.setdefault("split_angle_v", abs(trunk.get("down_angle_v", 0.0)))
        self._took(place)

    def finish(self, name: str = "", colours: Mapping[str, Any] | None = None) -> Species:
        """The species.

        Args:
            name: what the file calls it; "" for the file's own name.
            colours: further keys of the look.

        Raises:
            InputError: the file held nothing that a tree could grow from.
        """
        if not self.report.taken:
            raise InputError(self.source, "", None, f"{self.report.format} with parameters of a tree")
        tree = {**TREE_DEFAULTS, **self.tree}
        self._cut_empty_levels(tree)
        self._share_among_trunks(tree)
        tree["level"] = [LEVEL_DEFAULTS[i] | _positive_length(i, own) for i, own in enumerate(self.levels)]
        self._note_defaults(tree)
        title = " ".join((name or self.stem).split())[:100] or "imported plant"
        data = {
            "name": identifier(title),
            "common_name": title,
            "summary": f"imported from {self.report.format}",
            "growth": tree,
            "look": self.look | dict(colours or {}),
        }
        species = check_form(self.source, Species, data)
        check_lengths(self.source, species.growth)
        return species

    def _took(self, place: str) -> None:
        self.report.taken.append(place)

    def _cut_empty_levels(self, tree: dict[str, Any]) -> None:
        """Stems without length do not grow: their order and those after it are left out."""
        for order in range(1, tree["levels"]):
            if self.levels[order].get("length") == 0:
                self.report.clamped.append(f"levels {tree['levels']} -> {order} (length 0 on level {order})")
                tree["levels"] = order
                return

    def _share_among_trunks(self, tree: dict[str, Any]) -> None:
        """Trunks have their own branches or leaves in the file, but share them here."""
        if self._trunks > 1 and tree["levels"] > 1:
            own = self.levels[1].get("branches", LEVEL_DEFAULTS[1]["branches"])
            self.levels[1]["branches"] = int(_in_range(Level, "branches", own * self._trunks))
        elif self._trunks > 1 and tree.get("leaves", 0) > 0:
            tree["leaves"] = int(_in_range(Growth, "leaves", tree["leaves"] * self._trunks))

    def _note_defaults(self, tree: dict[str, Any]) -> None:
        """Name what the file did not give."""
        mechanics = ["material"]
        own = [key for key in Growth.model_fields if key != "level" and key not in self.tree]
        used = range(min(tree["levels"], LEVELS - 1) + 1)
        levels = [f"level[{i}].{key}" for i in used for key in LEVEL_DEFAULTS[i] if key not in self.levels[i]]
        self.report.defaulted.extend(mechanics + own + levels)


def identifier(text: str) -> str:
    """A name that a species may have, as near as can be to a text."""
    plain = re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")
    return (plain if plain[:1].isalpha() else f"plant_{plain}".rstrip("_"))[:64]


def _positive_length(order: int, own: dict[str, Any]) -> dict[str, Any]:
    """A trunk has a length whatever a file says; the other orders without one are cut already."""
    return {key: value for key, value in own.items() if order or key != "length" or value > 0}


def _in_range(form: type[BaseModel], key: str, number: float) -> float:
    """The nearest value that a field accepts."""
    info = form.model_fields[key]
    low: float = next((item.ge for item in info.metadata if isinstance(item, Ge)), -math.inf)  # type: ignore[assignment]
    above: float = next((item.gt for item in info.metadata if isinstance(item, Gt)), -math.inf)  # type: ignore[assignment]
    high: float = next(item.le for item in info.metadata if isinstance(item, Le))  # type: ignore[assignment]
    number = min(max(number, low, above + 1e-3), high)
    return round(number) if info.annotation is int else number
