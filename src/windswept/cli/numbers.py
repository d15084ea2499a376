"""Numbers on the command line."""

from __future__ import annotations

import math
from typing import Any

import click


class FiniteRange(click.FloatRange):
    """A finite number in a range; click's own range lets nan through, since nan is below and above nothing."""

    name = "number"

    def convert(self, value: Any, parameter: click.Parameter | None, context: click.Context | None) -> float:
        """The number, or a line that says what is wrong with it."""
        number: float = super().convert(value, parameter, context)
        if not math.isfinite(number):
            self.fail(f"{value} is not a finite number.", parameter, context)
        return number


class WholeRange(click.IntRange):
    """A whole number in a range, called by that name where it is none."""

    name = "whole number"

    def get_metavar(self, param: click.Parameter, ctx: click.Context) -> str | None:
        """What help shows for it."""
        return "INTEGER"


SEED = WholeRange(0, 2**31 - 1)
"""What scene files take as well."""
