"""Reads a TOML file into a form, or says in one line what is wrong with it."""

from __future__ import annotations

import re
import reprlib
import tomllib
import types
from pathlib import Path
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from windswept.errors import InputError
from windswept.scene.words import field_words, nearest

LARGEST_FILE = 16 << 20
"""A scene file of more bytes than this is a mistake: 100,000 plants take 8 MiB."""

FormType = TypeVar("FormType", bound=BaseModel)


def read_toml(path: Path) -> dict[str, Any]:
    """Tables of a TOML file.

    Raises:
        InputError: no such file, too large, not UTF-8, or not TOML (with the line).
    """
    source = str(path)
    text = _read_text(path)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        line = re.search(r"line (\d+)", str(error))
        place = f"line {line[1] if line else text.count(chr(10)) + 1}"
        reason = re.sub(r"\s*\(at .*\)$", "", str(error))
        raise InputError(source, place, None, f"valid TOML ({_one_line(reason)})") from None
    except (ValueError, RecursionError):
        raise InputError(source, "", None, "valid TOML (a number or a nesting is too large)") from None


def _read_text(path: Path) -> str:
    """Text of a file that exists, is small enough and is UTF-8."""
    source = str(path)
    try:
        if path.is_dir():
            raise InputError(source, "", None, "a .toml file, not a directory")
        if path.is_file() and path.stat().st_size > LARGEST_FILE:
            raise InputError(source, "", None, f"a scene file of at most {LARGEST_FILE:,} bytes")
        return path.read_bytes().decode("utf-8")
    except FileNotFoundError:
        raise InputError(source, "", None, "a file that exists") from None
    except UnicodeDecodeError as error:
        raise InputError(source, f"byte {error.start}", None, "UTF-8 text") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(source, "", None, f"a readable file ({reason})") from None


def check_form(source: str, form: type[FormType], data: dict[str, Any]) -> FormType:
    """The data as a form.

    Raises:
        InputError: with the dotted key of the most telling fault. A mistyped key also makes a required one
            missing, so an unknown key is named first.
    """
    try:
        return form.model_validate(data)
    except ValidationError as error:
        faults = error.errors(include_url=False)
    raise _fault_error(source, form, min(faults, key=lambda fault: fault["type"] != "extra_forbidden"))


def _fault_error(source: str, form: type[BaseModel], fault: ErrorDetails) -> InputError:
    """One fault as an InputError."""
    steps, kind = fault["loc"], fault["type"]
    place = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in steps).lstrip(".")
    if kind == "extra_forbidden":
        known = list(_table_at(form, steps[:-1]).model_fields)
        return InputError(source, _one_line(place), None, f"a known key: {nearest(str(steps[-1]), known)}")
    words = _expectation(form, steps, fault)
    if kind == "missing":
        return InputError(source, place, None, f"this key to be given: {words}")
    return InputError(source, place, Shown(fault["input"]), words)


def _expectation(form: type[BaseModel], steps: tuple[int | str, ...], fault: ErrorDetails) -> str:
    """What the innermost named field on the way to a fault accepts."""
    if fault["type"] == "model_type":
        return "a table"
    last = max((i for i, step in enumerate(steps) if isinstance(step, str)), default=-1)
    if last < 0:
        return fault["msg"]
    return field_words(_table_at(form, steps[:last]).model_fields[str(steps[last])])


def _table_at(form: type[BaseModel], steps: tuple[int | str, ...]) -> type[BaseModel]:
    """The form that the tables at a place follow."""
    for step in steps:
        if isinstance(step, str):
            inner = inner_form(form.model_fields[step])
            assert inner is not None, f"{step} is no table"
            form = inner
    return form


def inner_form(field: FieldInfo) -> type[BaseModel] | None:
    """The form of a field that holds a table or a list of tables; None for a plain value."""
    kind: Any = field.annotation
    while get_origin(kind) in (list, Annotated, Union, types.UnionType):
        kind = get_args(kind)[0]
    return kind if isinstance(kind, type) and issubclass(kind, BaseModel) else None


class Shown:
    """A value whose repr is one short line."""

    def __init__(self, value: object) -> None:
        self.value = value

    def __repr__(self) -> str:
        return _one_line(reprlib.repr(self.value))


def _one_line(text: str) -> str:
    """The text without line breaks and at a length that a terminal shows."""
    flat = " ".join(text.split())
    return flat if len(flat) <= 120 else flat[:117] + "..."
