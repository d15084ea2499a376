"""The command line as a person uses it, for tests: a line, and a small scene to call it with."""

from __future__ import annotations

from pathlib import Path

from windswept.cli import main

SMALL = """
seed = 1
[[plant]]
source = "hazel"
position = [0.0, 0.0]
[camera]
eye = [0.0, -{away}, 2.0]
target = [0.0, 0.0, 2.0]
[time]
duration_s = 0.2
fps = 10.0
"""


def run(*arguments: object) -> int:
    """Exit code of a command line."""
    try:
        main([str(a) for a in arguments])
    except SystemExit as end:
        return int(end.code or 0)
    return 0


def write_scene(folder: Path, away: float = 14.0) -> Path:
    """A scene file of two pictures of a hazel, so far away, m."""
    path = folder / "small.toml"
    path.write_text(SMALL.format(away=away))
    return path
