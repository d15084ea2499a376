"""import_species: the reader that suits a foreign preset."""

from __future__ import annotations

from pathlib import Path

from windswept.errors import InputError
from windswept.forms.read_text import shown_path
from windswept.plants.importers.arbaro import import_arbaro_list, import_arbaro_xml
from windswept.plants.importers.ez_tree import import_ez_tree
from windswept.plants.importers.helios import import_helios
from windswept.plants.importers.read_literal import read_literal
from windswept.plants.importers.report import ImportReport
from windswept.plants.importers.sapling import import_sapling
from windswept.plants.importers.tree_gen import import_tree_gen
from windswept.plants.importers.xml_tree import parse_xml
from windswept.plants.species_form import Species

ENDINGS = (".xml", ".py", ".json", ".txt", ".arb")
_TREE_GEN_MARKS = ("g_scale", "leaf_blos_num", "curve_res", "down_angle")
_SAPLING_MARKS = ("curveRes", "attractUp", "downAngle", "scale0", "baseSplits")


def import_species(path: Path) -> tuple[Species, ImportReport]:
    """Species of a foreign preset, and what became of its values.

    Args:
        path: Arbaro or Helios XML, a tree-gen or Sapling literal, ez-tree JSON, or an Arbaro list.

    Raises:
        InputError: it is none of these, or a value in it is wrong.
    """
    ending = path.suffix.lower()
    if ending == ".xml":
        return _import_xml(path)
    if ending == ".py":
        return _import_literal(path)
    if ending == ".json":
        return import_ez_tree(path)
    return import_arbaro_list(path)


def _import_xml(path: Path) -> tuple[Species, ImportReport]:
    """Arbaro or Helios, by the root element."""
    root, mended = parse_xml(path)
    if root.tag in ("arbaro", "species"):
        species, report = import_arbaro_xml(path, root)
        if mended:
            report.repaired.append("XML header without quotation marks")
        return species, report
    if str(root.tag).lower() in ("helios", "weberpenntree"):
        return import_helios(path, root, mended)
    raise InputError(shown_path(path), "", f"<{str(root.tag)[:40]}>", "an <arbaro> or <helios> file")


def _import_literal(path: Path) -> tuple[Species, ImportReport]:
    """tree-gen or Sapling, by the keys."""
    params = read_literal(path)
    if any(key in params for key in _SAPLING_MARKS):
        return import_sapling(path, params)
    if any(key in params for key in _TREE_GEN_MARKS):
        return import_tree_gen(path, params)
    raise InputError(
        shown_path(path), "", None, "keys of a tree-gen or a Sapling preset, as g_scale or curveRes"
    )
