"""write_species: a species as a file that reads back the same."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from windswept.forms.files import written_whole
from windswept.plants.species_form import Species


def write_species(species: Species, path: Path) -> None:
    """Write a species file; it appears whole or not at all.

    Raises:
        InputError: the file cannot be written.
    """
    with written_whole(path) as unfinished:
        unfinished.write_text(species_toml(species), encoding="utf-8")


def species_toml(species: Species) -> str:
    """TOML of a species: every key, in the order of the form."""
    data = species.model_dump()
    growth, material, look = data.pop("growth"), data.pop("material"), data.pop("look")
    levels = growth.pop("level")
    lines = [*_pairs(data), "", "[growth]", *_pairs(growth)]
    for level in levels:
        lines += ["", "[[growth.level]]", *_pairs(level)]
    lines += ["", "[material]", *_pairs(material), "", "[look]", *_pairs(look)]
    return "\n".join(lines) + "\n"


def _pairs(table: dict[str, Any]) -> Iterator[str]:
    """Lines ``key = value``; TOML writes numbers, texts and lists of numbers as JSON does."""
    for key, value in table.items():
        plain = list(value) if isinstance(value, tuple) else value
        yield f"{key} = {json.dumps(plain, ensure_ascii=False)}"
