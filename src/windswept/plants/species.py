"""Reads species files and says in one line what is wrong with a bad one."""

from __future__ import annotations

from pathlib import Path

from windswept.errors import InputError
from windswept.forms.check_form import check_form
from windswept.forms.read_text import shown_path
from windswept.forms.read_toml import read_toml
from windswept.forms.words import nearest, one_line
from windswept.plants.species_form import Growth, Species

__all__ = ["LARGEST_FILE", "Species", "check_lengths", "load_species", "species_names"]

LARGEST_FILE = 1 << 20
"""A species file is a page of text; anything above this many bytes is not one."""

_FOLDER = Path(__file__).parent / "species"


def species_names() -> list[str]:
    """Names of the built-in species that grow alone, sorted; `underbrush_names` has those that grow in scenes."""
    return sorted(path.stem for path in _FOLDER.glob("*.toml"))


def load_species(source: str | Path) -> Species:
    """Read a species.

    Args:
        source: name of a built-in species, or path of a .toml file.

    Raises:
        InputError: there is no such species or the file holds none; says where and what was expected.
    """
    path, shown = _find(source), shown_path(source)
    tables = read_toml(path, LARGEST_FILE, "a species file")
    if tables.get("kind") == "underbrush":
        raise InputError(
            shown, "kind", "underbrush", "a plant that grows alone; underbrush is grown into scenes"
        )
    species = check_form(shown, Species, tables)
    check_lengths(shown, species.growth)
    return species


def _find(source: str | Path) -> Path:
    """Path of the file that a name or path means."""
    if isinstance(source, Path) or source.lower().endswith(".toml") or "/" in source or "\\" in source:
        return Path(source)
    if source in species_names():
        return _FOLDER / f"{source}.toml"
    hint = nearest(source, species_names())
    raise InputError(
        one_line(source) or "species", "", None, f"a built-in species or the path of a .toml file: {hint}"
    )


def check_lengths(source: str, growth: Growth) -> None:
    """Raise InputError where an order grows stems and neither its own nor the last table gives a length."""
    for order in range(growth.levels):
        table = min(order, len(growth.level) - 1)
        if growth.level[table].length == 0:
            place = f"growth.level[{table}].length"
            raise InputError(source, place, 0.0, f"a length above 0, as growth.levels = {growth.levels}")
