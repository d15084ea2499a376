"""interpret: the homomorphism applied to a derived word, module by module, as the turtle reads it."""

from __future__ import annotations

from collections.abc import Iterator

from windswept.errors import BudgetError
from windswept.plants.lsystem.derive import Rewriter, Word
from windswept.plants.lsystem.system import Params

DEEPEST = 100
"""A homomorphism goes at most this deep, whatever `maximum depth` says."""


def interpret(word: Word, rewriter: Rewriter) -> Iterator[tuple[str, Params]]:
    """Modules for the turtle.

    Without a `maximum depth` no symbol is rewritten again within its own image, so F may stand for a wider F.

    Args:
        word: what was derived.
        rewriter: holds the rules, the random numbers of the interpretation and the budget.

    Raises:
        BudgetError: the image is longer than the module budget.
    """
    rewriting = rewriter.system.homomorphism
    symbols = rewriting.symbols
    limit = DEEPEST if rewriting.depth is None else min(rewriting.depth, DEEPEST)
    count = 0
    for symbol, params in zip(word.symbols, word.params, strict=True):
        if symbol not in symbols:
            yield symbol, params
            continue
        waiting: list[tuple[str, Params, tuple[str, ...]]] = [(symbol, params, ())]
        while waiting:
            inner, values, within = waiting.pop()
            open_to = len(within) < limit and not (rewriting.depth is None and inner in within)
            choice = rewriter.choose(rewriting, inner, values) if inner in symbols and open_to else None
            if choice is None:
                yield inner, values
                continue
            part = Word()
            rewriter.write(choice[0].successor, choice[1], choice[0].line, part)
            count += len(part)
            if count > rewriter.budget:
                raise BudgetError(rewriter.message(f"its homomorphism has {count:,} modules"))
            image = zip(part.symbols[::-1], part.params[::-1], strict=True)
            waiting.extend((s, p, (*within, inner)) for s, p in image)
