"""Sapling: a bare dictionary in a Python file, camel case, enumerations as texts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from windswept.errors import InputError
from windswept.forms.words import shown
from windswept.plants.importers.draft import SpeciesDraft
from windswept.plants.importers.report import ImportReport
from windswept.plants.species_form import Species

TREE = {
    "levels": "levels",
    "scale": "scale",
    "scaleV": "scale_v",
    "scale0": "scale_0",
    "scaleV0": "scale_v_0",
    "baseSize": "base_size",
    "ratio": "ratio",
    "ratioPower": "ratio_power",
    "rootFlare": "flare",
    "baseSplits": "base_splits",
    "leaves": "leaves",
    "leafScale": "leaf_scale",
    "leafScaleX": "leaf_scale_x",
    "bend": "leaf_bend",
    "pruneRatio": "prune_ratio",
    "pruneWidth": "prune_width",
    "pruneWidthPeak": "prune_width_peak",
    "prunePowerLow": "prune_power_low",
    "prunePowerHigh": "prune_power_high",
}
LEVEL = {
    "downAngle": "down_angle",
    "downAngleV": "down_angle_v",
    "rotate": "rotate",
    "rotateV": "rotate_v",
    "length": "length",
    "lengthV": "length_v",
    "taper": "taper",
    "segSplits": "seg_splits",
    "splitAngle": "split_angle",
    "splitAngleV": "split_angle_v",
    "curveRes": "curve_res",
    "curve": "curve",
    "curveBack": "curve_back",
    "curveV": "curve_v",
}
NOT_OF_TRUNKS = ("downAngle", "downAngleV")
"""Sapling's trunks stand upright whatever these say of level 0; its own presets say 90 degrees."""
LEAF = {
    "leafDownAngle": "down_angle",
    "leafDownAngleV": "down_angle_v",
    "leafRotate": "rotate",
    "leafRotateV": "rotate_v",
}
"""Newer files give the leaves angles of their own."""
CUSTOM_SHAPE = 8
"""Sapling's shape 8 is a drawn profile, which has no counterpart."""
NEEDLES = ("dVert",)


def import_sapling(path: Path, params: dict[str, Any]) -> tuple[Species, ImportReport]:
    """Species of a Sapling preset.

    Args:
        path: the file.
        params: its dictionary.

    Raises:
        InputError: a value is no number.
    """
    draft = SpeciesDraft(path, "a Sapling preset")
    for name, value in sorted(params.items(), key=lambda pair: pair[0] in LEAF or pair[0] == "branches"):
        _take(draft, name, value)
    if not params.get("prune", False):
        draft.tree["prune_ratio"] = 0.0
    return draft.finish(), draft.report


def _take(draft: SpeciesDraft, name: str, value: object) -> None:
    """Take one entry."""
    if name == "shape":
        _take_shape(draft, value)
    elif name == "rootFlare":
        # Sapling's rootFlare is a factor from 1 up, Weber and Penn's Flare what exceeds it.
        draft.take(name, draft.number(name, value) - 1.0, "flare")
    elif name == "attractUp":
        numbers = draft.numbers(name, value)
        draft.take(name, numbers[min(2, len(numbers) - 1)], "attraction_up")
    elif name == "branches":
        numbers = draft.numbers(name, value)
        draft.take_trunks(f"{name}[0]", numbers[0])
        for level, number in enumerate(numbers[1:], 1):
            draft.take(f"{name}[{level}]", number, "branches", level)
    elif name in TREE:
        draft.take(name, value, TREE[name])
    elif name in LEVEL:
        draft.take_levels(name, value, LEVEL[name])
        if name in NOT_OF_TRUNKS:
            draft.levels[0].pop(LEVEL[name])
    elif name in LEAF:
        level = min(int(draft.tree.get("levels", 3)), 3)
        draft.take(name, value, LEAF[name], level)
    elif name == "leafShape":
        draft.look["leaf_shape"] = "needle" if value in NEEDLES else "oval"
        draft.report.taken.append(name)
    else:
        draft.skip(name)


def _take_shape(draft: SpeciesDraft, value: object) -> None:
    """Take the crown's shape, an enumeration as text."""
    number = draft.number("shape", value)
    if number >= CUSTOM_SHAPE:
        draft.report.clamped.append(f"shape {number:g} (custom) -> 4")
        number = 4.0
    if number != int(number) or number < 0:
        raise InputError(draft.source, "shape", shown(value), "a whole number from 0 to 8")
    draft.take("shape", number, "shape")
