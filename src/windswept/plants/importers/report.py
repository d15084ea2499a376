"""What became of a foreign file on its way to a plant."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class ImportReport:
    """What an importer took, guessed, bent into range and left behind; every entry is one short line."""

    format: str
    """Which kind of file it was, as "Arbaro XML"."""
    taken: list[str] = field(default_factory=list)
    """Keys of the file that were taken over."""
    taken_rows: int = 0
    """Rows that were taken over, of a file that is a table without keys."""
    defaulted: list[str] = field(default_factory=list)
    """Keys of the species form that the file does not give."""
    clamped: list[str] = field(default_factory=list)
    """Values that were out of range or had to change: "Flare -0.8 -> 0"."""
    without_counterpart: list[str] = field(default_factory=list)
    """Keys of the file that have no meaning here."""
    repaired: list[str] = field(default_factory=list)
    """What was wrong with the file itself and was mended."""

    def lines(self) -> list[str]:
        """The report for people; what is empty is left out."""
        counted = [f"{self.format}: {self._taken()} taken"]
        named = (
            ("clamped", self.clamped),
            ("repaired", self.repaired),
            ("no counterpart", self.without_counterpart),
            ("defaulted", self.defaulted),
        )
        return counted + [f"{title}: {', '.join(entries)}" for title, entries in named if entries]

    def _taken(self) -> str:
        """How many of what were taken over."""
        count, noun = (self.taken_rows, "row") if self.taken_rows else (len(self.taken), "value")
        return f"{count:,} {noun}{'' if count == 1 else 's'}"
