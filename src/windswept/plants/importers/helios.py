"""Helios: Weber-Penn trees as XML, per-level values as ``n`` and four numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from windswept.errors import InputError
from windswept.plants.importers.draft import SpeciesDraft
from windswept.plants.importers.report import ImportReport
from windswept.plants.importers.weber_penn_names import LEVEL, take_leaf_shape, take_level, take_tree
from windswept.plants.species_form import Species


def import_helios(path: Path, root: Any, mended: bool) -> tuple[Species, ImportReport]:
    """Species of the first tree with a label; an entry with an empty label is Helios' template.

    Args:
        path: the file.
        root: its root element.
        mended: whether the XML header was malformed.

    Raises:
        InputError: a value is no number, or there is no tree in the file.
    """
    draft = SpeciesDraft(path, "Helios XML")
    if mended:
        draft.report.repaired.append("XML header without quotation marks")
    trees = [item for item in root.iter() if str(item.tag).lower().startswith("weberpenn")]
    labelled = [item for item in trees if (item.get("label") or "").strip()]
    if not trees:
        raise InputError(draft.source, "", None, "a <WeberPennTree> element")
    tree = (labelled or trees)[0]
    for other in labelled[1:]:
        draft.skip(f"tree {other.get('label')!r}")
    for item in tree:
        _take(draft, str(item.tag), (item.text or "").split())
    return draft.finish((tree.get("label") or "").strip()), draft.report


def _take(draft: SpeciesDraft, name: str, words: list[str]) -> None:
    """Take one element."""
    lower = name.lower()
    if lower == "leafshape":
        take_leaf_shape(draft, name, " ".join(words))
    elif lower.startswith("n") and lower[1:] in (*LEVEL, "basesplits"):
        values = draft.numbers(name, words)
        if lower == "nbasesplits":
            draft.take(name, values[0], "base_splits")
            return
        for level, value in enumerate(values):
            take_level(draft, f"{name}[{level}]", name[1:], level, value)
    elif lower in ("leafangle", "leafanglev") and words:
        draft.take(name, words[0], "down_angle" if lower == "leafangle" else "down_angle_v", 3)
    elif len(words) == 1:
        take_tree(draft, name, words[0])
    else:
        draft.skip(name)
