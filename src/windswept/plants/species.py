"""Reads species files and says in one line what is wrong with a bad one."""

from __future__ import annotations

import difflib
import re
import reprlib
import tomllib
from pathlib import Path
from typing import Any, get_args, get_origin

from annotated_types import Ge, Le
from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from windswept.errors import InputError
from windswept.plants.species_form import Growth, Level, LookForm, MaterialForm, Species

__all__ = ["LARGEST_FILE", "Species", "load_species", "species_names"]

LARGEST_FILE = 1 << 20
"""A species file is a page of text; anything above this many bytes is not one."""

LONGEST_VALUE = 60
"""Longer values are shortened in messages, characters."""

_FOLDER = Path(__file__).parent / "species"
_TABLES: dict[tuple[str, ...], type[BaseModel]] = {
    (): Species,
    ("growth",): Growth,
    ("growth", "level"): Level,
    ("material",): MaterialForm,
    ("look",): LookForm,
}


def species_names() -> list[str]:
    """Names of the built-in species, sorted."""
    return sorted(path.stem for path in _FOLDER.glob("*.toml"))


def load_species(source: str | Path) -> Species:
    """Read a species.

    Args:
        source: name of a built-in species, or path of a .toml file.

    Raises:
        InputError: there is no such species or the file holds none; says where and what was expected.
    """
    path, shown = _find(source), " ".join(str(source).splitlines())
    data = _parse(shown, _read_text(shown, path))
    try:
        species = Species.model_validate(data)
    except ValidationError as error:
        raise _input_error(shown, error) from None
    _check_lengths(shown, species.growth)
    return species


def _find(source: str | Path) -> Path:
    """Path of the file that a name or path means."""
    names = species_names()
    if isinstance(source, Path) or source.lower().endswith(".toml") or "/" in source or "\\" in source:
        return Path(source)
    if source in names:
        return _FOLDER / f"{source}.toml"
    hint = _hint(source, names) or f"; there are {', '.join(names)}"
    raise InputError(
        _one_line(source) or "species", "", None, f"a built-in species or the path of a .toml file{hint}"
    )


def _read_text(source: str, path: Path) -> str:
    """Text of a file that is small enough and UTF-8."""
    try:
        if path.exists() and not path.is_file():
            raise InputError(source, "", None, "a .toml file, not a directory or a device")
        if path.stat().st_size > LARGEST_FILE:
            raise InputError(source, "", None, f"a species file of at most {LARGEST_FILE:,} bytes")
        return path.read_bytes().decode("utf-8")
    except FileNotFoundError:
        raise InputError(source, "", None, "a file that exists") from None
    except UnicodeDecodeError as error:
        raise InputError(source, f"byte {error.start}", None, "UTF-8 text") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(source, "", None, f"a readable file ({reason})") from None


def _parse(source: str, text: str) -> dict[str, Any]:
    """Tables of a TOML text."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        reason = re.sub(r"\s*\(at .*\)$", "", str(error))
        line = re.search(r"line (\d+)", str(error))
        place = f"line {line[1]}" if line else f"line {text.count(chr(10)) + 1}"
        raise InputError(source, place, None, f"valid TOML ({_one_line(reason)})") from None
    except (ValueError, RecursionError):
        raise InputError(source, "", None, "valid TOML (a number or a nesting is too large)") from None


def _check_lengths(source: str, growth: Growth) -> None:
    """Every order that grows stems needs a length of its own or of the last table."""
    for order in range(growth.levels):
        table = min(order, len(growth.level) - 1)
        if growth.level[table].length == 0:
            place = f"growth.level[{table}].length"
            raise InputError(source, place, 0.0, f"a length above 0, as growth.levels = {growth.levels}")


def _input_error(source: str, error: ValidationError) -> InputError:
    """The most telling of a form's faults; a mistyped key also causes a missing one, so it goes first."""
    faults = error.errors(include_url=False)
    fault = min(faults, key=lambda item: item["type"] != "extra_forbidden")
    place = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in fault["loc"])
    value = None if fault["type"] == "missing" else _shown(fault["input"])
    return InputError(source, _one_line(place.lstrip(".")), value, _expectation(fault))


def _expectation(fault: ErrorDetails) -> str:
    """What would have been right."""
    names = tuple(part for part in fault["loc"] if isinstance(part, str))
    table, key = _TABLES.get(names[:-1]), names[-1] if names else ""
    if fault["type"] == "extra_forbidden" and table:
        return f"a known key{_hint(key, list(table.model_fields))}"
    if names in _TABLES and fault["type"] == "model_type":
        return "a table"
    if table is None or key not in table.model_fields:
        return fault["msg"].removeprefix("Input should be ")
    wanted = _field_expectation(table.model_fields[key])
    return f"this key to be given, {wanted}" if fault["type"] == "missing" else wanted


def _field_expectation(field: FieldInfo) -> str:
    """A field's type and range in words."""
    kind: Any = field.annotation
    if kind in (int, float):
        return _range("a whole number" if kind is int else "a number", field.metadata)
    if get_origin(kind) is tuple:
        return "three numbers from 0 to 1"
    if get_origin(kind) is list:
        return "1 to 5 tables"
    choices = [item for item in get_args(kind) if isinstance(item, str)]
    if choices:
        return "one of " + ", ".join(choices)
    if kind is str:
        return "one line of text" if "[^" in str(field.metadata) else "a name of a-z, 0-9 and _"
    return "a table"


def _range(noun: str, bounds: list[Any]) -> str:
    """A range in words."""
    low = next(f"from {bound.ge:g}" if isinstance(bound, Ge) else f"above {bound.gt:g}" for bound in bounds)
    high = next(bound.le for bound in bounds if isinstance(bound, Le))
    return f"{noun} {low} to {high:g}"


def _shown(value: object) -> object:
    """The value itself where it prints as a short line, else something that does."""
    return value if len(repr(value)) <= LONGEST_VALUE else _Shortened(value)


class _Shortened:
    """A value whose repr is one short line."""

    def __init__(self, value: object) -> None:
        self.value = value

    def __repr__(self) -> str:
        return _one_line(reprlib.repr(self.value))


def _hint(word: str, known: list[str]) -> str:
    """Nearest known word, as the end of a sentence; empty when none is near."""
    near = difflib.get_close_matches(word, known, n=1)
    return f" (did you mean {near[0]}?)" if near else ""


def _one_line(text: str) -> str:
    """The text without line breaks and at a length that a terminal shows."""
    flat = " ".join(text.split())
    return flat if len(flat) <= 120 else flat[:117] + "..."
