"""read_mat: the cylinders of a MATLAB file, as TreeQSM writes it or as a plain matrix."""

from __future__ import annotations

import io
import struct
import warnings
import zlib
from pathlib import Path
from typing import Any

import numpy as np

from windswept.errors import InputError
from windswept.forms.read_text import read_bytes, shown_path
from windswept.plants.scans.cylinders import Reals

LARGEST_FILE = 64 << 20
"""Bytes."""
LARGEST_CONTENT = 256 << 20
"""Bytes unpacked."""
DEEPEST = 6
"""How far down in structures and cells a table of cylinders may lie."""
HEADER, COMPRESSED = 128, 15
"""Length of the header of a MATLAB 5 file, and the type of its packed elements."""


def read_mat(path: Path) -> Reals:
    """(C, 9) radius, length, start, axis, parent.

    Raises:
        InputError: the file is damaged or of another kind, or holds no cylinders.
    """
    from scipy.io import loadmat

    source, data = shown_path(path), read_bytes(path, LARGEST_FILE, "a MATLAB file")
    if data[:8] == b"\x89HDF\r\n\x1a\n" or b"MATLAB 7.3" in data[:HEADER]:
        raise InputError(source, "", None, "a MATLAB file of version 7 or before (save it with -v7)")
    _check_size(source, data)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            content = loadmat(io.BytesIO(data), simplify_cells=True)
    except Exception:
        # A damaged file may fail anywhere in the reader; all of it means the same to a person.
        raise InputError(source, "", None, "a MATLAB file that is whole") from None
    table = _find({key: value for key, value in content.items() if not key.startswith("__")}, 0)
    if table is None:
        expected = (
            "a structure with radius, length, start, axis and parent, or a matrix of these nine columns"
        )
        raise InputError(source, "", None, expected)
    return table


def _check_size(source: str, data: bytes) -> None:
    """Raise InputError for a file that would unpack to too much."""
    place, total = HEADER, 0
    order = ">" if data[126:128] == b"MI" else "<"
    while place + 8 <= len(data):
        kind, size = struct.unpack(order + "II", data[place : place + 8])
        if kind == COMPRESSED:
            unpacker, packed = zlib.decompressobj(), data[place + 8 : place + 8 + size]
            while packed and total <= LARGEST_CONTENT:
                try:
                    total += len(unpacker.decompress(packed, 1 << 20))
                except zlib.error:
                    raise InputError(source, "", None, "a MATLAB file that is whole") from None
                packed = unpacker.unconsumed_tail
        if total > LARGEST_CONTENT:
            raise InputError(source, "", None, f"a MATLAB file of at most {LARGEST_CONTENT:,} bytes unpacked")
        place += 8 + size


def _find(value: Any, depth: int) -> Reals | None:
    """The first table of cylinders in structures, cells and arrays."""
    if depth > DEEPEST:
        return None
    if isinstance(value, dict):
        table = _from_structure(value)
        inner: list[Any] = list(value.values())
    else:
        table = _from_matrix(value)
        is_cells = isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype == object)
        inner = list(value.ravel() if isinstance(value, np.ndarray) else value) if is_cells else []
    if table is not None:
        return table
    found = (_find(item, depth + 1) for item in inner[:1000])
    return next((item for item in found if item is not None), None)


def _from_structure(structure: dict[str, Any]) -> Reals | None:
    """Table of a TreeQSM ``cylinder`` structure."""
    try:
        parts = [
            np.asarray(structure[key], np.float64) for key in ("radius", "length", "start", "axis", "parent")
        ]
        radius, length, start, axis, parent = parts
        count = radius.size
        shaped = (
            radius.reshape(-1, 1),
            length.reshape(-1, 1),
            start.reshape(count, 3),
            axis.reshape(count, 3),
        )
        return np.hstack((*shaped, parent.reshape(-1, 1)))
    except (KeyError, ValueError, TypeError):
        return None


def _from_matrix(value: Any) -> Reals | None:
    """Table of a plain matrix with at least nine columns."""
    is_matrix = isinstance(value, np.ndarray) and value.ndim == 2 and value.dtype.kind in "fiu"
    return np.asarray(value[:, :9], np.float64) if is_matrix and value.shape[1] >= 9 else None
