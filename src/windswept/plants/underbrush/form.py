"""The underbrush form: what a species file of grass, reed, fern or flower may say.

A species is a list of components: a leaf, a stalk, a petal. Each stands on the ground or on a component above it in the
file. Angles are degrees and lengths millimetres, as the names say; the values of the material are SI.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from windswept.forms.form import Form
from windswept.forms.words import Wording
from windswept.plants.species_form import Colour, Identifier, Line, Share

Angle = Annotated[float, Field(ge=-360, le=360)]
Spread = Annotated[float, Field(ge=0, le=180)]


class Component(Form):
    """One kind of blade: its place, its shape, what it is made of and how the air meets it."""

    name: Identifier
    """What the component is called in this file."""
    parent: Annotated[str, Field(max_length=64)] = ""
    """Component that carries it; left out where it stands on the ground."""
    count: Annotated[int, Field(ge=1, le=1000)] = 1
    """How many on each parent, or in the tuft."""
    count_v: Annotated[int, Field(ge=0, le=1000)] = 0
    """By how many the count differs from tuft to tuft."""
    spread_mm: Annotated[float, Field(ge=0, le=2000)] = 0.0
    """Radius of the patch of ground in which the roots stand; not used on a parent."""
    attach_from: Share = 0.0
    """Where along the parent the first one sits: 0 base, 1 tip."""
    attach_to: Share = 0.0
    """Where along the parent the last one sits."""
    tilt_deg: Annotated[float, Field(ge=0, le=180)] = 0.0
    """Angle to the normal of the ground, or to the parent's axis."""
    tilt_v_deg: Spread = 0.0
    """By how much the tilt differs."""
    rotate_deg: Angle = 137.5
    """Turn round the normal or the parent's axis from one to the next."""
    rotate_v_deg: Spread = 0.0
    """By how much that turn differs."""
    shape: Literal["flat", "round"] = "flat"
    """Cross-section: a strip or a tube."""
    length_mm: Annotated[float, Field(gt=0, le=10000)]
    """Along the blade."""
    length_v: Annotated[float, Field(ge=0, le=0.9)] = 0.0
    """By what fraction lengths differ."""
    last_size: Annotated[float, Field(ge=0.05, le=20)] = 1.0
    """Size of the last one on a parent over that of the first, as the leaflets of a fern grow less to its tip."""
    width_mm: Annotated[float, Field(gt=0, le=1000)]
    """Largest width; the diameter of a tube."""
    thickness_mm: Annotated[float, Field(gt=0, le=100)]
    """Of the strip, or of the tube's wall; half the diameter is a solid stem."""
    outline: Annotated[
        list[Share], Field(min_length=2, max_length=33), Wording("2 to 33 numbers from 0 to 1")
    ]
    """Width over the largest width at evenly spaced places from base to tip."""
    sections: Annotated[int, Field(ge=2, le=16)] = 6
    """Rigid sections that it is divided into."""
    curve_deg: Angle = 0.0
    """By which it turns from base to tip without any load, away from the normal of the ground or the parent."""
    density: Annotated[float, Field(ge=1, le=3000)] = 700.0
    """Fresh tissue, kg/m3."""
    youngs_modulus: Annotated[float, Field(ge=1e4, le=1e11)]
    """In bending, Pa."""
    strength: Annotated[float, Field(ge=1e3, le=1e10)] = 5e7
    """Largest stress that bending may cause before it breaks, Pa."""
    side_stiffness: Annotated[float, Field(ge=0.1, le=1000)] = 6.0
    """Bending stiffness in the plane of a strip over that across its face. A strip that is pushed sideways twists and
    yields rather than bend in its plane, so this is far less than (width / thickness)^2. A tube has 1."""
    damping_ratio: Annotated[float, Field(ge=0, le=0.95)] = 0.15
    """Structural damping over critical, without the air."""
    drag: Annotated[float, Field(ge=0.01, le=5)] = 1.0
    """Drag coefficient square to slow wind."""
    edge_drag: Share = 0.25
    """Part of the drag that is left when the air comes along the blade or, for a strip, at its edge."""
    reconfiguration: Annotated[float, Field(ge=-2, le=0)] = -1.0
    """Exponent V: drag grows as speed^(2+V) once blades lie down (Vogel)."""
    reconfiguration_speed: Annotated[float, Field(ge=0.1, le=100)] = 1.5
    """Wind speed at which they begin to, m/s."""
    colour: Colour = (0.10, 0.22, 0.04)
    """Linear RGB at the base."""
    tip_colour: Colour = (0.16, 0.28, 0.06)
    """Linear RGB at the tip."""


class UnderbrushSpecies(Form):
    """Everything a species file of underbrush says."""

    kind: Literal["underbrush"]
    """Tells the file from a tree's."""
    name: Identifier
    """What the plant is called in files and commands."""
    common_name: Line
    """What people call it."""
    latin_name: Line = ""
    """What botanists call it."""
    summary: Line = ""
    """One line for `windswept species`."""
    component: Annotated[list[Component], Field(min_length=1, max_length=16)]
    """`[[component]]`, parents before what they carry."""
