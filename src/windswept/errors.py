"""The one family of errors that a person's input can cause."""

from __future__ import annotations


class WindsweptError(Exception):
    """Something a person can mend: the command line prints it as one line and exits with code 2."""


class InputError(WindsweptError):
    """A value in a file or on the command line is wrong.

    Args:
        source: file or option the value came from.
        place: key path or line inside the source, "" for the whole.
        value: the offending value, as given; ``None`` where there is none to show.
        expected: what would have been right.
    """

    def __init__(self, source: str, place: str, value: object, expected: str) -> None:
        self.source, self.place, self.value, self.expected = source, place, value, expected
        where = f"{source}: {place}" if place else source
        got = "" if value is None else f" = {value!r}"
        super().__init__(f"{where}{got}: expected {expected}")


class BudgetError(WindsweptError):
    """A plant would hold more links or leaves than the stated budget."""


class GraphicsError(WindsweptError):
    """No usable graphics adapter, or the adapter failed; the message names the one line that mends it."""
