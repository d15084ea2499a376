"""Take a grammar apart into statements: headers such as `Axiom: ...`, section names, rules."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from windswept.plants.lsystem.macros import Line

HEADERS = (
    *("axiom", "lsystem", "derivation length", "seed", "ignore", "consider", "maximum depth"),
    *("angle factor", "angle increment", "tropism direction", "elasticity"),
    *("define", "start", "end", "starteach", "endeach", "ring l-system", "production", "group", "endgroup"),
)
SECTIONS = ("homomorphism", "decomposition", "interpretation", "production", "productions")

_HEADER = re.compile(rf"\s*({'|'.join(HEADERS)})\s*:(.*)$", re.I | re.S)
_SECTION = re.compile(rf"\s*({'|'.join(SECTIONS)})\s*:?\s*$", re.I)
_END = re.compile(r"\s*endlsystem\b", re.I)
_FLAG = re.compile(r"\s*(?:no\s+)?warnings\s*$", re.I)


@dataclass(slots=True)
class Statement:
    """A header, the name of a section, or a rule."""

    kind: str
    """Name of the header, "section", or "rule"."""
    line: int
    text: str
    depth: int = 0
    """Parentheses and braces that are still open."""

    def add(self, text: str) -> None:
        """Go on with the next line."""
        self.text += "\n" + text
        self.depth += _opened(text)


def split_statements(lines: Sequence[Line]) -> list[Statement]:
    """Statements of the lines up to `endlsystem`.

    A rule or an axiom goes on over the next lines as long as they hold no arrow of their own, are no header
    and do not begin the head of a rule whose arrow is further down.
    """
    statements: list[Statement] = []
    for i, line in enumerate(lines):
        if _END.match(line.text):
            break
        started = _started(line)
        following = lines[i + 1].text if i + 1 < len(lines) else ""
        if started is not None:
            statements.append(started)
        elif statements and _goes_on(statements[-1], line.text, following):
            statements[-1].add(line.text)
        elif not _FLAG.match(line.text):
            statements.append(Statement("rule", line.number, line.text, _opened(line.text)))
    return statements


def _started(line: Line) -> Statement | None:
    """The header or section that begins on a line."""
    section = _SECTION.match(line.text)
    if section:
        return Statement("section", line.number, section[1].lower())
    header = _HEADER.match(line.text)
    if header and "-->" not in line.text:
        return Statement(header[1].lower(), line.number, header[2], _opened(header[2]))
    return None


def _goes_on(statement: Statement, text: str, following: str) -> bool:
    """Whether a line belongs to the statement before it."""
    if statement.kind not in ("rule", "axiom"):
        return False
    if statement.kind == "rule" and (statement.depth > 0 or "-->" not in statement.text):
        return True
    begins_head = _opened(text) > 0 and ":" in text
    return "-->" not in text and not begins_head and not following.lstrip().startswith("-->")


def _opened(text: str) -> int:
    """Parentheses and braces opened less those closed."""
    return text.count("(") + text.count("{") - text.count(")") - text.count("}")
