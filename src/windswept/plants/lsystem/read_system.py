"""read_system: from the text of a grammar in cpfg notation to a System."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from windswept.errors import InputError
from windswept.forms.words import shown
from windswept.plants.lsystem.compile_rule import compile_rule, compile_word
from windswept.plants.lsystem.expression import Scope, compile_expression
from windswept.plants.lsystem.macros import expand_macros
from windswept.plants.lsystem.notation import parse
from windswept.plants.lsystem.source_text import refuse_strangers, without_comments
from windswept.plants.lsystem.statements import Statement, split_statements
from windswept.plants.lsystem.system import Reading, Rewriting, Rule, System

MOST_STEPS = 10_000
"""Longest derivation."""
DEFAULT_ANGLE = 22.5
"""Turn of a rotation without a parameter where the grammar gives none, degrees."""


@dataclass(slots=True)
class Draft:
    """A system while its statements are read."""

    source: str
    constants: dict[str, float] = field(default_factory=dict)
    axiom: Statement | None = None
    numbers: dict[str, list[float]] = field(default_factory=dict)
    """Values of headers."""
    rules: dict[str, list[Rule]] = field(default_factory=dict)
    """By section."""
    depth: dict[str, int] = field(default_factory=dict)
    """`maximum depth` by section."""
    ignored: frozenset[str] = frozenset()
    considered: frozenset[str] | None = None
    section: str = "production"
    reading: Reading = field(default_factory=lambda: Reading(DEFAULT_ANGLE))


def read_system(text: str, source: str) -> System:
    """An L-system in cpfg notation.

    Args:
        text: the whole file.
        source: its name, for error messages.

    Raises:
        InputError: with the line.
    """
    refuse_strangers(text, source)
    if not text.strip():
        raise InputError(source, "", None, "an L-system; the file is empty")
    lines = expand_macros(without_comments(text, source), source)
    return build_system(split_statements(lines), Draft(source))


def build_system(statements: list[Statement], draft: Draft) -> System:
    """The system that statements say."""
    for statement in statements:
        _READERS.get(statement.kind, _number_header)(statement, draft)
    if draft.axiom is None:
        raise InputError(draft.source, "", None, "an L-system in cpfg notation with an Axiom: line")
    axiom = compile_word(draft.axiom.text, draft.source, draft.axiom.line, draft.constants)
    if not axiom:
        raise InputError(draft.source, f"line {draft.axiom.line}", None, "modules after Axiom:")
    parts = [_rewriting(draft, name) for name in ("production", "decomposition", "homomorphism")]
    return System(
        source=draft.source,
        seed=int(draft.numbers.get("seed", [0])[0]),
        steps=int(draft.numbers.get("derivation length", [0])[0]),
        axiom=axiom,
        axiom_line=draft.axiom.line,
        production=parts[0],
        decomposition=parts[1],
        homomorphism=parts[2],
        ignored=draft.ignored,
        considered=draft.considered,
        reading=_reading(draft),
    )


def _rewriting(draft: Draft, section: str) -> Rewriting:
    """The rules of a section by what they rewrite."""
    families: dict[tuple[str, int], list[Rule]] = {}
    for rule in draft.rules.get(section, []):
        if section != "production" and (rule.left or rule.right):
            place = f"line {rule.line}"
            raise InputError(draft.source, place, None, f"no context in a rule of the {section}")
        families.setdefault((rule.symbol, rule.arity), []).append(rule)
    return Rewriting({key: tuple(rules) for key, rules in families.items()}, draft.depth.get(section))


def _reading(draft: Draft) -> Reading:
    """What the headers say about the turtle."""
    numbers, reading = draft.numbers, draft.reading
    if "angle factor" in numbers:
        reading = replace(reading, angle=360.0 / numbers["angle factor"][0])
    if "angle increment" in numbers:
        reading = replace(reading, angle=numbers["angle increment"][0])
    if "tropism direction" in numbers:
        x, y, z = numbers["tropism direction"]
        reading = replace(reading, tropism=(x, y, z))
    return replace(reading, elasticity=numbers.get("elasticity", [reading.elasticity])[0])


def _axiom(statement: Statement, draft: Draft) -> None:
    if draft.axiom is not None:
        raise InputError(draft.source, f"line {statement.line}", None, "one Axiom: only")
    draft.axiom = statement


def _rule(statement: Statement, draft: Draft) -> None:
    rule = compile_rule(statement, draft.source, draft.constants)
    draft.rules.setdefault(draft.section, []).append(rule)


def _section(statement: Statement, draft: Draft) -> None:
    draft.section = _SECTION_NAMES.get(statement.text, statement.text)


def _lsystem(statement: Statement, draft: Draft) -> None:
    if "lsystem" in draft.numbers:
        place = f"line {statement.line}"
        raise InputError(draft.source, place, None, "one L-system in a file; sub-L-systems are not read")
    draft.numbers["lsystem"] = []


def _ignore(statement: Statement, draft: Draft) -> None:
    text = statement.text.replace("[", " ").replace("]", " ")
    word = compile_word(text, draft.source, statement.line, {})
    symbols = frozenset(piece.symbol for piece in word)
    if statement.kind == "ignore":
        draft.ignored = symbols
    else:
        draft.considered = symbols


def _maximum_depth(statement: Statement, draft: Draft) -> None:
    draft.depth[draft.section] = int(_numbers(statement, draft, 1, (1, 1000), whole=True)[0])


def _unsupported(statement: Statement, draft: Draft) -> None:
    what = {"group": "groups", "endgroup": "groups"}.get(statement.kind, f"{statement.kind.title()}: blocks")
    expected = f"an L-system without what windswept does not read: {what}"
    raise InputError(draft.source, f"line {statement.line}", None, expected)


_LIMITS: dict[str, tuple[int, float, float, bool]] = {
    "derivation length": (1, 0, MOST_STEPS, True),
    "seed": (1, 0, 2**53, True),
    "angle factor": (1, 1, 360, False),
    "angle increment": (1, -360, 360, False),
    "tropism direction": (3, -1000, 1000, False),
    "elasticity": (1, -1000, 1000, False),
}
"""Count of numbers, least, most, whole."""


def _number_header(statement: Statement, draft: Draft) -> None:
    count, low, high, whole = _LIMITS[statement.kind]
    draft.numbers[statement.kind] = _numbers(statement, draft, count, (low, high), whole)


def _numbers(
    statement: Statement, draft: Draft, count: int, limits: tuple[float, float], whole: bool
) -> list[float]:
    """The numbers of a header, checked."""
    scope = Scope(draft.source, statement.line, constants=draft.constants)
    tree = parse(statement.text, "numbers", draft.source, statement.line)
    values = [compile_expression(child, scope) for child in tree.children]
    noun = "a whole number" if whole else "a number" if count == 1 else f"{count} numbers"
    expected = f"{noun} from {limits[0]:g} to {limits[1]:g} after {statement.kind}:"
    given = shown(" ".join(statement.text.split()))
    if len(values) != count:
        raise InputError(draft.source, f"line {statement.line}", given, expected)
    for value in values:
        good = isinstance(value, float) and math.isfinite(value) and limits[0] <= value <= limits[1]
        if not good or (whole and value != int(value)):  # type: ignore[arg-type]
            raise InputError(draft.source, f"line {statement.line}", given, expected)
    return [value for value in values if isinstance(value, float)]


_SECTION_NAMES = {"interpretation": "homomorphism", "productions": "production"}
_READERS: dict[str, Callable[[Statement, Draft], None]] = {
    "axiom": _axiom,
    "rule": _rule,
    "section": _section,
    "lsystem": _lsystem,
    "ignore": _ignore,
    "consider": _ignore,
    "maximum depth": _maximum_depth,
    **dict.fromkeys(("define", "start", "end", "starteach", "endeach", "ring l-system"), _unsupported),
    **dict.fromkeys(("group", "endgroup", "production"), _unsupported),
}
