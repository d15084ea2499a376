"""Expressions mean what they mean in C, with cpfg's degrees and powers."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from windswept.errors import InputError
from windswept.plants.lsystem.derive import derive
from windswept.plants.lsystem.read_system import read_system


def value(expression, x=0.0):
    """Value of an expression, with x unknown until the rule is applied."""
    text = f"derivation length: 1\nAxiom: A({x!r})\nA(x) --> B({expression})"
    return derive(read_system(text, "test.l"), np.random.default_rng(0)).params[0][0]


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("1 + 2 * 3", 7),
        ("(1 + 2) * 3", 9),
        ("7 / 2", 3.5),
        ("7 % 4", 3),
        ("-7 % 4", -3),
        ("2 ^ 3 ^ 2", 512),
        ("2 ** 3", 8),
        ("-2 ^ 2", -4),
        ("10 - 4 - 3", 3),
        ("1 < 2", 1),
        ("2 <= 1", 0),
        ("3 != 3", 0),
        ("1 = 1", 1),
        ("1 < 2 == 1", 1),
        ("!0 + !5", 1),
        ("2 && 3", 1),
        ("0 || 0.5", 1),
        ("0 & 1 | 1", 1),
        ("1 > 2 ? 10 : 2 > 1 ? 20 : 30", 20),
        ("0 && 1 / 0", 0),
        ("1 || 1 / 0", 1),
        ("1 ? 5 : 1 / 0", 5),
        ("1e3 + .5 + 2.", 1002.5),
        ("sin(30)", 0.5),
        ("cos(60)", 0.5),
        ("tan(45)", 1),
        ("asin(1)", 90),
        ("acos(0)", 90),
        ("atan(1)", 45),
        ("atan2(1, -1)", 135),
        ("sqrt(16) + exp(0) + log(1)", 5),
        ("pow(2, 10)", 1024),
        ("floor(-1.5) + ceil(1.2) + trunc(-1.9)", -1),
        ("fabs(-2) + abs(-3) + sign(-9) + sign(0)", 4),
        ("min(3, 2) + max(3, 2)", 5),
        ('0 * "label"', 0),
    ],
)
def test_values(expression, expected):
    assert value(expression) == pytest.approx(expected, rel=1e-12)
    # the same where nothing can be reckoned beforehand
    unknown = re.sub(r"(?<!\.)\b(\d+)\b(?!\.)", r"(\1 + x)", expression)
    assert value(unknown) == pytest.approx(expected, rel=1e-12)


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6).filter(lambda y: abs(y) > 1e-6))
def test_arithmetic_is_that_of_doubles(x, y):
    assert value(f"x / ({y!r}) + x * ({y!r}) - x", x) == x / y + x * y - x
    assert value(f"x % ({y!r})", x) == math.fmod(x, y)


@pytest.mark.parametrize(
    ("expression", "low", "high", "mean"),
    [("ran(3)", 0, 3, 1.5), ("nran(5, 0.5)", 2, 8, 5), ("bran(2, 2)", 0, 1, 0.5)],
)
def test_random_functions(expression, low, high, mean):
    text = f"derivation length: 1\nAxiom: {'A' * 4000}\nA --> B({expression})"
    drawn = np.array(derive(read_system(text, "test.l"), np.random.default_rng(1)).params)[:, 0]
    assert low <= drawn.min() < drawn.max() <= high
    assert drawn.mean() == pytest.approx(mean, abs=0.06)


@pytest.mark.parametrize(
    ("expression", "reason"),
    [
        ("1 / x", "division by zero"),
        ("x % x", "a power, remainder"),
        ("sqrt(x - 1)", "a power, remainder"),
        ("log(x)", "a power, remainder"),
        ("acos(x + 2)", "a power, remainder"),
        ("exp(x + 1e4)", "a number too large"),
        ("pow(x, -1)", "a power, remainder"),
        ("1 / 0", "division by zero"),
    ],
)
def test_what_has_no_value_says_so_with_its_line(expression, reason):
    with pytest.raises(
        InputError, match=r"test.l: line 3: expected an expression that has a value"
    ) as caught:
        value(expression)
    assert reason in str(caught.value)
