"""read_literal: the one dictionary in a Python file, read and never run."""

from __future__ import annotations

import ast
import warnings
from pathlib import Path
from typing import Any

from windswept.errors import InputError
from windswept.forms.read_text import read_text, shown_path

LARGEST_FILE = 1 << 20
"""A preset is a page of text, bytes."""


def read_literal(path: Path) -> dict[str, Any]:
    """Entries of a file that is a bare dictionary, or assigns one to ``params``; nothing in it is executed.

    Raises:
        InputError: it is anything else, for instance code.
    """
    source, text = shown_path(path), read_text(path, LARGEST_FILE, "a preset")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a strange escape in a preset is none of the reader's business
            body = ast.parse(text).body
            node = _dictionary(source, body)
            value = ast.literal_eval(node)
    except SyntaxError as error:
        raise InputError(source, f"line {error.lineno or 1}", None, "a dictionary of parameters") from None
    except (ValueError, TypeError, RecursionError, MemoryError):
        raise InputError(source, "", None, "a dictionary of plain values, not code") from None
    return {str(key): item for key, item in value.items()}


def _dictionary(source: str, body: list[ast.stmt]) -> ast.Dict:
    """The dictionary among the statements of a file; a docstring may stand before it."""
    rest = [item for item in body if not _is_docstring(item)]
    if not rest:
        raise InputError(source, "", None, "a dictionary of parameters; the file is empty")
    for statement in rest:
        is_params = isinstance(statement, ast.Assign) and isinstance(statement.value, ast.Dict)
        is_bare = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Dict)
        if len(rest) > 1 or not (is_params or is_bare):
            place = f"line {statement.lineno}"
            raise InputError(
                source, place, None, "one dictionary of parameters and nothing else: code is not run"
            )
    node = rest[0].value  # type: ignore[attr-defined]
    assert isinstance(node, ast.Dict)
    return node


def _is_docstring(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
