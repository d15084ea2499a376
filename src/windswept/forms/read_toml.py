"""read_toml: the tables of a TOML file."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

from windswept.errors import InputError
from windswept.forms.read_text import read_text, shown_path
from windswept.forms.words import one_line


def read_toml(path: Path, largest: int, noun: str) -> dict[str, Any]:
    """Tables of a TOML file.

    Args:
        path: where it lies.
        largest: most bytes it may have.
        noun: what it should be, as "a species file".

    Raises:
        InputError: no such file, too large, not UTF-8, or not TOML (with the line).
    """
    source, text = shown_path(path), read_text(path, largest, noun)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        line = re.search(r"line (\d+)", str(error))
        place = f"line {line[1] if line else text.count(chr(10)) + 1}"
        reason = re.sub(r"\s*\(at .*\)$", "", str(error))
        raise InputError(source, place, None, f"valid TOML ({one_line(reason)})") from None
    except (ValueError, RecursionError):
        raise InputError(source, "", None, "valid TOML (a number or a nesting is too large)") from None
