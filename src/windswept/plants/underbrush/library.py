"""Reads species files of underbrush and says in one line what is wrong with a bad one."""

from __future__ import annotations

from pathlib import Path

from windswept.errors import InputError
from windswept.forms.check_form import check_form
from windswept.forms.read_text import shown_path
from windswept.forms.read_toml import read_toml
from windswept.forms.words import nearest, one_line
from windswept.plants.species import LARGEST_FILE
from windswept.plants.underbrush.form import UnderbrushSpecies

_FOLDER = Path(__file__).parent / "species"


def underbrush_names() -> list[str]:
    """Names of the built-in underbrush, sorted."""
    return sorted(path.stem for path in _FOLDER.glob("*.toml"))


def load_underbrush(source: str | Path) -> UnderbrushSpecies:
    """Read a species of underbrush.

    Args:
        source: name of a built-in one, or path of a .toml file.

    Raises:
        InputError: there is no such species or the file holds none; says where and what was expected.
    """
    path, shown = _find(source), shown_path(source)
    species = check_form(shown, UnderbrushSpecies, read_toml(path, LARGEST_FILE, "a species file"))
    _check_parents(shown, species)
    return species


MOST_DEPTH = 8
"""Components that one blade may carry one on another; the drawing poses them depth by depth."""


def _find(source: str | Path) -> Path:
    """Path of the file that a name or path means."""
    if isinstance(source, Path) or source.lower().endswith(".toml") or "/" in source or "\\" in source:
        return Path(source)
    if source in underbrush_names():
        return _FOLDER / f"{source}.toml"
    expected = f"built-in underbrush or the path of a .toml file: {nearest(source, underbrush_names())}"
    raise InputError(one_line(source) or "species", "", None, expected)


def _check_parents(source: str, species: UnderbrushSpecies) -> None:
    """Raise InputError for a name given twice, and for a parent that does not come before what it carries."""
    known: list[str] = []
    depth: dict[str, int] = {}
    for number, component in enumerate(species.component):
        place = f"component[{number}]"
        if component.name in known:
            raise InputError(source, f"{place}.name", component.name, "a name that no other component has")
        if component.parent and component.parent not in known:
            expected = (
                f"a component above it ({', '.join(known)})" if known else "no parent on the first component"
            )
            raise InputError(source, f"{place}.parent", component.parent, expected)
        depth[component.name] = depth.get(component.parent, -1) + 1
        if depth[component.name] >= MOST_DEPTH:
            expected = f"at most {MOST_DEPTH} components one on another"
            raise InputError(source, f"{place}.parent", component.parent, expected)
        known.append(component.name)
