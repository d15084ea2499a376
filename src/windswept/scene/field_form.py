"""The field's part of a scene file: `[field]` and what stands, flows and moves in it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from windswept.forms.form import Form

Coordinate = Annotated[float, Field(ge=-10_000, le=10_000)]
Point = Annotated[tuple[Coordinate, Coordinate], Field(strict=False)]
Place = Annotated[tuple[Coordinate, Coordinate, Coordinate], Field(strict=False)]
Box = Annotated[tuple[Coordinate, Coordinate, Coordinate, Coordinate], Field(strict=False)]
Edge = Annotated[float, Field(ge=0.01, le=1000)]
Edges = Annotated[tuple[Edge, Edge], Field(strict=False)]
Angle = Annotated[float, Field(ge=-360, le=360)]
Time = Annotated[float, Field(ge=-3600, le=86_400)]
Velocity = Annotated[float, Field(ge=-60, le=60)]
Velocities = Annotated[tuple[Velocity, Velocity, Velocity], Field(strict=False)]


class PrimitiveForm(Form):
    """A flow primitive (Wejchert and Haumann 1991), added to the wind inside the field."""

    kind: Literal["uniform", "source", "sink", "vortex"]
    """The same velocity everywhere, or out of, into or round a straight line."""
    velocity_m_s: Velocities | None = None
    """Uniform: x, y and z of the velocity."""
    position: Place | None = None
    """Others: a point of the line at time 0, x, y and height above ground in m."""
    strength_m2_s: Annotated[float, Field(ge=-1000, le=1000)] | None = None
    """Others: volume blown out or sucked in, or circulation (counter-clockwise), per metre of the line."""
    core_m: Annotated[float, Field(ge=0.05, le=1000)] = 1.0
    """Radius inside which the flow is tamed."""
    axis: Literal["x", "y", "z"] = "z"
    """Direction of the line."""
    drift_m_s: Velocities = (0.0, 0.0, 0.0)
    """Velocity at which the line moves."""
    start_s: Time | None = None
    """When it begins: from then on it comes in from the border; left out: it always blew."""
    end_s: Time | None = None
    """When it ends; left out: never."""


class ObstacleForm(Form):
    """Something that stands in the air; the wind goes round it, and it has a wake."""

    kind: Literal["sphere", "crown", "post", "box"]
    """A ball, an upright ellipsoid, an upright cylinder, or a box."""
    position: Point
    """x and y of its middle, m."""
    radius_m: Edge | None = None
    """Sphere, crown and post."""
    size_m: Edges | None = None
    """Box: its edges along its own x and y."""
    bottom_m: Annotated[float, Field(ge=0, le=1000)] = 0.0
    """Height above ground at which it begins; a box begins on the ground."""
    top_m: Annotated[float, Field(ge=0.01, le=1000)] | None = None
    """Height above ground at which it ends; a sphere's follows from its radius."""
    yaw_degrees: Angle = 0.0
    """Box: turn about the vertical, counter-clockwise."""
    openness: Annotated[float, Field(ge=0, le=0.95)] = 0.0
    """0 for a solid; for leaves and fences the share of air that still passes, 0.3 to 0.7."""


class StopForm(Form):
    """Where an agent is at one time; between stops it moves straight on."""

    time_s: Time
    """Later than the stop before."""
    position: Point
    """x and y, m."""


class AgentForm(Form):
    """Something that pushes plants and air for a while."""

    kind: Literal["ball", "person", "helicopter", "rain"]
    """What it is."""
    stop: Annotated[list[StopForm], Field(max_length=1000)] = Field(default=[])
    """`[[field.agent.stop]]`, two or more for all but rain: there is nothing before the first and after the last."""
    radius_m: Edge | None = None
    """Ball (0.11, a football) or rotor (5)."""
    mass_kg: Annotated[float, Field(ge=1, le=50_000)] | None = None
    """Person (70) or helicopter (2,000)."""
    pressure_n_m2: Annotated[float, Field(ge=0, le=100_000)] | None = None
    """Ball: on plants below its middle (400, as a wind of 25 m/s)."""
    rate_mm_h: Annotated[float, Field(gt=0, le=500)] | None = None
    """Rain: 2 light, 10 heavy, 50 a cloudburst."""
    drop_mm: Annotated[float, Field(ge=0.3, le=6)] = 2.0
    """Rain: diameter of the drops."""
    start_s: Time | None = None
    """Rain: when it begins; left out: it always rained."""
    end_s: Time | None = None
    """Rain: when it ends; left out: never."""


class FieldForm(Form):
    """A grid of air and pushes over a piece of the ground, for what the wind alone does not say."""

    area: Box | None = None
    """West, south, east, north, m; left out: the whole ground."""
    cell_m: Annotated[float, Field(ge=0.05, le=100)] = 1.0
    """Distance between nodes along x and y."""
    layer_m: Annotated[float, Field(ge=0.02, le=100)] = 1.0
    """Distance between nodes upwards."""
    height_m: Annotated[float, Field(ge=0.1, le=1000)] = 15.0
    """Height of the field above the ground."""
    relaxation_per_s: Annotated[float, Field(ge=0, le=100)] = 0.25
    """Rate at which wakes and other disturbances die away."""
    primitive: Annotated[list[PrimitiveForm], Field(max_length=64)] = Field(default=[])
    """`[[field.primitive]]`, any number."""
    obstacle: Annotated[list[ObstacleForm], Field(max_length=1000)] = Field(default=[])
    """`[[field.obstacle]]`, any number."""
    agent: Annotated[list[AgentForm], Field(max_length=1000)] = Field(default=[])
    """`[[field.agent]]`, any number."""
