"""Progress on stderr: a bar or a line that changes for people, plain lines for files; nothing on stdout."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import click
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

LINES_APART = 10.0
"""Least time between two plain lines on what goes on, s."""
COMPILING = "compiling kernels for this machine, once"


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """A bar that the yielded function moves: done, total."""
    console = Console(stderr=True)
    if not console.is_terminal:
        with _plain_lines() as say:
            say(what)
            yield lambda done, total: say(f"{what}: {done} of {total}")
        return
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(what, total=None)
        with _told_of_compiling(
            lambda now: bar.update(task, description=f"{what}, {COMPILING}" if now else what)
        ):
            yield lambda done, total: bar.update(task, completed=done, total=total)


@contextmanager
def status_line(what: str) -> Iterator[Callable[[str], None]]:
    """A line that the yielded function rewrites; in a file it begins with what that function is told."""
    console = Console(stderr=True)
    if not console.is_terminal:
        with _plain_lines() as say:
            yield say
        return
    shown = what

    def rewrite(line: str) -> None:
        nonlocal shown
        shown = line
        status.update(line)

    with (
        console.status(what) as status,
        _told_of_compiling(lambda now: status.update(f"{shown}, {COMPILING}" if now else shown)),
    ):
        yield rewrite


@contextmanager
def _plain_lines() -> Iterator[Callable[[str], None]]:
    """Writes the first line that the yielded function is given, and others so seldom that a log stays short."""
    last = -LINES_APART

    def say(line: str) -> None:
        nonlocal last
        now = time.monotonic()
        if now - last >= LINES_APART:
            last = now
            click.echo(line, err=True)

    told = False

    def compiling(now: bool) -> None:
        nonlocal told
        if now and not told:
            told = True
            click.echo(COMPILING, err=True)

    with _told_of_compiling(compiling):
        yield say


@contextmanager
def _told_of_compiling(tell: Callable[[bool], None]) -> Iterator[None]:
    """Tells when Numba begins to compile a kernel, which it does where its cache has none yet, and when it ends."""
    from numba.core import event

    class Listener(event.Listener):
        depth = 0

        def on_start(self, _event: Any) -> None:
            self.depth += 1
            if self.depth == 1:
                tell(True)

        def on_end(self, _event: Any) -> None:
            self.depth -= 1
            if self.depth == 0:
                tell(False)

    listener = Listener()
    event.register("numba:compile", listener)
    try:
        yield
    finally:
        event.unregister("numba:compile", listener)
