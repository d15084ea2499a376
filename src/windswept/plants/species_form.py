"""The species form: what a species file may say, and reading one.

A species file is TOML. Angles are degrees and lengths metres; the names are Weber and Penn's (1995) in snake
case. Nothing in a file is ever executed.
"""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated, Literal

from pydantic import Field

from windswept.forms.form import Form
from windswept.forms.words import Wording
from windswept.plants.plant import Look, Material

Identifier = Annotated[
    str,
    Field(pattern=r"^[a-z][a-z0-9_]{0,63}$"),
    Wording("a name of a-z, 0-9 and _ that begins with a letter"),
]
Line = Annotated[str, Field(max_length=200, pattern=r"^[^\r\n]*$"), Wording("one line of text")]
Angle = Annotated[float, Field(ge=-360, le=360)]
Spread = Annotated[float, Field(ge=0, le=360)]
Share = Annotated[float, Field(ge=0, le=1)]
Colour = Annotated[tuple[Share, Share, Share], Field(strict=False)]

_MATERIAL, _LOOK = asdict(Material()), asdict(Look())


class Level(Form):
    """How the stems of one branching order grow; the last table also serves every order after it.

    The table whose number is `Growth.levels` tells how leaves stand: only its angles are used.
    """

    down_angle: Angle = 0.0
    """nDownAngle, angle between a stem and its parent; on level 0 the lean of the trunk."""
    down_angle_v: Angle = 0.0
    """nDownAngleV; negative: the angle changes along the parent instead of at random."""
    rotate: Angle = 0.0
    """nRotate, turn round the parent from one stem to the next; negative: to alternate sides. Not on level 0."""
    rotate_v: Angle = 0.0
    """nRotateV."""
    branches: Annotated[int, Field(ge=0, le=1000)] = 0
    """nBranches, most stems of this level on one parent; not used on level 0."""
    length: Annotated[float, Field(ge=0, le=10)] = 0.0
    """nLength, as a fraction of the parent's length (level 0: of the tree's scale)."""
    length_v: Annotated[float, Field(ge=0, le=10)] = 0.0
    """nLengthV, by how much length differs from stem to stem."""
    taper: Annotated[float, Field(ge=0, le=3)] = 1.0
    """nTaper: 0 cylinder, 1 cone, 2 rounded end, 3 beads."""
    seg_splits: Annotated[float, Field(ge=0, le=4)] = 0.0
    """nSegSplits, mean number of clones at the end of a segment."""
    split_angle: Annotated[float, Field(ge=0, le=180)] = 0.0
    """nSplitAngle, by which a fork opens."""
    split_angle_v: Annotated[float, Field(ge=0, le=180)] = 0.0
    """nSplitAngleV."""
    curve_res: Annotated[int, Field(ge=1, le=64)] = 1
    """nCurveRes, number of segments of a stem."""
    curve: Angle = 0.0
    """nCurve, by which a stem turns from base to tip, away from its parent."""
    curve_back: Angle = 0.0
    """nCurveBack: when not 0, the upper half turns by this and the lower half by `curve`."""
    curve_v: Angle = 0.0
    """nCurveV; negative: the stem is a helix at this angle to its axis."""


class Growth(Form):
    """Weber and Penn's parameters of the whole tree."""

    shape: Annotated[int, Field(ge=0, le=8)]
    """Shape of the crown: 0 conical, 1 spherical, 2 hemispherical, 3 cylindrical, 4 tapered cylindrical,
    5 flame, 6 inverse conical, 7 tend flame, 8 the pruning envelope."""
    levels: Annotated[int, Field(ge=1, le=4)]
    """Levels, number of branching orders; leaves stand on the last."""
    scale: Annotated[float, Field(ge=0.05, le=150)]
    """Scale, m."""
    scale_v: Annotated[float, Field(ge=0, le=150)] = 0.0
    """ScaleV, by how much trees differ, m."""
    base_size: Annotated[float, Field(ge=0, le=0.95)] = 0.0
    """BaseSize, bare fraction of the trunk."""
    ratio: Annotated[float, Field(ge=0.001, le=0.5)]
    """Ratio, trunk radius over trunk length."""
    ratio_power: Annotated[float, Field(ge=0, le=5)] = 1.0
    """RatioPower, how fast radius falls with length from parent to child."""
    flare: Annotated[float, Field(ge=0, le=10)] = 0.0
    """Flare, by how much the trunk widens at its foot: 1 doubles its radius."""
    lobes: Annotated[int, Field(ge=0, le=32)] = 0
    """Lobes round the trunk."""
    lobe_depth: Annotated[float, Field(ge=0, le=0.9)] = 0.0
    """LobeDepth, over the radius."""
    base_splits: Annotated[int, Field(ge=0, le=32)] = 0
    """0BaseSplits, clones of the trunk at the end of its first segment."""
    leaves: Annotated[int, Field(ge=-1000, le=1000)] = 0
    """Leaves, most leaves on one stem; negative: that many in a fan at the tip."""
    leaf_scale: Annotated[float, Field(ge=0.001, le=5)] = 0.1
    """LeafScale, length of a leaf, m."""
    leaf_scale_x: Annotated[float, Field(ge=0.01, le=10)] = 1.0
    """LeafScaleX, width of a leaf over its length."""
    leaf_bend: Share = 0.0
    """LeafBend, how far leaves turn to the light."""
    leaf_quality: Annotated[float, Field(ge=0.01, le=1)] = 1.0
    """Fraction of the leaves that are grown, larger, so that their area stays."""
    attraction_up: Annotated[float, Field(ge=-20, le=20)] = 0.0
    """AttractionUp, from order 2 on; negative: stems weep."""
    prune_ratio: Share = 0.0
    """PruneRatio: 0 no pruning, 1 everything inside the envelope."""
    prune_width: Annotated[float, Field(gt=0, le=2)] = 0.5
    """PruneWidth, radius of the envelope over the tree's scale."""
    prune_width_peak: Annotated[float, Field(ge=0, le=0.99)] = 0.5
    """PruneWidthPeak, fraction of the crown's height at which the envelope is widest."""
    prune_power_low: Annotated[float, Field(ge=0, le=10)] = 0.5
    """PrunePowerLow: 1 straight, less bulges out, more caves in, below the peak."""
    prune_power_high: Annotated[float, Field(ge=0, le=10)] = 0.5
    """PrunePowerHigh: the same above the peak."""
    scale_0: Annotated[float, Field(ge=0.1, le=10)] = 1.0
    """0Scale, factor on the trunk's radius alone."""
    scale_v_0: Annotated[float, Field(ge=0, le=10)] = 0.0
    """0ScaleV."""
    level: Annotated[list[Level], Field(min_length=1, max_length=5)]
    """`[[growth.level]]`, one for each order and one for the leaves."""

    def at(self, order: int) -> Level:
        """The table that serves a branching order."""
        return self.level[min(order, len(self.level) - 1)]


class MaterialForm(Form):
    """The fields of `Material`."""

    youngs_modulus: Annotated[float, Field(ge=1e6, le=1e11)] = _MATERIAL["youngs_modulus"]
    """Bending modulus of green wood, Pa."""
    wood_density: Annotated[float, Field(ge=50, le=2000)] = _MATERIAL["wood_density"]
    """Green wood, kg/m3."""
    damping_ratio: Annotated[float, Field(ge=0, le=0.95)] = _MATERIAL["damping_ratio"]
    """Structural damping over critical, without the air."""
    leaf_mass: Annotated[float, Field(ge=0.001, le=20)] = _MATERIAL["leaf_mass"]
    """Fresh leaf mass per area, kg/m2."""
    leaf_drag: Annotated[float, Field(ge=0, le=5)] = _MATERIAL["leaf_drag"]
    """Drag coefficient of a leaf square to slow wind."""
    wood_drag: Annotated[float, Field(ge=0, le=5)] = _MATERIAL["wood_drag"]
    """Drag coefficient of a bare stem across the wind."""
    reconfiguration: Annotated[float, Field(ge=-2, le=0)] = _MATERIAL["reconfiguration"]
    """Exponent V: leaf drag grows as speed^(2+V) once leaves fold (Vogel)."""
    reconfiguration_speed: Annotated[float, Field(ge=0.1, le=100)] = _MATERIAL["reconfiguration_speed"]
    """Wind speed at which leaves begin to fold, m/s."""


class LookForm(Form):
    """The fields of `Look`."""

    bark_colour: Colour = _LOOK["bark_colour"]
    """Linear RGB."""
    bark_relief: Share = _LOOK["bark_relief"]
    """Depth of the bark: 0 smooth, 1 deeply furrowed."""
    bark_bulges: Annotated[int, Field(ge=0, le=200)] = _LOOK["bark_bulges"]
    """Swellings along a stem."""
    bark_bulge_depth: Annotated[float, Field(ge=0, le=0.9)] = _LOOK["bark_bulge_depth"]
    """Depth of the swellings over the radius."""
    leaf_colour: Colour = _LOOK["leaf_colour"]
    """Linear RGB of the upper face."""
    leaf_back_colour: Colour = _LOOK["leaf_back_colour"]
    """Linear RGB of the lower face."""
    leaf_shape: Literal["oval", "round", "lance", "lobed", "needle"] = _LOOK["leaf_shape"]
    """Outline of a leaf."""
    leaf_flutter: Share = _LOOK["leaf_flutter"]
    """How readily a leaf trembles: 0 stiff, 1 aspen."""


class Species(Form):
    """Everything a species file says."""

    name: Identifier
    """What the plant is called in files and commands."""
    common_name: Line
    """What people call it."""
    latin_name: Line = ""
    """What botanists call it."""
    summary: Line = ""
    """One line for `windswept species`."""
    growth: Growth
    """`[growth]`"""
    material: MaterialForm = MaterialForm()
    """`[material]`"""
    look: LookForm = LookForm()
    """`[look]`"""

    def plant_material(self) -> Material:
        """What the plant's wood and leaves are made of."""
        return Material(**self.material.model_dump())

    def plant_look(self) -> Look:
        """What the plant looks like."""
        return Look(**self.look.model_dump())
