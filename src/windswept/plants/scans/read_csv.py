"""read_csv: nine columns of numbers from a text file."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from windswept.errors import InputError
from windswept.forms.read_text import read_text, shown_path
from windswept.forms.words import shown
from windswept.plants.scans.cylinders import Reals

LARGEST_FILE = 64 << 20
"""Bytes."""
COLUMN_COUNT = 9
_HEADINGS = (
    r"radius",
    r"length",
    r"(sta|start|base).*x",
    r"(sta|start|base).*y",
    r"(sta|start|base).*z",
    r"(ax|axis|dir).*[_ .]x",
    r"(ax|axis|dir).*[_ .]y",
    r"(ax|axis|dir).*[_ .]z",
    r"parent",
)
"""How the columns are called; where one is not found, the first nine columns are taken in this order."""


def read_csv(path: Path) -> Reals:
    """(C, 9) radius, length, start, axis, parent of a file whose columns are parted by , ; tab or blanks.

    Raises:
        InputError: a row is too short or a cell is no number.
    """
    source = shown_path(path)
    lines = read_text(path, LARGEST_FILE, "a table of cylinders").lstrip("\ufeff").splitlines()
    rows = [(number, _cells(line)) for number, line in enumerate(lines, 1) if line.strip(" \t,;#")]
    columns = list(range(COLUMN_COUNT))
    if rows and not _is_number(rows[0][1][0]):
        columns = _columns(rows.pop(0)[1])
    table = np.empty((len(rows), COLUMN_COUNT))
    for index, (number, cells) in enumerate(rows):
        if len(cells) <= max(columns):
            expected = f"at least {max(columns) + 1} columns: radius, length, start, axis, parent"
            raise InputError(source, f"line {number}", None, expected)
        for place, column in enumerate(columns):
            if not _is_number(cells[column]):
                where = f"line {number}, column {column + 1}"
                raise InputError(source, where, shown(cells[column]), "a number")
            table[index, place] = float(cells[column])
    return table


def _cells(line: str) -> list[str]:
    """Cells of a line."""
    separator = next((mark for mark in ",;\t" if mark in line), None)
    return [cell.strip(" \"'") for cell in line.split(separator)]


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _columns(headings: list[str]) -> list[int]:
    """Column of each of the nine quantities."""
    found = []
    for pattern in _HEADINGS:
        matches = [i for i, name in enumerate(headings) if re.match(pattern, name.lower())]
        if not matches:
            return list(range(COLUMN_COUNT))
        found.append(matches[0])
    return found
