"""Arbaro: Weber-Penn parameters as XML, or as a plain list of ``Name = Value`` lines."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from windswept.errors import InputError
from windswept.forms.read_text import read_text, shown_path
from windswept.plants.importers.draft import SpeciesDraft
from windswept.plants.importers.report import ImportReport
from windswept.plants.importers.weber_penn_names import take_level, take_tree
from windswept.plants.species_form import Species

LARGEST_FILE = 1 << 20
"""Of a plain list, bytes."""
_LINE = re.compile(r"^\s*([A-Za-z0-9_]+)\s*[=:]\s*(.*?)\s*;?\s*$")


def import_arbaro_xml(path: Path, root: Any) -> tuple[Species, ImportReport]:
    """Species of an Arbaro file.

    Args:
        path: the file.
        root: its root element.

    Raises:
        InputError: a value is no number, or there is no species in it.
    """
    draft = SpeciesDraft(path, "Arbaro XML")
    species = root if root.tag == "species" else root.find("species")
    if species is None:
        raise InputError(draft.source, "", None, "an <arbaro> element with a <species> in it")
    pairs = [(item.get("name") or "", item.get("value") or "") for item in species.iter("param")]
    return _import(draft, pairs, species.get("name") or "")


def import_arbaro_list(path: Path) -> tuple[Species, ImportReport]:
    """Species of a plain list of ``Name = Value`` lines; errors as in `import_arbaro_xml`."""
    draft = SpeciesDraft(path, "an Arbaro list")
    pairs = []
    for number, line in enumerate(read_text(path, LARGEST_FILE, "a list of parameters").splitlines(), 1):
        bare = line.split("#")[0].split("//")[0]
        if not bare.strip():
            continue
        match = _LINE.match(bare)
        if match is None:
            raise InputError(shown_path(path), f"line {number}", None, "a line of the form Name = Value")
        pairs.append((match[1], match[2].strip("\"'")))
    names = [value for name, value in pairs if name.lower() in ("species", "name")]
    known = [(name, value) for name, value in pairs if name.lower() not in ("species", "name")]
    return _import(draft, known, names[0] if names else "")


def _import(draft: SpeciesDraft, pairs: Iterable[tuple[str, str]], name: str) -> tuple[Species, ImportReport]:
    """Take every pair: a leading digit is the level, the rest Weber and Penn's name.

    Several trunks lean by the trunk's own down angle, so they come last.
    """
    for key, value in sorted(pairs, key=lambda pair: pair[0].lower() == "0branches"):
        if key[:1].isdigit():
            level = int(key[0])
            if level < 4 and key.isascii():
                take_level(draft, key, key[1:], level, value)
            else:
                draft.skip(key)
        else:
            take_tree(draft, key, value)
    return draft.finish(name), draft.report
