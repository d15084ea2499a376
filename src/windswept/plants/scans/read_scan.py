"""read_scan: the cylinders in a file, checked number by number but not yet mended."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from windswept.errors import InputError
from windswept.forms.read_text import shown_path
from windswept.plants.scans.cylinders import Cylinders, Reals
from windswept.plants.scans.read_csv import read_csv
from windswept.plants.scans.read_mat import read_mat

COLUMNS = ("radius", "length", "start x", "start y", "start z", "axis x", "axis y", "axis z", "parent")
"""What the columns of a table mean, in this order."""
MOST_CYLINDERS = 100_000
LARGEST_RADIUS = 10.0
"""No tree is thicker, m: a larger number is in other units."""
LARGEST_LENGTH = 50.0
"""No cylinder of a fit is longer, m."""


def read_scan(path: Path) -> Cylinders:
    """Cylinders of a .csv or .mat file.

    Raises:
        InputError: the file holds none, or a number in it cannot be; names row and column.
    """
    source = shown_path(path)
    table = read_mat(path) if path.suffix.lower() == ".mat" else read_csv(path)
    if not len(table):
        raise InputError(source, "", None, "at least one cylinder")
    if len(table) > MOST_CYLINDERS:
        raise InputError(source, "", len(table), f"at most {MOST_CYLINDERS:,} cylinders")
    _check(source, table)
    parent = table[:, 8].astype(np.int64) - 1
    return Cylinders(table[:, 0], table[:, 1], table[:, 2:5], table[:, 5:8], parent)


def _check(source: str, table: Reals) -> None:
    """Raise InputError for the first number that cannot be."""
    rows = np.arange(1, len(table) + 1)
    _require(source, table, np.isfinite(table), "a finite number")
    _require_column(
        source, table, 0, (table[:, 0] > 0) & (table[:, 0] <= LARGEST_RADIUS), "a radius above 0 in m"
    )
    _require_column(
        source, table, 1, (table[:, 1] > 0) & (table[:, 1] <= LARGEST_LENGTH), "a length above 0 in m"
    )
    no_axis = np.linalg.norm(np.clip(table[:, 5:8], -1e6, 1e6), axis=1) < 1e-6
    _require_column(source, table, 5, ~no_axis, "an axis that points somewhere")
    _require(source, table, np.abs(table) <= 1e9, "a number that a tree can have")
    parent = table[:, 8]
    fits = (parent == np.floor(parent)) & (parent >= 0) & (parent <= len(table)) & (parent != rows)
    _require_column(
        source, table, 8, fits, f"the row of another cylinder, 1 to {len(table)}, or 0 for a root"
    )


def _require(source: str, table: Reals, holds: np.ndarray, wanted: str) -> None:
    """Raise InputError with the first cell at which something does not hold."""
    if not holds.all():
        row, column = np.argwhere(~holds)[0]
        place = f"cylinder {row + 1}, {COLUMNS[column]}"
        raise InputError(source, place, float(table[row, column]), wanted)


def _require_column(source: str, table: Reals, column: int, holds: np.ndarray, wanted: str) -> None:
    """The same for one column."""
    mask = np.ones(table.shape, bool)
    mask[:, column] = holds
    _require(source, table, mask, wanted)
