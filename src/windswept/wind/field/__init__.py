"""The air and the pushes over one piece of ground, on a grid (Endo 2003, section 4.1, made physical).

    FieldPlan  grid, primitives, obstacles, agents
       | start_field(plan, wind)
    Field      --step_field(field, seconds, agents)-->  velocity (nx, ny, nz, 3) m/s, push (nx, ny, nz, 3) N/m^2
       | sample(field, points, height)
    what the field adds to the wind, (N, 3) m/s

    velocity = (1 - shelter) deflection x (wind + primitives + jets) + departure

The wind and the primitives are known everywhere at once, so a gust's crest keeps its own speed. Around obstacles
they are deflected by a tensor that is solved once (``deflect``). Everything else is a *departure* from that: the
shelter of wakes, air dragged along, and the front of a flow that has just begun. It is carried by the deflected air
(Oseen's approximation: by the stream, not by itself), so that it travels in m/s whatever the step, and dies at a
stated rate.
"""

from windswept.wind.field.agents import Ball, Helicopter, Rain, Walker
from windswept.wind.field.clamps import Clamps
from windswept.wind.field.field import Field, FieldPlan, start_field
from windswept.wind.field.grid import Grid
from windswept.wind.field.obstacles import Box, Cylinder, Spheroid
from windswept.wind.field.path import Path
from windswept.wind.field.primitives import Line, Uniform
from windswept.wind.field.sample import sample
from windswept.wind.field.step_field import step_field

__all__ = [
    "Ball",
    "Box",
    "Clamps",
    "Cylinder",
    "Field",
    "FieldPlan",
    "Grid",
    "Helicopter",
    "Line",
    "Path",
    "Rain",
    "Spheroid",
    "Uniform",
    "Walker",
    "sample",
    "start_field",
    "step_field",
]
