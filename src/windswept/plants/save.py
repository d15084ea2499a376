"""save_plant and load_plant: a grown plant as a compressed NumPy archive that reloads bit for bit."""

from __future__ import annotations

import json
import math
import zipfile
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.forms.files import written_whole
from windswept.forms.read_text import read_bytes, shown_path
from windswept.plants.plant import Look, Material, Plant
from windswept.plants.validate import validate

FORMAT_VERSION = 1
"""Raised when the arrays of `Plant` change."""
LARGEST_FILE = 256 << 20
"""Bytes."""
LARGEST_CONTENT = 512 << 20
"""Bytes of all arrays unpacked: a plant of 300,000 links and 3 million leaves has 150 MB."""
_HEAD = "windswept_plant"
_ARRAYS = tuple(item.name for item in fields(Plant) if item.name.split("_")[0] in ("stem", "link", "leaf"))
_COLUMNS = dict.fromkeys(("link_base", "link_tip", "leaf_position", "leaf_axis", "leaf_normal"), 3)
_OPTIONAL = {"joint_scale": 2}


def save_plant(plant: Plant, path: Path) -> None:
    """Write a plant to an .npz file; the file appears whole or not at all.

    Raises:
        InputError: the file cannot be written.
    """
    head = {
        "version": FORMAT_VERSION,
        "species": plant.species,
        "seed": plant.seed,
        "material": asdict(plant.material),
        "look": asdict(plant.look),
    }
    arrays = {name: getattr(plant, name) for name in _ARRAYS}
    arrays |= {name: getattr(plant, name) for name in _OPTIONAL if getattr(plant, name) is not None}
    arrays[_HEAD] = np.frombuffer(json.dumps(head).encode(), np.uint8)
    with written_whole(path) as unfinished:
        np.savez_compressed(unfinished, **arrays)


def load_plant(path: Path) -> Plant:
    """Read what `save_plant` wrote.

    Raises:
        InputError: the file is no saved plant, is damaged, or holds what no plant can be.
    """
    source = shown_path(path)
    read_bytes(path, LARGEST_FILE, "a saved plant")
    try:
        arrays = _read_arrays(source, path)
        head = json.loads(arrays.pop(_HEAD).tobytes().decode())
    except InputError:
        raise
    except Exception:
        # A damaged archive may fail in any layer of zip, NumPy and JSON; all of them mean the same to a person.
        raise InputError(
            source, "", None, "an .npz file that windswept saved a plant to, and whole"
        ) from None
    plant = _assembled(source, head, arrays)
    try:
        validate(plant)
    except (ValueError, IndexError, FloatingPointError) as error:
        raise InputError(source, "", None, f"arrays of a plant that hang together ({error})") from None
    return plant


def _read_arrays(source: str, path: Path) -> dict[str, NDArray[Any]]:
    """All arrays of a file that is not too large unpacked."""
    with zipfile.ZipFile(path) as archive:
        size = sum(item.file_size for item in archive.infolist())
    if size > LARGEST_CONTENT:
        raise InputError(source, "", None, f"a saved plant of at most {LARGEST_CONTENT:,} bytes unpacked")
    with np.load(path, allow_pickle=False) as stored:
        known = {_HEAD, *_ARRAYS, *_OPTIONAL}
        missing = {_HEAD, *_ARRAYS} - set(stored.files)
        if missing or set(stored.files) - known:
            raise InputError(source, "", None, "the arrays of a plant saved by windswept grow")
        return {name: stored[name] for name in stored.files}


def _assembled(source: str, head: Any, arrays: dict[str, NDArray[Any]]) -> Plant:
    """The plant of a head and its arrays; shapes are checked here, what they mean in `validate`."""
    if not isinstance(head, dict) or head.get("version") != FORMAT_VERSION:
        raise InputError(source, "", None, f"a plant saved in version {FORMAT_VERSION} of the format")
    for name, array in arrays.items():
        columns = (_COLUMNS | _OPTIONAL).get(name)
        if array.shape[1:] != (() if columns is None else (columns,)) or array.ndim == 0:
            raise InputError(source, name, None, f"rows of {columns or 1} numbers")
    species, seed = head.get("species"), head.get("seed")
    if not isinstance(species, str) or not isinstance(seed, int):
        raise InputError(source, "", None, "the name and the seed of a plant")
    material = _noun(source, Material, head.get("material"))
    return Plant(species, seed, material, _noun(source, Look, head.get("look")), **arrays)


def _noun(source: str, noun: Any, values: Any) -> Any:
    """A Material or a Look from its values."""
    known = {item.name: item.default for item in fields(noun)}
    if not isinstance(values, dict) or set(values) != set(known):
        raise InputError(source, noun.__name__.lower(), None, f"the fields of a {noun.__name__}")
    for name, value in values.items():
        numbers = value if isinstance(value, list) else [value]
        is_text = isinstance(known[name], str)
        if is_text != isinstance(value, str) or isinstance(known[name], tuple) != isinstance(value, list):
            raise InputError(source, f"{noun.__name__.lower()}.{name}", None, f"a value like {known[name]!r}")
        if not is_text and not all(isinstance(item, int | float) and math.isfinite(item) for item in numbers):
            raise InputError(source, f"{noun.__name__.lower()}.{name}", None, "finite numbers")
    return noun(
        **{name: tuple(value) if isinstance(value, list) else value for name, value in values.items()}
    )
