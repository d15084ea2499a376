"""What an L-system is: a string of modules, rules that rewrite it, and how the turtle is to read it."""

from __future__ import annotations

from dataclasses import dataclass, field

from windswept.plants.lsystem.expression import Block, Expression

Params = tuple[float, ...]
Pattern = tuple[tuple[str, int], ...]
"""Symbols and numbers of parameters to match."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A module that a rule writes."""

    symbol: str
    constant: Params | None
    """Its parameters where they are numbers."""
    arguments: tuple[Expression, ...] = ()
    """Else closures that give them."""


@dataclass(frozen=True, slots=True)
class Rule:
    """left < symbol(arity) > right : {before} condition {after} --> successor : weight."""

    line: int
    symbol: str
    arity: int
    left: Pattern
    right: Pattern
    """With brackets as symbols of no parameter."""
    before: Block | None
    condition: Expression | None
    after: Block | None
    weight: Expression | None
    successor: tuple[Piece, ...]
    local_count: int


@dataclass(frozen=True, slots=True)
class Rewriting:
    """Rules that belong together, by symbol and number of parameters, in the order written."""

    rules: dict[tuple[str, int], tuple[Rule, ...]] = field(default_factory=dict)
    depth: int | None = None
    """`maximum depth`; only of a decomposition or a homomorphism."""

    @property
    def symbols(self) -> frozenset[str]:
        """Symbols that have a rule, with whatever number of parameters."""
        return frozenset(symbol for symbol, _ in self.rules)

    @property
    def has_context(self) -> bool:
        """Whether any rule looks at its neighbours."""
        return any(rule.left or rule.right for family in self.rules.values() for rule in family)


@dataclass(frozen=True, slots=True)
class Reading:
    """How the turtle reads the string."""

    angle: float
    """Turn of a rotation without a parameter, degrees."""
    tropism: tuple[float, float, float] = (0.0, 0.0, -1.0)
    """Where stems bend to and, by its length, how strongly; frame +Z up."""
    elasticity: float = 0.0
    """The e of The Algorithmic Beauty of Plants, p. 58, until the grammar sets another."""
    width_is_radius: bool = False
    """L-Py's widths are radii, cpfg's are diameters."""


@dataclass(frozen=True, slots=True)
class System:
    """One L-system."""

    source: str
    """File it was read from."""
    seed: int
    """`Seed:` of the file; the seed of the plant is added to it."""
    steps: int
    axiom: tuple[Piece, ...]
    axiom_line: int
    production: Rewriting
    decomposition: Rewriting
    homomorphism: Rewriting
    ignored: frozenset[str]
    """Symbols that contexts do not see."""
    considered: frozenset[str] | None
    """If not None, the only ones that they see."""
    reading: Reading
