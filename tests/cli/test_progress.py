"""What stderr says on the way: few plain lines in a file, and a word on compiling only where something is compiled."""

from __future__ import annotations

import pytest
from numba import njit

from windswept.cli import progress


def compile_something() -> None:
    njit(lambda x: x + 1)(1)


def test_a_file_gets_the_first_line_and_seldom_more(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with progress.progress_bar("drawing a.mp4") as bar:
        for done in range(1, 101):
            bar(done, 100)
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "drawing a.mp4\n")
    monkeypatch.setattr(progress, "LINES_APART", 0.0)
    with progress.progress_bar("drawing a.mp4") as bar:
        bar(50, 100)
    assert capsys.readouterr().err == "drawing a.mp4\ndrawing a.mp4: 50 of 100\n"


def test_a_status_begins_with_what_it_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    with progress.status_line("growing plants") as say:
        say("growing hazel, seed 0")
        say("growing hazel, seed 1")
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "growing hazel, seed 0\n")


def test_compiling_is_said_once_and_only_where_it_happens(capsys: pytest.CaptureFixture[str]) -> None:
    with progress.status_line("growing plants"):
        compile_something()
        compile_something()
    assert capsys.readouterr().err == f"{progress.COMPILING}\n"
    compile_something()
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("kind", [progress.progress_bar, progress.status_line])
def test_a_terminal_shows_it_while_it_lasts(
    kind: object, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("COLUMNS", "200")
    with kind("at work"):  # type: ignore[operator]
        compile_something()
    assert "at work" in capsys.readouterr().err
