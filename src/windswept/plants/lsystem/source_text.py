"""The text of a grammar file: found, decoded, freed of comments, told from other files of the same ending."""

from __future__ import annotations

import re
from pathlib import Path

from windswept.errors import InputError
from windswept.forms.read_text import read_bytes, shown_path

LARGEST_FILE = 1 << 18
"""A grammar is a page of text; anything above this many bytes is not one."""

_STRANGERS = (
    (re.compile(r"lpfgall\.h|^\s*module\s+\w+\s*\([^)]*\)\s*;|^\s*produce\b", re.M), "lpfg's C++"),
    (re.compile(r"^%%|^%\{|^%option\b", re.M), "a scanner for lex"),
    (re.compile(r"^\s*#\s*include\b", re.M), "C or a file that includes others"),
    (re.compile(r"^\s*\((?:defun|in-package|setq|define|let)\b", re.M), "Lisp"),
    (re.compile(r"<\?xml|<!DOCTYPE|<html", re.I), "XML"),
)
_COMMENT = re.compile(r"/\*.*?\*/", re.S)
_LINE_COMMENT = re.compile(r"(?:^|(?<=\s))//(?=\s|$).*$", re.M)


def read_source(path: Path) -> str:
    """Text of a grammar file, UTF-8 or, as in old files, Latin-1.

    Raises:
        InputError: no such file, too large, or not text.
    """
    data = read_bytes(path, LARGEST_FILE, "an L-system")
    strange = re.search(rb"[\x00-\x08\x0e-\x19\x1b-\x1f\x7f]", data)
    if strange:
        raise InputError(shown_path(path), f"byte {strange.start()}", None, "text, not a binary file")
    try:
        return data.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError:
        return data.decode("latin-1").replace("\r\n", "\n").replace("\r", "\n")


def refuse_strangers(text: str, source: str) -> None:
    """Raise InputError for files of other kinds that end in .l too."""
    for pattern, kind in _STRANGERS:
        found = pattern.search(text)
        if found:
            line = 1 + text.count("\n", 0, found.end())
            raise InputError(source, f"line {line}", None, f"an L-system in cpfg notation; this is {kind}")


def without_comments(text: str, source: str) -> str:
    """The text with comments blanked and its lines in place.

    ``//`` is also two rolls of the turtle, so it opens a comment only between blanks or line ends.

    Raises:
        InputError: a comment is not closed.
    """
    text = _COMMENT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    text = _LINE_COMMENT.sub("", text)
    if "/*" in text:
        line = 1 + text.count("\n", 0, text.index("/*"))
        raise InputError(source, f"line {line}", None, "*/ to close the comment that begins here")
    return text
