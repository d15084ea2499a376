"""Parse one statement of an L-system with the grammar in cpfg.lark."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from lark import Lark
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from windswept.errors import InputError
from windswept.forms.words import one_line, shown

Node = Any
"""A lark Tree or Token; which of them stands where is what cpfg.lark says."""

DEEPEST = 60
"""Expressions are nested at most this deep: no grammar comes near, and evaluation recurses."""
_WANTED = {
    "rule": "a rule such as A(x) : x > 0 --> F(x)[+A(x/2)]",
    "word": "modules such as F(1)[+A(2)]",
    "numbers": "a number",
}


def parse(text: str, start: str, source: str, line: int) -> Node:
    """Syntax tree of a statement.

    Args:
        text: the statement, possibly over several lines.
        start: "rule", "word" or "numbers".
        source: the file, for error messages.
        line: number of the statement's first line.

    Raises:
        InputError: the text is no such statement.
    """
    _check_nesting(text, source, line)
    try:
        return _parser().parse(text, start=start)
    except UnexpectedInput as error:
        raise _input_error(error, text, start, source, line) from None


@cache
def _parser() -> Lark:
    """The parser, built once."""
    path = Path(__file__).parent / "cpfg.lark"
    return Lark(path.read_text(), parser="lalr", start=list(_WANTED), propagate_positions=True)


def _check_nesting(text: str, source: str, line: int) -> None:
    """Refuse towers of parentheses."""
    depth = 0
    for character in text:
        depth += (character == "(") - (character == ")")
        if depth > DEEPEST:
            raise InputError(source, f"line {line}", None, f"parentheses at most {DEEPEST} deep")


def _input_error(error: UnexpectedInput, text: str, start: str, source: str, line: int) -> InputError:
    """Where the parser stopped and what was to come."""
    rest = text[error.pos_in_stream :] if error.pos_in_stream is not None else ""
    if isinstance(error, UnexpectedToken) and error.token.type == "$END":
        rest = ""
    row = error.line if error.line and error.line > 0 else 1 + text.rstrip().count("\n")
    stopped = shown(one_line(rest)[:20]) if rest.strip() else "its end"
    place = f"line {line + row - 1}"
    if isinstance(error, UnexpectedCharacters | UnexpectedToken):
        return InputError(source, place, None, f"{_WANTED[start]}, which stops to be one at {stopped}")
    return InputError(source, place, None, _WANTED[start])
