"""Compile the expressions and blocks of a rule to closures; nothing is ever evaluated as Python.

A closure takes the rule's values (parameters, then locals, by slot) and the random numbers to draw from. All
values are floats, as in cpfg; comparisons give 1 or 0, angles are degrees.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass, field

from numpy.random import Generator

from windswept.errors import InputError
from windswept.forms.words import nearest
from windswept.plants.lsystem.functions import DRAWS, FUNCTIONS
from windswept.plants.lsystem.notation import Node

Values = list[float]
Expression = Callable[[Values, Generator], float]
Block = Callable[[Values, Generator], None]

_BINARY: dict[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "%": math.fmod,
    "^": math.pow,
    "**": math.pow,
    "<": lambda a, b: float(a < b),
    ">": lambda a, b: float(a > b),
    "<=": lambda a, b: float(a <= b),
    ">=": lambda a, b: float(a >= b),
    "==": lambda a, b: float(a == b),
    "=": lambda a, b: float(a == b),
    "!=": lambda a, b: float(a != b),
}
_AND, _OR = ("&&", "&", "and"), ("||", "|", "or")


@dataclass(slots=True)
class Scope:
    """The names that one statement may use."""

    source: str
    line: int
    slots: dict[str, int] = field(default_factory=dict)
    """Parameters and locals by their place among the values."""
    constants: dict[str, float] = field(default_factory=dict)
    """Names that stand for a number in the whole file."""

    def error(self, node: Node, expected: str) -> InputError:
        """What is wrong at a node."""
        row = getattr(node.meta, "line", 1)
        return InputError(self.source, f"line {self.line + row - 1}", None, expected)


def compile_expression(node: Node, scope: Scope) -> float | Expression:
    """A number where the expression is constant, else a closure.

    Raises:
        InputError: an unknown name or function, or a wrong number of arguments.
    """
    return _COMPILERS[node.data](node, scope)


def running(code: float | Expression) -> Expression:
    """A closure in either case."""
    if not isinstance(code, float):
        return code
    value = code
    return lambda values, dice: value


def _number(node: Node, scope: Scope) -> float:
    return float(str(node.children[0]).rstrip("fF"))


def _text(node: Node, scope: Scope) -> float:
    """Texts are labels, which the turtle does not draw."""
    return 0.0


def _name(node: Node, scope: Scope) -> float | Expression:
    name = str(node.children[0])
    if name in scope.slots:
        slot = scope.slots[name]
        return lambda values, dice: values[slot]
    if name in scope.constants:
        return scope.constants[name]
    known = [*scope.slots, *scope.constants]
    raise scope.error(node, f"a known name, not {name[:40]}" + (f": {nearest(name, known)}" if known else ""))


def _call(node: Node, scope: Scope) -> float | Expression:
    name = str(node.children[0])
    arguments = [compile_expression(child, scope) for child in node.children[1:] if child is not None]
    table = DRAWS if name in DRAWS else FUNCTIONS
    if name not in table:
        known = sorted([*FUNCTIONS, *DRAWS])
        raise scope.error(node, f"a known function, not {name[:40]}: {nearest(name, known)}")
    function, count = table[name]
    if len(arguments) != count:
        raise scope.error(node, f"{count} argument{'s' * (count != 1)} of {name}, not {len(arguments)}")
    parts = [running(code) for code in arguments]
    if name in DRAWS:
        return lambda values, dice: function(dice, *[part(values, dice) for part in parts])
    return _folded(arguments, lambda values, dice: function(*[part(values, dice) for part in parts]))


def _unary(node: Node, scope: Scope) -> float | Expression:
    sign, inner = str(node.children[0]), compile_expression(node.children[1], scope)
    code = running(inner)
    if sign == "+":
        return inner
    if sign == "-":
        return _folded([inner], lambda values, dice: -code(values, dice))
    return _folded([inner], lambda values, dice: float(not code(values, dice)))


def _binary(node: Node, scope: Scope) -> float | Expression:
    left, right = (compile_expression(node.children[i], scope) for i in (0, 2))
    sign, first, second = str(node.children[1]), running(left), running(right)
    if sign in _AND:
        code = _both(first, second)
    elif sign in _OR:
        code = _either(first, second)
    else:
        code = _applied(_BINARY[sign], first, second)
    return _folded([left, right], code)


def _both(first: Expression, second: Expression) -> Expression:
    return lambda values, dice: float(bool(first(values, dice) and second(values, dice)))


def _either(first: Expression, second: Expression) -> Expression:
    return lambda values, dice: float(bool(first(values, dice) or second(values, dice)))


def _applied(function: Callable[[float, float], float], first: Expression, second: Expression) -> Expression:
    return lambda values, dice: function(first(values, dice), second(values, dice))


def _ternary(node: Node, scope: Scope) -> float | Expression:
    parts = [compile_expression(child, scope) for child in node.children]
    test, yes, no = (running(part) for part in parts)
    return _folded(parts, lambda values, dice: yes(values, dice) if test(values, dice) else no(values, dice))


def _folded(parts: list[float | Expression], code: Expression) -> float | Expression:
    """The value of an expression of constants; the closure where it has none (it may never be reached)."""
    if not all(isinstance(part, float) for part in parts):
        return code
    try:
        return float(code([], None))  # type: ignore[arg-type]
    except (ArithmeticError, ValueError):
        return code


_COMPILERS: dict[str, Callable[[Node, Scope], float | Expression]] = {
    "number": _number,
    "text": _text,
    "name": _name,
    "call": _call,
    "unary": _unary,
    "binary": _binary,
    "ternary": _ternary,
}


def compile_block(node: Node, scope: Scope) -> Block:
    """A closure that runs the assignments of a block; its locals get slots in the scope."""
    if node.data == "assign":
        return _assignment(node, scope)
    if node.data == "choice":
        return _choice(node, scope)
    steps = [compile_block(child, scope) for child in node.children]

    def run(values: Values, dice: Generator) -> None:
        for step in steps:
            step(values, dice)

    return run


def _assignment(node: Node, scope: Scope) -> Block:
    name, sign = str(node.children[0]), str(node.children[1])
    if sign != "=" and name not in scope.slots:
        raise scope.error(node, f"{name[:40]} to be assigned before {sign}")
    code = running(compile_expression(node.children[2], scope))
    slot = scope.slots.setdefault(name, len(scope.slots))

    def assign(values: Values, dice: Generator) -> None:
        values[slot] = code(values, dice)

    if sign == "=":
        return assign
    function = _BINARY[sign[0]]

    def update(values: Values, dice: Generator) -> None:
        values[slot] = function(values[slot], code(values, dice))

    return update


def _choice(node: Node, scope: Scope) -> Block:
    test = running(compile_expression(node.children[0], scope))
    yes = compile_block(node.children[1], scope)
    no = compile_block(node.children[2], scope) if node.children[2] is not None else None

    def choose(values: Values, dice: Generator) -> None:
        if test(values, dice):
            yes(values, dice)
        elif no is not None:
            no(values, dice)

    return choose
