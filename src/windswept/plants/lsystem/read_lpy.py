"""read_lpy: from the declarative part of an L-Py file to a System.

L-Py rules may hold any Python. What is read here is what means the same without it: `Axiom:`, `derivation length:`,
rules `pred --> succ`, sections, `module` declarations, and names that stand for numbers. Anything else is refused;
nothing is ever executed.
"""

from __future__ import annotations

import re

from windswept.errors import InputError
from windswept.forms.words import one_line, shown
from windswept.plants.lsystem.expression import Scope, compile_expression
from windswept.plants.lsystem.macros import LONGEST_LINE, Line
from windswept.plants.lsystem.notation import parse
from windswept.plants.lsystem.read_system import Draft, build_system
from windswept.plants.lsystem.statements import split_statements
from windswept.plants.lsystem.system import Reading, System

LPY_ANGLE = 60.0
"""L-Py's turn of a rotation without a parameter, degrees."""

_TRAILER = re.compile(r"^#+ INITIALISATION #+\s*$.*", re.M | re.S)
"""What L-Py's editor saves after the system: its own settings as Python, which are not read."""
_CONSTANT = re.compile(r"([A-Za-z_]\w*)\s*=\s*([^=].*)$")
_MODULE = re.compile(r"\s*module\s+([^:]+?)\s*(?::.*)?$")
_PYTHON = re.compile(
    r"\s*(def|class|import|from|for|while|if|elif|else|try|except|finally|with|return|yield|lambda|print|global"
    r"|raise|assert|del|pass|produce|nproduce|nsproduce|makestring|context|exec|eval|extern|async|match)\b"
    r"|\s*@"
)
"""Lines that are Python."""
_LONGEST_NAMES = 200
"""Most long module names that a file may declare."""
_FIRST_PRIVATE = 0xE000


def read_lpy(text: str, source: str) -> System:
    """An L-system in the declarative subset of L-Py.

    Args:
        text: the whole file.
        source: its name, for error messages.

    Raises:
        InputError: with the line; also for Python code.
    """
    if not text.strip():
        raise InputError(source, "", None, "an L-system; the file is empty")
    draft = Draft(source, reading=Reading(LPY_ANGLE, width_is_radius=True))
    symbols: dict[str, str] = {}
    lines: list[Line] = []
    for number, raw in enumerate(_TRAILER.sub("", text).split("\n"), 1):
        line = _without_comment(raw)
        if not line.strip():
            continue
        if len(line) > LONGEST_LINE:
            raise InputError(source, f"line {number}", None, f"lines of at most {LONGEST_LINE:,} characters")
        if not _declared(line, number, draft, symbols):
            lines.append(Line(number, _with_short_names(line, symbols)))
    for line_ in lines:
        _refuse_python(line_, source)
    try:
        return build_system(split_statements(lines), draft)
    except InputError as error:
        raise InputError(
            source, error.place, error.value, _with_long_names(error.expected, symbols)
        ) from None


def _without_comment(line: str) -> str:
    """The line up to a #: L-Py has no module of that name."""
    return line.split("#", 1)[0]


def _declared(line: str, number: int, draft: Draft, symbols: dict[str, str]) -> bool:
    """Note the constant or the module names that a line declares."""
    constant = _CONSTANT.match(line)
    if constant:
        draft.constants[constant[1]] = _number(constant[2], number, draft)
        return True
    module = _MODULE.match(line)
    if not module:
        return False
    for part in re.sub(r"\([^)]*\)", " ", module[1]).replace(",", " ").split():
        if not re.fullmatch(r"[A-Za-z_]\w*", part) or len(symbols) >= _LONGEST_NAMES:
            raise InputError(draft.source, f"line {number}", None, "names of modules after module")
        if len(part) > 1:
            symbols.setdefault(part, chr(_FIRST_PRIVATE + len(symbols)))
    return True


def _number(text: str, number: int, draft: Draft) -> float:
    """Value of a constant."""
    expected = "a number; Python is not run"
    try:
        tree = parse(text, "numbers", draft.source, number)
        scope = Scope(draft.source, number, constants=draft.constants)
        value = compile_expression(tree.children[0], scope) if len(tree.children) == 1 else None
    except (InputError, RecursionError):
        value = None
    if not isinstance(value, float):
        raise InputError(draft.source, f"line {number}", shown(one_line(text)), expected)
    return value


def _with_short_names(line: str, symbols: dict[str, str]) -> str:
    """The line with every long module name outside parentheses as one private-use character, and _ as #."""
    names = "|".join(sorted(map(re.escape, symbols), key=len, reverse=True))
    pattern = re.compile(rf"({names})|(_)" if names else r"()(_)")
    parts = re.split(r"([()])", line)
    depth = 0
    for i, part in enumerate(parts):
        depth += (part == "(") - (part == ")")
        if depth == 0 and part != ")":
            parts[i] = pattern.sub(lambda found: symbols.get(found[0], "#"), part)
    return "".join(parts)


def _with_long_names(message: str, symbols: dict[str, str]) -> str:
    """A message with the names that the file declares in place of what stands for them."""
    for name, symbol in symbols.items():
        message = message.replace(symbol, name).replace(repr(symbol)[1:-1], name)
    return message


def _refuse_python(line: Line, source: str) -> None:
    """Raise InputError where a line can only be Python."""
    text = line.text.rstrip()
    is_python = "-->" not in text and (_PYTHON.match(text) or re.search(r"\)\s*:$", text))
    if is_python or re.search(r"\bproduce\b", text):
        expected = "a rule pred --> succ, a header or NAME = number; Python code is not run"
        raise InputError(source, f"line {line.number}", shown(one_line(text)), expected)
