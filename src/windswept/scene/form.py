"""The scene form: what a scene file may say. docs/scene-file.md is made from it.

A scene file is TOML; units are in the keys' names, angles in degrees. Nothing in a file is ever executed.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from windswept.forms.form import Form
from windswept.scene.field_form import FieldForm
from windswept.scene.planting_form import PlantForm, StandForm
from windswept.scene.spread.spread_form import NutrientForm, SpreadForm
from windswept.scene.values import Angle, Length, Level, Place, Point, Seed, Source, Speed, Time


class GroundForm(Form):
    """The ground: a square centred on the origin."""

    kind: Literal["flat", "hills", "image"] = "flat"
    """Level, gentle hills, or heights from an image."""
    size_m: Annotated[float, Field(ge=10, le=4000)] = 200.0
    """Edge of the square; every plant stands on it."""
    relief_m: Annotated[float, Field(ge=0, le=200)] = 3.0
    """Hills: from the lowest to the highest point."""
    hill_length_m: Annotated[float, Field(ge=5, le=2000)] = 80.0
    """Hills: from one hill to the next."""
    image: Source | None = None
    """Image: path of a square grey PNG or TIFF of 8 or 16 bit relative to the scene file; its top is north."""
    heights_m: Annotated[tuple[Level, Level], Field(strict=False)] = (0.0, 10.0)
    """Image: height of black and height of white."""


class GustForm(Form):
    """A front of faster air that travels over the ground."""

    start_s: Time
    """When the front passes `position`."""
    strength_m_s: Annotated[float, Field(ge=0, le=60)]
    """Speed it adds at a height of 10 m."""
    position: Point = (0.0, 0.0)
    """Where the front is at the start, x and y in m."""
    direction_degrees: Angle | None = None
    """Where it travels and pushes to, counter-clockwise from +x; left out: as the mean wind."""
    speed_m_s: Annotated[float, Field(ge=0.01, le=1e6)] = 12.0
    """How fast the front travels."""
    rise_m: Length = 15.0
    """From the front to full strength; 0 for a sudden front."""
    hold_m: Length = 20.0
    """At full strength."""
    decay_m: Length = 30.0
    """From full strength to nothing."""
    width_m: Annotated[float, Field(ge=0.1, le=10_000)] | None = None
    """From the middle to either side, where it has faded to nothing; left out: endless."""


class WaveForm(Form):
    """A train of sine waves of air speed (Skjermo 2007), on top of mean wind and turbulence."""

    wavelength_m: Annotated[float, Field(ge=0.1, le=10_000)]
    """From crest to crest."""
    speed_m_s: Speed
    """How fast the crests travel."""
    amplitude_m_s: Annotated[float, Field(ge=0, le=60)]
    """Half of the range from trough to crest, at a height of 10 m."""
    direction_degrees: Angle | None = None
    """Where the crests travel to, counter-clockwise from +x; left out: as the mean wind."""
    push_degrees: Angle | None = None
    """Where the crests push to; left out: where they travel to."""
    power: Annotated[float, Field(ge=1, le=16)] = 1.0
    """Sharpens the crests and flattens the troughs."""
    phase_degrees: Angle = 0.0
    """Phase at the origin at time 0."""
    start_s: Time | None = None
    """When the waves begin to fade in; left out: they always blew."""
    end_s: Time | None = None
    """When they have faded out; left out: never."""
    fade_s: Annotated[float, Field(ge=0, le=3600)] = 2.0
    """How long fading in and out takes."""
    form: Literal["corrected", "as_printed"] = "corrected"
    """`as_printed` is the paper's own formula: it runs upwind and takes whole powers only."""


class WindForm(Form):
    """The wind: mean, turbulence, gusts and waves add up."""

    speed_m_s: Annotated[float, Field(ge=0, le=60)] = 4.0
    """Mean speed at a height of 10 m."""
    direction_degrees: Angle = 0.0
    """Where the air goes to, counter-clockwise from +x (east)."""
    roughness_m: Annotated[float, Field(ge=0.0001, le=2)] = 0.1
    """Roughness length of the ground: 0.01 short grass, 0.1 fields and hedges, 1 forest."""
    displacement_m: Annotated[float, Field(ge=0, le=9)] = 0.0
    """Height by which a closed canopy lifts the wind, 0.7 of its own."""
    turbulence: Annotated[float, Field(ge=0, le=1)] = 0.25
    """Standard deviation of the speed over the mean speed: 0.1 over water, 0.25 over fields, 0.5 at a canopy."""
    gust: Annotated[list[GustForm], Field(max_length=64)] = Field(default=[])
    """`[[wind.gust]]`, any number."""
    waves: Annotated[list[WaveForm], Field(max_length=64)] = Field(default=[])
    """`[[wind.waves]]`, any number."""


class KeyForm(Form):
    """Where the camera is at one time; between keys it moves smoothly."""

    time_s: Time
    """Later than the key before."""
    eye: Place
    """x, y and height above the ground there, m."""
    target: Place
    """The middle of the picture: x, y and height above the ground there, m."""
    fov_degrees: Annotated[float, Field(ge=1, le=170)] | None = None
    """Vertical field of view; left out: that of the camera."""


class CameraForm(Form):
    """The camera: `eye` and `target` for one that stands, or keys for one that moves."""

    eye: Place | None = None
    """x, y and height above the ground there, m."""
    target: Place | None = None
    """The middle of the picture: x, y and height above the ground there, m."""
    fov_degrees: Annotated[float, Field(ge=1, le=170)] = 40.0
    """Vertical field of view."""
    key: Annotated[list[KeyForm], Field(max_length=1000)] = Field(default=[])
    """`[[camera.key]]`, instead of `eye` and `target`."""


class SunForm(Form):
    """Where the sun stands."""

    azimuth_degrees: Angle = 225.0
    """Counter-clockwise from +x (east): 90 is north, 270 south."""
    elevation_degrees: Annotated[float, Field(ge=-5, le=90)] = 35.0
    """Above the horizon."""


class TimeForm(Form):
    """How long and how often."""

    duration_s: Annotated[float, Field(gt=0, le=3600)] = 10.0
    """Length of the film."""
    fps: Annotated[float, Field(ge=1, le=240)] = 25.0
    """Pictures a second."""


class SceneForm(Form):
    """The file itself."""

    seed: Seed = 0
    """Everything random in the scene follows from it."""
    ground: GroundForm = GroundForm()
    """`[ground]`"""
    wind: WindForm = WindForm()
    """`[wind]`"""
    plant: Annotated[list[PlantForm], Field(max_length=100_000)] = Field(default=[])
    """`[[plant]]`, any number; there is at least one plant or stand, or a spread."""
    stand: Annotated[list[StandForm], Field(max_length=1000)] = Field(default=[])
    """`[[stand]]`, any number."""
    nutrient: Annotated[list[NutrientForm], Field(max_length=64)] = Field(default=[])
    """`[[nutrient]]`, any number."""
    spread: SpreadForm | None = None
    """`[spread]`"""
    field: FieldForm | None = None
    """`[field]`"""
    camera: CameraForm
    """`[camera]`"""
    sun: SunForm = SunForm()
    """`[sun]`"""
    time: TimeForm = TimeForm()
    """`[time]`"""
