"""`#define`: names and functions of names that stand for text, replaced word by word as a C preprocessor does."""

from __future__ import annotations

import re
from dataclasses import dataclass

from windswept.errors import InputError

LONGEST_LINE = 20_000
"""Characters that a line may expand to: macros that call each other twice grow without bound."""
DEEPEST = 40
"""Macros call each other at most this deep."""

_DIRECTIVE = re.compile(
    r"\s*#\s*(define|undef|include|if|ifdef|ifndef|elif|else|endif|pragma|error|line)\b(.*)"
)
_DEFINE = re.compile(r"\s*([A-Za-z_]\w*)(\(([^)]*)\))?(.*)$")
_WORD = re.compile(r"[A-Za-z_]\w*")
_NUMBER_OR_WORD = re.compile(r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[A-Za-z_]\w*")


@dataclass(frozen=True, slots=True)
class Macro:
    """What a name stands for."""

    names: tuple[str, ...] | None
    """Formal arguments; None for a plain name."""
    text: str


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a file without comments and macros."""

    number: int
    text: str


def expand_macros(text: str, source: str) -> list[Line]:
    """Lines of a text with its macros replaced; a backslash at a line's end joins the next.

    Raises:
        InputError: another directive than `#define`, or macros without end.
    """
    macros: dict[str, Macro] = {}
    lines: list[Line] = []
    waiting, first = "", 1
    for number, physical in enumerate(text.split("\n"), 1):
        first = first if waiting else number
        joined = waiting + physical
        if physical.rstrip().endswith("\\"):
            waiting = joined.rstrip()[:-1] + " "
            continue
        waiting = ""
        directive = _DIRECTIVE.match(joined)
        if directive:
            _define(directive, macros, source, first)
        elif joined.strip():
            lines.append(Line(first, _expanded(joined, macros, source, first)))
    return lines


def _define(directive: re.Match[str], macros: dict[str, Macro], source: str, line: int) -> None:
    """Note a macro."""
    found = _DEFINE.match(directive[2]) if directive[1] == "define" else None
    if not found:
        raise InputError(source, f"line {line}", None, "no directive but #define NAME text")
    names = None if found[2] is None else tuple(part.strip() for part in found[3].split(","))
    macros[found[1]] = Macro(names, found[4].strip())


def _expanded(text: str, macros: dict[str, Macro], source: str, line: int) -> str:
    """The text with every macro replaced, and those in the replacements."""
    for _ in range(DEEPEST):
        replaced = _replaced(text, macros, source, line)
        if replaced == text:
            return text
        if len(replaced) > LONGEST_LINE:
            break
        text = replaced
    raise InputError(source, f"line {line}", None, "macros that come to an end: these call each other")


def _replaced(text: str, macros: dict[str, Macro], source: str, line: int) -> str:
    """One round of replacing; what is put in is not looked at again."""
    parts: list[str] = []
    place = length = 0
    for found in _NUMBER_OR_WORD.finditer(text):
        macro = macros.get(found[0])
        if macro is None or found.start() < place or macro.text == found[0]:
            continue
        parts.append(text[place : found.start()])
        place = found.end()
        parts.append(macro.text)
        if macro.names is not None:
            arguments, place = _arguments(text, place, source, line)
            parts[-1] = _with_arguments(macro, arguments, source, line)
        length += len(parts[-1])
        if length > LONGEST_LINE:
            raise InputError(source, f"line {line}", None, "macros that come to an end: these grow too long")
    return "".join(parts) + text[place:]


def _arguments(text: str, place: int, source: str, line: int) -> tuple[list[str], int]:
    """Arguments in the parentheses at a place, and the place after them."""
    arguments: list[str] = []
    depth, start = 0, place
    for i in range(place, len(text)):
        depth += (text[i] == "(") - (text[i] == ")")
        if text[i] == "(" and depth == 1:
            start = i + 1
        elif depth == 0 and text[i] == ")":
            return [*arguments, text[start:i].strip()], i + 1
        elif depth == 1 and text[i] == ",":
            arguments.append(text[start:i].strip())
            start = i + 1
        elif depth == 0 and not text[i].isspace():
            break
    raise InputError(source, f"line {line}", None, "arguments in parentheses after the name of a macro")


def _with_arguments(macro: Macro, arguments: list[str], source: str, line: int) -> str:
    """The text of a macro with its arguments put in."""
    names = macro.names or ()
    if len(arguments) != len(names):
        raise InputError(
            source, f"line {line}", None, f"{len(names)} arguments of a macro, not {len(arguments)}"
        )
    given = dict(zip(names, arguments, strict=True))
    return _WORD.sub(lambda word: given.get(word[0], word[0]), macro.text)
