"""What a field of a form accepts, in words: for error messages and for the documentation."""

from __future__ import annotations

import difflib
import reprlib
import types
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from annotated_types import Ge, Gt, Le, MaxLen, MinLen
from pydantic import BaseModel
from pydantic.fields import FieldInfo

LONGEST_LINE = 120
"""Longer texts are shortened in messages, characters."""
MOST_NAMES = 40
"""Longer lists of known words are cut short."""
COUNTS = {1: "one", 2: "two", 3: "three", 4: "four"}


@dataclass(frozen=True, slots=True)
class Wording:
    """Metadata of a field whose pattern is better said in words."""

    words: str


def field_words(field: FieldInfo) -> str:
    """Type and range of a field, as "a number from 0 to 60"."""
    return _type_words(field.annotation, field.metadata)


def _type_words(kind: Any, limits: Sequence[Any]) -> str:
    """Type and range in words; looks through Annotated and "or None"."""
    if get_origin(kind) is Annotated:
        inner, *more = get_args(kind)
        return _type_words(inner, [*limits, *_limits(more)])
    said = next((limit.words for limit in limits if isinstance(limit, Wording)), None)
    if said is not None:
        return said
    if get_origin(kind) in (Union, types.UnionType):
        given = next(item for item in get_args(kind) if item is not type(None))
        return _type_words(given, limits)
    if get_origin(kind) is Literal:
        return "one of " + ", ".join(f'"{item}"' for item in get_args(kind))
    if get_origin(kind) is tuple:
        items = get_args(kind)
        return f"{COUNTS[len(items)]} numbers{_range_words(_limits(get_args(items[0])[1:]))}"
    if get_origin(kind) is list:
        return _list_words(get_args(kind)[0], limits)
    if kind is str:
        return f"text{_length_words(limits)}"
    nouns = {int: "a whole number", float: "a number"}
    if kind in nouns:
        return nouns[kind] + _range_words(limits)
    return "a table"


def _limits(annotations: Sequence[Any]) -> list[Any]:
    """The limits inside annotations, where pydantic packs several into one Field."""
    return [
        limit for item in annotations for limit in (item.metadata if isinstance(item, FieldInfo) else [item])
    ]


def _list_words(item: Any, limits: Sequence[Any]) -> str:
    """Length and items of a list in words."""
    least = next((limit.min_length for limit in limits if isinstance(limit, MinLen)), 0)
    most = next(limit.max_length for limit in limits if isinstance(limit, MaxLen))
    is_table = isinstance(item, type) and issubclass(item, BaseModel)
    return f"{least} to {most:,} {'tables' if is_table else 'lists of ' + _type_words(item, [])}"


def _length_words(limits: Sequence[Any]) -> str:
    """How long a text may be, with a space before; empty where it may be empty."""
    least = next((limit.min_length for limit in limits if isinstance(limit, MinLen)), 0)
    most = next((limit.max_length for limit in limits if isinstance(limit, MaxLen)), None)
    return "" if least == 0 or most is None else f" of {least} to {most:,} characters"


def _range_words(limits: Sequence[Any]) -> str:
    """Range in words, with a space before; empty where there is none."""
    low = next((limit for limit in limits if isinstance(limit, Ge | Gt)), None)
    high = next((limit for limit in limits if isinstance(limit, Le)), None)
    if low is None or high is None:
        return ""
    start = f"above {_number(low.gt)}" if isinstance(low, Gt) else f"from {_number(low.ge)}"
    return f" {start} to {_number(high.le)}"


def _number(value: Any) -> str:
    """A limit without a needless exponent or decimal point."""
    return f"{value:,.10g}"


def is_list(field: FieldInfo) -> bool:
    """Whether a field holds a list."""
    return get_origin(field.annotation) is list


def nearest(word: str, known: Sequence[str]) -> str:
    """The nearest known word as the end of a sentence; some of them where none is near."""
    near = difflib.get_close_matches(word[:LONGEST_LINE], known, n=1)
    more = ", ..." if len(known) > MOST_NAMES else ""
    return f"did you mean {near[0]}?" if near else f"one of {', '.join(known[:MOST_NAMES])}{more}"


def shown(value: object) -> object:
    """The value itself where it prints as a short line, else something that does."""
    whole = repr(value)
    return value if len(whole) <= LONGEST_LINE // 2 and whole.isprintable() else _Shortened(value)


def shown_as_toml(value: object) -> object:
    """As `shown`, with true and false as a TOML file has them."""
    return _Written(str(value).lower()) if isinstance(value, bool) else shown(value)


@dataclass(frozen=True, slots=True)
class _Written:
    """A value as it stands in a file."""

    text: str

    def __repr__(self) -> str:
        return self.text


class _Shortened:
    """A value whose repr is one short line."""

    def __init__(self, value: object) -> None:
        self.value = value

    def __repr__(self) -> str:
        return one_line(reprlib.repr(self.value))


def one_line(text: str) -> str:
    """The text without line breaks and at a length that a terminal shows."""
    flat = " ".join(text.split())
    return flat if len(flat) <= LONGEST_LINE else flat[: LONGEST_LINE - 3] + "..."
