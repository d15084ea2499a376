"""grow_scan: from a file of cylinders to a plant."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from windswept.errors import BudgetError, InputError
from windswept.forms.read_text import shown_path
from windswept.plants.importers.draft import identifier
from windswept.plants.importers.report import ImportReport
from windswept.plants.plant import Material, Plant
from windswept.plants.scans.join import join
from windswept.plants.scans.leaves import Angles, add_leaves, usual_leaf_area
from windswept.plants.scans.read_scan import read_scan
from windswept.plants.scans.repair import repair
from windswept.plants.scans.stems import LONGEST_LINK, build_stems
from windswept.plants.validate import validate

TALLEST = 150.0
"""No tree is taller or wider, m: a larger extent is in other units."""
MOST_LINKS = 300_000
LARGEST_LEAF_AREA = 20_000.0
"""m^2."""


def grow_scan(
    path: Path,
    seed: int = 0,
    leaf_area: float | None = None,
    material: Material | None = None,
    angles: Angles = "planophile",
    clamp_radii: bool = False,
) -> tuple[Plant, ImportReport]:
    """Plant of a quantitative structure model, and what had to be mended.

    Args:
        path: .csv or .mat; a row is radius, length, start xyz, axis xyz, parent (from 1, 0 for a root).
        seed: of the leaves.
        leaf_area: m^2; None reckons it from the trunk, 0 is a bare tree in winter.
        material: of wood and leaves; None for green broadleaf wood.
        angles: how leaves are inclined.
        clamp_radii: let no cylinder be thicker than its parent.

    Raises:
        InputError: the file is damaged, a number in it cannot be, or the parents form a cycle.
        BudgetError: there would be too many links.
    """
    source = shown_path(path)
    if leaf_area is not None and not 0.0 <= leaf_area <= LARGEST_LEAF_AREA:
        raise InputError("leaf area", "", leaf_area, f"a number from 0 to {LARGEST_LEAF_AREA:,.0f} m^2")
    report = ImportReport("scanned cylinders")
    cylinders = repair(source, read_scan(path), report, clamp_radii)
    joined = join(cylinders)
    extent = float(np.abs(joined.tip).max())
    if extent > TALLEST:
        raise InputError(
            source, "", None, f"a tree of at most {TALLEST:g} m from its foot, not {extent:.3g} m"
        )
    links = int(np.ceil(np.linalg.norm(joined.tip - joined.base, axis=1) / LONGEST_LINK).sum())
    if links > MOST_LINKS:
        raise BudgetError(f"{source}: {links:,} links, budget {MOST_LINKS:,}: thin out the cylinders")
    bare = build_stems(cylinders, joined, identifier(path.stem), seed, material or Material())
    area = usual_leaf_area(bare) if leaf_area is None else leaf_area
    plant = add_leaves(bare, area, np.random.default_rng(seed), angles)
    report.taken_rows = cylinders.count
    if leaf_area is None:
        report.defaulted += [f"leaf area {area:.0f} m^2", "material"]
    validate(plant)
    return plant, report
