"""check_form: tables as a form, or one line that says what is wrong with them."""

from __future__ import annotations

import types
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from windswept.errors import InputError
from windswept.forms.words import field_words, nearest, one_line, shown_as_toml

FormType = TypeVar("FormType", bound=BaseModel)


def check_form(source: str, form: type[FormType], data: dict[str, Any]) -> FormType:
    """The data as a form.

    Args:
        source: the file, for error messages.
        form: what the data should be.
        data: tables of the file.

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
    place = one_line("".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in steps)[1:])
    if kind == "extra_forbidden":
        known = list(_table_at(form, steps[:-1]).model_fields)
        return InputError(source, place, None, f"a known key: {nearest(str(steps[-1]), known)}")
    words = _expectation(form, steps, fault)
    if kind == "missing":
        return InputError(source, place, None, f"this key to be given: {words}")
    return InputError(source, place, shown_as_toml(fault["input"]), words)


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
