"""grow_source: the one place that knows what a person may name where a plant is asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from windswept.errors import InputError
from windswept.forms.read_text import shown_path
from windswept.forms.words import nearest, one_line
from windswept.plants.check_seed import check_seed
from windswept.plants.importers import ENDINGS as PRESET_ENDINGS
from windswept.plants.importers import ImportReport, import_species
from windswept.plants.plant import Plant
from windswept.plants.save import load_plant
from windswept.plants.species import load_species, species_names
from windswept.plants.species_form import Species
from windswept.plants.underbrush.library import underbrush_names
from windswept.plants.weber_penn import grow

SPECIES_ENDING = ".toml"
GRAMMAR_ENDINGS = (".l", ".lpy")
SCAN_ENDINGS = (".csv", ".mat")
PLANT_ENDING = ".npz"
ENDINGS = (SPECIES_ENDING, *PRESET_ENDINGS, *GRAMMAR_ENDINGS, *SCAN_ENDINGS, PLANT_ENDING)
"""Endings of all files that a plant can come from."""


@dataclass(frozen=True, slots=True)
class Grown:
    """A plant and where it came from."""

    plant: Plant
    species: Species | None
    """The form it grew from; None for grammars, scans and saved plants."""
    report: ImportReport | None
    """What became of a foreign file's values; None for what is our own."""


def grow_source(
    source: str | Path,
    seed: int = 0,
    say: Callable[[str], None] = lambda line: None,
    leaf_area: float | None = None,
) -> Plant:
    """The plant that a source means.

    Args:
        source: name of a built-in species or grammar, or path of a file: species .toml, Arbaro or Helios .xml,
            tree-gen or Sapling .py, ez-tree .json, Arbaro list .txt or .arb, grammar .l or .lpy, scan .csv or
            .mat, saved plant .npz.
        seed: 0 or more. A saved plant has its own; a scan draws its leaves with it.
        say: told what an importer or a scan had to change, line by line.
        leaf_area: of a scan, m^2; None reckons it from the trunk, 0 is a bare tree in winter.

    Raises:
        InputError: there is no such source, or something in the file is wrong.
        BudgetError: the plant would be too large.
    """
    grown = grow_with_report(source, seed, leaf_area)
    for line in grown.report.lines() if grown.report else ():
        say(line)
    return grown.plant


def grow_with_report(source: str | Path, seed: int = 0, leaf_area: float | None = None) -> Grown:
    """As `grow_source`, with the species and the report.

    Args:
        source: as there.
        seed: as there.
        leaf_area: as there.
    """
    check_source(source)
    check_seed(seed)
    path, ending = Path(source), Path(source).suffix.lower()
    is_scan = is_path(source) and ending in SCAN_ENDINGS
    if leaf_area is not None and not is_scan:
        expected = f"a scan ({', '.join(SCAN_ENDINGS)}) as the source: other plants bring their own leaves"
        raise InputError("leaf area", "", leaf_area, expected)
    if is_grammar(source):
        from windswept.plants.lsystem import grow_lsystem

        return Grown(grow_lsystem(source, seed), None, None)
    if is_scan:
        from windswept.plants.scans import grow_scan

        plant, report = grow_scan(path, seed, leaf_area)
        return Grown(plant, None, report)
    if is_path(source) and ending == PLANT_ENDING:
        return Grown(load_plant(path), None, None)
    species, read_report = read_species(source)
    return Grown(grow(species, seed), species, read_report)


def read_species(source: str | Path) -> tuple[Species, ImportReport | None]:
    """The species of a name, a species file or a foreign preset; the report only for the last."""
    if is_path(source) and Path(source).suffix.lower() in PRESET_ENDINGS:
        return import_species(Path(source))
    return load_species(source), None


def source_names() -> list[str]:
    """Names of all built-in species and grammars, sorted."""
    return sorted({*species_names(), *_grammar_names()})


def is_path(source: str | Path) -> bool:
    """Whether a source is a file rather than a name."""
    return isinstance(source, Path) or any(mark in source for mark in "/\\.")


def is_grammar(source: str | Path) -> bool:
    """Whether a source is a grammar; where a species has the same name, the species is meant."""
    if is_path(source):
        return Path(source).suffix.lower() in GRAMMAR_ENDINGS
    return source not in species_names() and source in _grammar_names()


def check_source(source: str | Path) -> None:
    """Raise InputError for a name that means nothing and for a file that is missing or of no known ending."""
    shown = one_line(shown_path(source)) or "source"
    if not is_path(source):
        if source in underbrush_names():
            raise InputError(shown, "", None, "a plant that grows alone; underbrush is grown into scenes")
        if source not in source_names():
            hint = nearest(str(source), source_names())
            raise InputError(shown, "", None, f"a built-in species or grammar, or a file: {hint}")
        return
    path = Path(source)
    if path.suffix.lower() not in ENDINGS:
        raise InputError(shown, "", None, f"a file that ends in one of {', '.join(ENDINGS)}")


def _grammar_names() -> list[str]:
    """Names of the built-in grammars."""
    from windswept.plants.lsystem import grammar_names

    return grammar_names()
