"""Neighbours of modules in a bracketed string (The Algorithmic Beauty of Plants, p. 30-32)."""

from __future__ import annotations

from collections.abc import Callable

from windswept.plants.lsystem.system import Params, Pattern

Sees = Callable[[str], bool]


class Neighbours:
    """Where every module of one string has its neighbours.

    The left neighbour is the nearest module towards the root: whole side branches are passed over, and the
    start of a branch leads to what carries it. The right neighbour is the next on the same axis.

    Args:
        symbols: the string.
        params: parameters of its modules.
        sees: whether contexts see a symbol.
    """

    def __init__(self, symbols: list[str], params: list[Params], sees: Sees) -> None:
        self._symbols, self._params, self._sees = symbols, params, sees
        count = len(symbols)
        self._left = [-1] * count
        self._right = [count] * count
        self._closing = [count] * count
        self._look_left()
        self._look_right()

    def _look_left(self) -> None:
        """Nearest seen module towards the root, and the end of every branch."""
        carriers: list[int] = []
        openings: list[int] = []
        last = -1
        for i, symbol in enumerate(self._symbols):
            self._left[i] = last
            if symbol == "[":
                carriers.append(last)
                openings.append(i)
            elif symbol == "]" and openings:
                last = carriers.pop()
                self._closing[openings.pop()] = i
            elif self._sees(symbol):
                last = i

    def _look_right(self) -> None:
        """Next seen module on the same axis; the number of modules where there is none."""
        count = len(self._symbols)
        after: list[int] = []
        following = count
        for i in range(count - 1, -1, -1):
            symbol = self._symbols[i]
            self._right[i] = following
            if symbol == "]":
                after.append(following)
                following = count
            elif symbol == "[":
                following = after.pop() if after else count
            elif self._sees(symbol):
                following = i

    def left(self, place: int, pattern: Pattern) -> list[float] | None:
        """Parameters of the modules to the left that match a pattern, root first; None where they do not."""
        found: list[Params] = []
        for symbol, arity in reversed(pattern):
            place = self._left[place]
            if place < 0 or self._symbols[place] != symbol or len(self._params[place]) != arity:
                return None
            found.append(self._params[place])
        return [value for values in reversed(found) for value in values]

    def right(self, place: int, pattern: Pattern) -> list[float] | None:
        """Parameters of the modules to the right that match a pattern; None where they do not."""
        found: list[float] = []
        end = self._match_right(place, pattern, 0, len(pattern), found)
        return None if end is None else found

    def _match_right(
        self, place: int, pattern: Pattern, start: int, stop: int, found: list[float]
    ) -> int | None:
        """Last place matched by ``pattern[start:stop]`` after a place, or None."""
        i = start
        while i < stop:
            symbol, arity = pattern[i]
            if symbol == "[":
                inner = _matching(pattern, i)
                closed = self._match_branch(place, pattern, i + 1, inner, found)
                if closed is None:
                    return None
                place, i = closed, inner + 1
                continue
            place = self._right[place]
            if place >= len(self._symbols) or self._symbols[place] != symbol:
                return None
            if len(self._params[place]) != arity:
                return None
            found.extend(self._params[place])
            i += 1
        return place

    def _match_branch(
        self, place: int, pattern: Pattern, start: int, stop: int, found: list[float]
    ) -> int | None:
        """End of the first branch after a place that begins as ``pattern[start:stop]``, or None."""
        count = len(self._symbols)
        i = place + 1
        while i < count:
            if self._symbols[i] == "[":
                inside: list[float] = []
                if self._match_right(i, pattern, start, stop, inside) is not None:
                    found.extend(inside)
                    return self._closing[i]
                i = self._closing[i]
            elif self._symbols[i] == "]" or self._sees(self._symbols[i]):
                return None
            i += 1
        return None


def _matching(pattern: Pattern, opening: int) -> int:
    """Index of the ] that closes a [ of a pattern."""
    depth = 0
    for i in range(opening, len(pattern)):
        depth += (pattern[i][0] == "[") - (pattern[i][0] == "]")
        if depth == 0:
            return i
    raise AssertionError("patterns are balanced")
