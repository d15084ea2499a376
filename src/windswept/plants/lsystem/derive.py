"""derive: rewrite the axiom of a system, all modules at once, step by step."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from numpy.random import Generator

from windswept.errors import BudgetError, InputError
from windswept.plants.lsystem.context import Neighbours
from windswept.plants.lsystem.expression import Values
from windswept.plants.lsystem.system import Params, Piece, Rewriting, Rule, System

MODULE_BUDGET = 2_000_000
"""Most modules of a string."""
COPY_WORK = 0.1
"""Work of copying a module over that of looking for its rule. The work of all steps keeps to the module budget
too, or long derivations of long strings would take hours."""
DECOMPOSITION_DEPTH = 1000
"""How often a module is taken apart in a row where the grammar states no `maximum depth`."""

Choice = tuple[Rule, Values]


@dataclass(slots=True)
class Word:
    """A string of modules."""

    symbols: list[str] = field(default_factory=list)
    params: list[Params] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.symbols)

    def add(self, symbol: str, params: Params) -> None:
        """Put a module at the end."""
        self.symbols.append(symbol)
        self.params.append(params)

    def __str__(self) -> str:
        """The string as it is written in a grammar."""
        return "".join(
            symbol + (f"({','.join(f'{value:g}' for value in values)})" if values else "")
            for symbol, values in zip(self.symbols, self.params, strict=True)
        )


def derive(system: System, dice: Generator, module_budget: int = MODULE_BUDGET) -> Word:
    """The string after `derivation length` steps.

    Args:
        system: its rules.
        dice: random numbers of the derivation.
        module_budget: most modules that a string may have.

    Raises:
        InputError: an expression of a rule has no value, with its line.
        BudgetError: the string outgrew the budget; says at which step.
    """
    rewriter = Rewriter(system, dice, module_budget)
    word = Word()
    rewriter.write(system.axiom, [], system.axiom_line, word)
    word = rewriter.decompose(word)
    for step in range(1, system.steps + 1):
        rewriter.step = step
        word = cut(rewriter.decompose(rewriter.produce(word)))
    return word


class Rewriter:
    """Applies the rules of one system.

    Args:
        system: what to apply.
        dice: random numbers.
        module_budget: most modules that a string may have.
    """

    def __init__(self, system: System, dice: Generator, module_budget: int) -> None:
        self.system, self.dice, self.budget = system, dice, module_budget
        self.step = 0
        """Step that is being taken, for error messages."""
        self._work = 0.0

    def produce(self, word: Word) -> Word:
        """One step: every module replaced by the successor of its rule, all at once."""
        rewriting, result = self.system.production, Word()
        neighbours = self._neighbours(word) if rewriting.has_context else None
        changing = rewriting.symbols
        for place, (symbol, params) in enumerate(zip(word.symbols, word.params, strict=True)):
            changes = symbol in changing
            choice = self.choose(rewriting, symbol, params, place, neighbours) if changes else None
            if choice is None:
                result.add(symbol, params)
                continue
            self.write(choice[0].successor, choice[1], choice[0].line, result)
            if len(result) > self.budget:
                raise self._too_long(len(result))
        copied = sum(symbol not in changing for symbol in word.symbols)
        self._spend(len(word) - copied + COPY_WORK * copied)
        return result

    def decompose(self, word: Word) -> Word:
        """Every module taken apart as long as a rule of the decomposition applies."""
        rewriting = self.system.decomposition
        symbols = rewriting.symbols
        if symbols.isdisjoint(word.symbols):
            return word
        result = Word()
        for symbol, params in zip(word.symbols, word.params, strict=True):
            if symbol in symbols:
                self._take_apart(rewriting, symbol, params, result)
            else:
                result.add(symbol, params)
        return result

    def _take_apart(self, rewriting: Rewriting, symbol: str, params: Params, result: Word) -> None:
        """Put the last parts of one module at the end of a word."""
        limit = rewriting.depth or DECOMPOSITION_DEPTH
        waiting = [(symbol, params, 0)]
        while waiting:
            symbol, params, depth = waiting.pop()
            choice = self.choose(rewriting, symbol, params) if depth < limit else None
            if choice is None:
                if rewriting.depth is None and depth == DECOMPOSITION_DEPTH:
                    raise BudgetError(self.message(f"decomposition goes deeper than {depth:,}"))
                result.add(symbol, params)
                continue
            part = Word()
            self.write(choice[0].successor, choice[1], choice[0].line, part)
            self._spend(len(part))
            parts = zip(part.symbols[::-1], part.params[::-1], strict=True)
            waiting.extend((s, p, depth + 1) for s, p in parts)
            if len(result) + len(waiting) > self.budget:
                raise self._too_long(len(result) + len(waiting))

    def choose(
        self,
        rewriting: Rewriting,
        symbol: str,
        params: Params,
        place: int = 0,
        neighbours: Neighbours | None = None,
    ) -> Choice | None:
        """The rule that applies to a module, with the values its successor is written with.

        The first that matches, or where that has a weight, one of all matching ones that have, at random.
        """
        rivals: list[tuple[float, Choice]] = []
        for rule in rewriting.rules.get((symbol, len(params)), ()):
            values = self._matched(rule, params, place, neighbours)
            if values is None or (rivals and rule.weight is None):
                continue
            if rule.weight is None:
                return self._finished(rule, values)
            rivals.append((self._weight(rule, values), (rule, values)))
        if not rivals:
            return None
        draw = self.dice.random() * sum(weight for weight, _ in rivals)
        for weight, choice in rivals:
            draw -= weight
            if draw < 0:
                return self._finished(*choice)
        return None

    def write(self, successor: tuple[Piece, ...], values: Values, line: int, result: Word) -> None:
        """Put the modules of a successor at the end of a word."""
        dice = self.dice
        try:
            for piece in successor:
                params = piece.constant
                if params is None:
                    params = tuple([argument(values, dice) for argument in piece.arguments])
                result.symbols.append(piece.symbol)
                result.params.append(params)
        except (ArithmeticError, ValueError, RecursionError) as error:
            raise self._no_value(line, error) from None

    def _matched(
        self, rule: Rule, params: Params, place: int, neighbours: Neighbours | None
    ) -> Values | None:
        """Values of a rule's parameters and locals where it matches and its condition holds."""
        values: Values = list(params)
        if neighbours is not None and (rule.left or rule.right):
            left = neighbours.left(place, rule.left)
            right = neighbours.right(place, rule.right) if left is not None else None
            if left is None or right is None:
                return None
            values = [*left, *params, *right]
        values.extend([0.0] * rule.local_count)
        try:
            if rule.before is not None:
                rule.before(values, self.dice)
            holds = rule.condition is None or rule.condition(values, self.dice)
        except (ArithmeticError, ValueError, RecursionError) as error:
            raise self._no_value(rule.line, error) from None
        return values if holds else None

    def _finished(self, rule: Rule, values: Values) -> Choice:
        """The choice after the rule's second block."""
        try:
            if rule.after is not None:
                rule.after(values, self.dice)
        except (ArithmeticError, ValueError, RecursionError) as error:
            raise self._no_value(rule.line, error) from None
        return rule, values

    def _weight(self, rule: Rule, values: Values) -> float:
        assert rule.weight is not None
        try:
            weight = rule.weight(values, self.dice)
        except (ArithmeticError, ValueError, RecursionError) as error:
            raise self._no_value(rule.line, error) from None
        if not 0.0 <= weight < math.inf:
            raise InputError(self.system.source, f"line {rule.line}", weight, "a probability of 0 or more")
        return weight

    def _neighbours(self, word: Word) -> Neighbours:
        ignored, considered = self.system.ignored, self.system.considered
        if considered is not None:
            return Neighbours(word.symbols, word.params, considered.__contains__)
        return Neighbours(word.symbols, word.params, lambda symbol: symbol not in ignored)

    def _spend(self, work: float) -> None:
        """Keep to the budget of work."""
        self._work += work
        if self._work > self.budget:
            raise BudgetError(self.message(f"{self._work:,.0f} modules rewritten in all"))

    def _too_long(self, count: int) -> BudgetError:
        return BudgetError(self.message(f"{count:,} modules"))

    def message(self, what: str) -> str:
        """One line that says where the derivation stood."""
        where = f"step {self.step} of {self.system.steps}"
        advice = "lower derivation length or raise the budget"
        return f"{self.system.source}: {where}: {what}, budget {self.budget:,} modules: {advice}"

    def _no_value(self, line: int, error: Exception) -> InputError:
        reasons = {RecursionError: "too long an expression", OverflowError: "a number too large"}
        said = "a power, remainder, root, logarithm or arc that there is not"
        reason = reasons.get(
            type(error), "division by zero" if isinstance(error, ZeroDivisionError) else said
        )
        return InputError(
            self.system.source, f"line {line}", None, f"an expression that has a value ({reason})"
        )


def cut(word: Word) -> Word:
    """The word without what `%` cuts off: the rest of its branch (The Algorithmic Beauty of Plants, p. 73)."""
    if "%" not in word.symbols:
        return word
    result = Word()
    lost = 0
    cutting = False
    for symbol, params in zip(word.symbols, word.params, strict=True):
        if cutting:
            lost += (symbol == "[") - (symbol == "]")
            if lost >= 0:
                continue
            cutting, lost = False, 0
        if symbol == "%":
            cutting = True
            continue
        result.add(symbol, params)
    return result
