"""What the turtle writes: stems as rows of nodes, and leaves that stand on nodes."""

from __future__ import annotations

from dataclasses import dataclass, field

from windswept.plants.lsystem.frame import Vector

Seat = tuple[int, int]
"""A stem and one of its nodes."""


@dataclass(slots=True)
class SketchStem:
    """One stem: nodes from base to tip, and what lies between them. All in the grammar's units."""

    seat: Seat | None
    """Where it grows out; None for a trunk."""
    order: int
    nodes: list[Vector]
    width: list[float | None] = field(default_factory=list)
    """Diameter of the wood after each node but the last; None where the grammar sets none."""
    strength: list[float] = field(default_factory=list)
    """Joint strength factor of the same."""


@dataclass(frozen=True, slots=True)
class SketchLeaf:
    """One leaf; its position is that of its node."""

    seat: Seat | None
    """None where no wood came before it."""
    axis: Vector
    normal: Vector
    length: float
    width: float
    in_metres: bool = False
    """Whether length and width are metres and not the grammar's units."""


@dataclass(slots=True)
class Sketch:
    """Everything the turtle has written."""

    stems: list[SketchStem] = field(default_factory=list)
    leaves: list[SketchLeaf] = field(default_factory=list)
