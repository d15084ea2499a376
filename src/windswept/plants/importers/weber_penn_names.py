"""The parameters of Weber and Penn (1995) by their own names, as Arbaro and Helios files spell them."""

from __future__ import annotations

from windswept.plants.importers.draft import SpeciesDraft

TREE = {
    "shape": "shape",
    "levels": "levels",
    "scale": "scale",
    "scalev": "scale_v",
    "basesize": "base_size",
    "ratio": "ratio",
    "ratiopower": "ratio_power",
    "flare": "flare",
    "lobes": "lobes",
    "lobedepth": "lobe_depth",
    "leaves": "leaves",
    "leafscale": "leaf_scale",
    "leafscalex": "leaf_scale_x",
    "leafbend": "leaf_bend",
    "leafquality": "leaf_quality",
    "attractionup": "attraction_up",
    "pruneratio": "prune_ratio",
    "prunewidth": "prune_width",
    "prunewidthpeak": "prune_width_peak",
    "prunepowerlow": "prune_power_low",
    "prunepowerhigh": "prune_power_high",
    "basesplits": "base_splits",
}
LEVEL = {
    "downangle": "down_angle",
    "downanglev": "down_angle_v",
    "rotate": "rotate",
    "rotatev": "rotate_v",
    "branches": "branches",
    "length": "length",
    "lengthv": "length_v",
    "taper": "taper",
    "segsplits": "seg_splits",
    "splitangle": "split_angle",
    "splitanglev": "split_angle_v",
    "curveres": "curve_res",
    "curve": "curve",
    "curveback": "curve_back",
    "curvev": "curve_v",
}
LEAF_SHAPES = {
    "sphere": "round",
    "disc": "oval",
    "0": "oval",
    "palm": "lance",
    "square": "oval",
    "triangle": "oval",
    "needle": "needle",
}
"""Leaf shapes by name; "disc1" to "disc9" count corners and are ovals with a point, or lobed."""


def take_tree(draft: SpeciesDraft, place: str, value: object) -> None:
    """Take a value that holds for the whole tree, whatever the case of its name."""
    key = TREE.get(place.lower())
    if key is not None:
        draft.take(place, value, key)
    elif place.lower() == "leafshape":
        take_leaf_shape(draft, place, value)
    else:
        draft.skip(place)


def take_level(draft: SpeciesDraft, place: str, name: str, level: int, value: object) -> None:
    """Take a value of one level; those of level 0 partly mean the trunk alone."""
    lower = name.lower()
    if level == 0 and lower in ("scale", "scalev", "basesplits"):
        draft.take(place, value, {"scale": "scale_0", "scalev": "scale_v_0"}.get(lower, "base_splits"))
    elif level == 0 and lower == "branches":
        draft.take_trunks(place, value)
    elif lower in LEVEL:
        draft.take(place, value, LEVEL[lower], level)
    else:
        draft.skip(place)


def take_leaf_shape(draft: SpeciesDraft, place: str, value: object) -> None:
    """Take the nearest of our leaf shapes."""
    word = str(value).strip().lower()
    if word.startswith("disc") and word[4:].isdigit():
        shape = "lobed" if int(word[4:]) >= 5 else "oval"
    else:
        shape = LEAF_SHAPES.get(word, "oval")
    if word not in LEAF_SHAPES:
        draft.report.clamped.append(f"{place} {word[:20]} -> {shape}")
    draft.look["leaf_shape"] = shape
    draft.report.taken.append(place)
