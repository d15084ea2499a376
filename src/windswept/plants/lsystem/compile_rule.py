"""From the syntax tree of a rule or a string of modules to what derivation runs."""

from __future__ import annotations

from lark import Token

from windswept.errors import InputError
from windswept.plants.lsystem.expression import (
    Block,
    Expression,
    Scope,
    compile_block,
    compile_expression,
    running,
)
from windswept.plants.lsystem.notation import Node, parse
from windswept.plants.lsystem.statements import Statement
from windswept.plants.lsystem.system import Pattern, Piece, Rule

EMPTY_CONTEXT = "*"


def compile_rule(statement: Statement, source: str, constants: dict[str, float]) -> Rule:
    """A rule.

    Args:
        statement: its text.
        source: the file, for error messages.
        constants: names that stand for numbers.

    Raises:
        InputError: with the line.
    """
    try:
        return _compiled(statement, source, constants)
    except RecursionError:
        raise InputError(source, f"line {statement.line}", None, "a shorter expression") from None


def _compiled(statement: Statement, source: str, constants: dict[str, float]) -> Rule:
    node = parse(statement.text, "rule", source, statement.line)
    head, guard, _, weight_left, word, weight_right = node.children
    scope = Scope(source, statement.line, constants=constants)
    left, strict, right = _head(head, scope)
    if len(strict) != 1:
        raise scope.error(head, "one module to be rewritten; its neighbours go before < and after >")
    formal_count = len(scope.slots)
    before, condition, after = _guard(guard, scope)
    weights = [item for item in (weight_left, weight_right) if item is not None]
    weight = _weight(weights[0], scope) if weights else None
    return Rule(
        line=statement.line,
        symbol=strict[0][0],
        arity=strict[0][1],
        left=left,
        right=right,
        before=before,
        condition=condition,
        after=after,
        weight=weight,
        successor=_pieces(word, scope),
        local_count=len(scope.slots) - formal_count,
    )


def compile_word(text: str, source: str, line: int, constants: dict[str, float]) -> tuple[Piece, ...]:
    """A string of modules.

    Raises:
        InputError: with the line.
    """
    try:
        return _pieces(parse(text, "word", source, line), Scope(source, line, constants=constants))
    except RecursionError:
        raise InputError(source, f"line {line}", None, "a shorter expression") from None


def _head(head: Node, scope: Scope) -> tuple[Pattern, Pattern, Pattern]:
    """Left context, strict predecessor, right context; their parameters get slots in this order."""
    groups = [child for child in head.children if not isinstance(child, Token)]
    patterns = [_pattern(group, scope) for group in groups]
    if head.data == "bare_head":
        return (), patterns[0], ()
    if head.data == "left_head":
        return patterns[0], patterns[1], ()
    if head.data == "right_head":
        return (), patterns[0], patterns[1]
    return patterns[0], patterns[1], patterns[2]


def _pattern(group: Node, scope: Scope) -> Pattern:
    """Symbols and numbers of parameters; a lone * is no context at all."""
    pattern = []
    for formal in group.children:
        symbol, *names = (str(child) for child in formal.children if child is not None)
        for name in names:
            if name in scope.slots:
                raise scope.error(formal, f"parameters of different names, not {name[:40]} twice")
            scope.slots[name] = len(scope.slots)
        pattern.append((symbol, len(names)))
    if [symbol for symbol, _ in pattern] == [EMPTY_CONTEXT]:
        return ()
    _check_balance([symbol for symbol, _ in pattern], group, scope)
    return tuple(pattern)


def _guard(guard: Node | None, scope: Scope) -> tuple[Block | None, Expression | None, Block | None]:
    """Block before, condition, block after."""
    if guard is None:
        return None, None, None
    if guard.data == "block_guard":
        return compile_block(guard.children[0], scope), None, None
    before, test, after = guard.children
    first = None if before is None else compile_block(before, scope)
    condition = None if test.data == "always" else running(compile_expression(test.children[0], scope))
    return first, condition, None if after is None else compile_block(after, scope)


def _weight(node: Node, scope: Scope) -> Expression:
    """How probable a rule is beside its rivals."""
    if node.data != "weight":
        return running(compile_expression(node, scope))
    inner = node.children[0]
    return running(float(inner) if isinstance(inner, Token) else compile_expression(inner, scope))


def _pieces(word: Node, scope: Scope) -> tuple[Piece, ...]:
    """The modules of a word."""
    _check_balance([str(module.children[0]) for module in word.children], word, scope)
    return tuple(_piece(module, scope) for module in word.children)


def _piece(module: Node, scope: Scope) -> Piece:
    codes = [compile_expression(child, scope) for child in module.children[1:] if child is not None]
    numbers = [code for code in codes if isinstance(code, float)]
    symbol = str(module.children[0])
    if len(numbers) == len(codes):
        return Piece(symbol, tuple(numbers))
    return Piece(symbol, None, tuple(running(code) for code in codes))


def _check_balance(symbols: list[str], node: Node, scope: Scope) -> None:
    """Every [ has its ], and every { its }; the two need not nest (The Algorithmic Beauty of Plants, fig. 5.5)."""
    for opening, closing in ("[]", "{}"):
        depth = 0
        for symbol in symbols:
            depth += (symbol == opening) - (symbol == closing)
            if depth < 0:
                raise scope.error(node, f"an opening {opening} before every {closing}")
        if depth:
            raise scope.error(node, f"a closing {closing} for every {opening}")
