"""draw: a turtle reads modules and writes stems and leaves (The Algorithmic Beauty of Plants, p. 19 and 209).

What each symbol does stands in the table at the end; symbols that are not in it do nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from copy import copy
from dataclasses import dataclass

from windswept.errors import InputError
from windswept.plants.lsystem.frame import START, Frame, Vector, added
from windswept.plants.lsystem.polygon import polygon_leaf
from windswept.plants.lsystem.sketch import Seat, Sketch, SketchLeaf, SketchStem
from windswept.plants.lsystem.system import Params, Reading
from windswept.plants.plant import LEAF_FILL

WIDTH_STEP = 0.7
"""Factor of a ! without a parameter on the width; that of # is its inverse."""
FARTHEST = 1e6
"""The turtle goes no farther from the origin, in the grammar's units."""


@dataclass(slots=True)
class TurtleState:
    """What [ keeps and ] gives back."""

    tropism: Vector
    elasticity: float
    position: Vector = (0.0, 0.0, 0.0)
    frame: Frame = START
    stem: int = -1
    """Stem that F goes on with; -1 where it begins a new one."""
    seat: Seat | None = None
    """Node that was reached last; a new stem grows out there."""
    width: float | None = None
    strength: float = 1.0


@dataclass(slots=True)
class Polygon:
    """A polygon while its vertices are marked."""

    base: Vector
    up: Vector
    seat: Seat | None
    vertices: list[Vector]


def draw(modules: Iterable[tuple[str, Params]], reading: Reading, leaf_aspect: float, source: str) -> Sketch:
    """What the turtle draws.

    Args:
        modules: the string, after the homomorphism.
        reading: angle and tropism.
        leaf_aspect: width over length of leaves that give only one of them.
        source: the file, for error messages.

    Raises:
        InputError: a parameter is not finite, or the turtle leaves the world.
    """
    turtle = Turtle(reading, leaf_aspect, source)
    for symbol, params in modules:
        action = _ACTIONS.get(symbol)
        if action is None and symbol[0] != "~":
            continue
        for value in params:
            if not -FARTHEST < value < FARTHEST:
                raise turtle.error(symbol, value, f"parameters between -{FARTHEST:,.0f} and {FARTHEST:,.0f}")
        (action or Turtle.surface)(turtle, params, symbol)
    return turtle.sketch


class Turtle:
    """The turtle: its state, those it keeps, and what it has written."""

    def __init__(self, reading: Reading, leaf_aspect: float, source: str) -> None:
        self.sketch = Sketch()
        self.state = TurtleState(reading.tropism, reading.elasticity)
        self._angle, self._aspect, self._source = math.radians(reading.angle), leaf_aspect, source
        self._width_factor = 2.0 if reading.width_is_radius else 1.0
        self._kept: list[TurtleState] = []
        self._polygons: list[Polygon] = []

    def error(self, symbol: str, value: float, expected: str) -> InputError:
        """What is wrong with a module of the derived string."""
        return InputError(self._source, f"module {symbol}", value, expected)

    def forward(self, params: Params, symbol: str) -> None:
        """F: wood of a length; inside a polygon an edge."""
        start = self.state.position
        self._move(params)
        if self._polygons:
            self._polygons[-1].vertices.append(self.state.position)
        elif self.state.position != start:
            self._write_wood(start)

    def step(self, params: Params, symbol: str) -> None:
        """f: a step without wood; inside a polygon an edge."""
        self._move(params)
        if self._polygons:
            self._polygons[-1].vertices.append(self.state.position)

    def glide(self, params: Params, symbol: str) -> None:
        """G: as F, but inside a polygon a step without an edge."""
        if self._polygons:
            self._move(params)
        else:
            self.forward(params, symbol)

    def glide_unseen(self, params: Params, symbol: str) -> None:
        """g: a step without wood or edge."""
        self._move(params)

    def _move(self, params: Params) -> None:
        length = params[0] if params else 1.0
        position = added(self.state.position, self.state.frame.heading, length)
        if not all(-FARTHEST < value < FARTHEST for value in position):
            raise self.error("F", length, f"a plant within {FARTHEST:,.0f} units of its root")
        self.state.position = position

    def _write_wood(self, start: Vector) -> None:
        """Wood to where the turtle stands: from its last node, or for a trunk from where it stood."""
        state, stems = self.state, self.sketch.stems
        if state.stem < 0:
            state.stem = len(stems)
            if state.seat is None:
                stems.append(SketchStem(None, 0, [start]))
            else:
                mother = stems[state.seat[0]]
                stems.append(SketchStem(state.seat, mother.order + 1, [mother.nodes[state.seat[1]]]))
        stem = stems[state.stem]
        stem.nodes.append(state.position)
        stem.width.append(state.width)
        stem.strength.append(state.strength)
        state.seat = (state.stem, len(stem.nodes) - 1)
        if state.elasticity:
            state.frame = state.frame.bent(state.tropism, state.elasticity)

    def push(self, params: Params, symbol: str) -> None:
        """[: keep the state; what follows is a new stem."""
        self._kept.append(copy(self.state))
        self.state.stem = -1

    def pop(self, params: Params, symbol: str) -> None:
        """]: go back to the state last kept."""
        if self._kept:
            self.state = self._kept.pop()

    def turn(self, params: Params, symbol: str) -> None:
        """+ - & ^ and the two rolls."""
        angle = math.radians(params[0]) if params else self._angle
        frame = self.state.frame
        if symbol in "+-":
            self.state.frame = frame.yawed(angle if symbol == "+" else -angle)
        elif symbol in "&^":
            self.state.frame = frame.pitched(angle if symbol == "&" else -angle)
        else:
            self.state.frame = frame.rolled(angle if symbol == "\\" else -angle)

    def turn_round(self, params: Params, symbol: str) -> None:
        """|: half a turn."""
        self.state.frame = self.state.frame.yawed(math.pi)

    def level(self, params: Params, symbol: str) -> None:
        """$: roll until left is horizontal."""
        self.state.frame = self.state.frame.levelled()

    def set_width(self, params: Params, symbol: str) -> None:
        """! and #: the diameter of the wood to come; without a parameter thinner and thicker."""
        state = self.state
        if params:
            state.width = abs(params[0]) * self._width_factor
        elif state.width is not None:
            state.width *= WIDTH_STEP if symbol == "!" else 1.0 / WIDTH_STEP

    def set_strength(self, params: Params, symbol: str) -> None:
        """@K(s): factor on the stiffness of the joints to come."""
        if params and params[0] <= 0.0:
            raise self.error(symbol, params[0], "a factor above 0")
        self.state.strength = params[0] if params else 1.0

    def set_elasticity(self, params: Params, symbol: str) -> None:
        """@Ts(e): how readily the wood to come bends to the tropism."""
        self.state.elasticity = params[-1] if params else 0.0

    def set_tropism(self, params: Params, symbol: str) -> None:
        """@Tx(x, y, z): where it bends to."""
        if len(params) == 3:
            self.state.tropism = (params[0], params[1], params[2])

    def open_polygon(self, params: Params, symbol: str) -> None:
        """{: a polygon that is attached here."""
        self._polygons.append(Polygon(self.state.position, self.state.frame.up, self.state.seat, []))

    def mark(self, params: Params, symbol: str) -> None:
        """A full stop: a vertex of the polygon."""
        if self._polygons:
            self._polygons[-1].vertices.append(self.state.position)

    def close_polygon(self, params: Params, symbol: str) -> None:
        """}: the polygon becomes a leaf."""
        if self._polygons:
            polygon = self._polygons.pop()
            leaf = polygon_leaf(polygon.base, polygon.vertices, polygon.up, polygon.seat)
            if leaf is not None:
                self.sketch.leaves.append(leaf)

    def surface(self, params: Params, symbol: str) -> None:
        """~l(length, width): a leaf along the heading."""
        length = abs(params[0]) if params else 1.0
        width = abs(params[1]) if len(params) > 1 else self._aspect * length
        self._write_leaf(length, width, in_metres=False)

    def leaf_of_area(self, params: Params, symbol: str) -> None:
        """@A(area): a leaf along the heading, of an area in square metres."""
        area = abs(params[0]) if params else 0.0
        length = math.sqrt(area / (LEAF_FILL * self._aspect))
        self._write_leaf(length, self._aspect * length, in_metres=True)

    def _write_leaf(self, length: float, width: float, in_metres: bool) -> None:
        frame, seat = self.state.frame, self.state.seat
        if length > 0.0 and width > 0.0:
            self.sketch.leaves.append(SketchLeaf(seat, frame.heading, frame.up, length, width, in_metres))


_ACTIONS: dict[str, Callable[[Turtle, Params, str], None]] = {
    "F": Turtle.forward,
    "f": Turtle.step,
    "G": Turtle.glide,
    "g": Turtle.glide_unseen,
    "[": Turtle.push,
    "]": Turtle.pop,
    **dict.fromkeys("+-&^\\/", Turtle.turn),
    "|": Turtle.turn_round,
    "$": Turtle.level,
    "!": Turtle.set_width,
    "#": Turtle.set_width,
    "@K": Turtle.set_strength,
    "@Ts": Turtle.set_elasticity,
    "@Tx": Turtle.set_tropism,
    "{": Turtle.open_polygon,
    ".": Turtle.mark,
    "}": Turtle.close_polygon,
    "@A": Turtle.leaf_of_area,
}
"""Colours (; , '), labels, spheres and everything else do nothing."""
