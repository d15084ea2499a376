"""What a scene file may say of nutrients in the ground and of plants that spread over it by themselves."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from windswept.forms.form import Form
from windswept.scene.planting_form import AreaForm
from windswept.scene.values import Level, Point, Source

Amount = Annotated[float, Field(ge=0, le=1000)]
Share = Annotated[float, Field(ge=0, le=1)]
Radius = Annotated[float, Field(ge=0.01, le=50)]
Name = Annotated[str, Field(min_length=1, max_length=100)]
Degrees = Annotated[float, Field(ge=0, le=90)]


class NutrientForm(Form):
    """Something that plants take from the ground, over all of it; any unit that the needs of species share."""

    name: Name
    """What species call it."""
    kind: Literal["constant", "noise", "image"] = "constant"
    """The same everywhere, in soft patches, or from an image."""
    rich: Amount = 1.0
    """Amount in a square metre of the richest ground; constant: everywhere; image: where it is white."""
    poor: Amount = 0.0
    """Noise and image: amount in a square metre of the poorest ground, or where the image is black."""
    patch_m: Annotated[float, Field(ge=1, le=4000)] = 25.0
    """Noise: from one rich patch to the next."""
    image: Source | None = None
    """Image: path of a square grey PNG or TIFF relative to the scene file, of any size: its edges are those of the
    ground, and between its pixels amounts go over linearly."""


class NeedForm(Form):
    """What a species takes of one nutrient."""

    nutrient: Name
    """Name of a `[[nutrient]]`."""
    amount: Annotated[float, Field(gt=0, le=1000)]
    """From every square metre that its roots reach; where the ground has too little left, it does not live."""


class SpreadSpeciesForm(Form):
    """One species that spreads: what it needs, what room it takes, and where its offspring go."""

    source: Source
    """Name or path of a plant, as in `[[plant]]`, or of underbrush."""
    points: Annotated[list[Point], Field(max_length=1000)] = Field(default=[])
    """Propagation points, x and y in m: where its seed comes from in every round."""
    random_points: Annotated[int, Field(ge=0, le=1000)] = 0
    """So many more propagation points, anywhere on the spread's ground."""
    need: Annotated[list[NeedForm], Field(max_length=64)] = Field(default=[])
    """`[[spread.species.need]]`, any number."""
    radius_m: Radius
    """Radius of the ground that its stem or tuft fills; no two stand closer than the sum of theirs."""
    spacing_m: Annotated[float, Field(ge=0.02, le=100)] | None = None
    """Least distance between two of this species; left out: twice `radius_m`."""
    reach_m: Radius | None = None
    """Radius of its crown and roots, twice `radius_m` if left out; roots share cells of 0.4 m, larger beyond 160 m."""
    height_m: Annotated[float, Field(gt=0, le=150)]
    """When grown: it shades what is lower."""
    size_v: Annotated[float, Field(ge=0, le=0.9)] = 0.2
    """Spread of sizes about 1, for underbrush; all its lengths go with it. Trees differ by their individuals."""
    shade: Annotated[float, Field(ge=0, le=0.99)] = 0.3
    """Part of the light that its crown takes from lower plants."""
    light: Annotated[tuple[Share, Share], Field(strict=False)] = (0.3, 1.0)
    """From how little to how much of the open sky's light it lives in."""
    slope_degrees: Annotated[tuple[Degrees, Degrees], Field(strict=False)] = (0.0, 45.0)
    """From the gentlest to the steepest ground it grows on."""
    ground_m: Annotated[tuple[Level, Level], Field(strict=False)] = (-10_000.0, 10_000.0)
    """From the lowest to the highest ground it grows on."""
    vigour: Annotated[float, Field(gt=0, le=1)] = 1.0
    """How well it does where it lacks nothing: a strong grass 1, a plant that bears poor ground less."""
    turnover: Share = 0.3
    """Chance that a plant dies in a round where the ground does not suit it at all; trees live longer."""
    offspring: Annotated[int, Field(ge=1, le=16)] = 4
    """Seeds that a plant sheds in a round; a propagation point sheds 16 times as many."""
    distance_m: Annotated[float, Field(ge=0.05, le=1000)] = 1.5
    """Half of its seeds fall within this distance."""
    most: Annotated[int, Field(ge=1, le=1_000_000)] = 1_000_000
    """At most so many of it."""
    individuals: Annotated[int, Field(ge=1, le=100)] = 3
    """Trees: how many different plants are grown and shared by its placements."""


class SpreadForm(Form):
    """Plants that spread from propagation points, around those that a person placed, and compete.

    They compete for nutrients, light and space. Placed plants of a species that spreads count as its plants.
    """

    species: Annotated[list[SpreadSpeciesForm], Field(min_length=1, max_length=64)]
    """`[[spread.species]]`, one or more."""
    area: AreaForm | None = None
    """`[spread.area]`; left out: all the ground."""
    rounds: Annotated[int, Field(ge=1, le=1000)] = 40
    """Generations."""
    most: Annotated[int, Field(ge=1, le=1_000_000)] = 200_000
    """At most so many plants."""
