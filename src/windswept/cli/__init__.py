"""The command line: one file a command, loaded only when it is called."""

from __future__ import annotations

import errno
import importlib
import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, NoReturn

import click

from windswept.errors import WindsweptError

COMMANDS = {
    "demo": "grow a forest edge, blow a gust through it, write a video and a picture",
    "species": "list the built-in species",
    "grow": "grow one plant and report its figures",
    "levels": "build a plant's simulation levels and measure their errors",
    "reproduce": "make a founding paper's table beside ours",
    "view": "live window: orbit, wind sliders, pause",
    "render": "draw a scene to a picture or a video, without a screen",
    "bench": "measure speed on this machine",
    "doctor": "say what works on this machine, and how to mend what does not",
}
"""Name and one line of every command, in the order in which help lists them."""
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""Errors of a stdout that takes no more."""


class _LazyGroup(click.Group):
    """Imports a command's module when the command is named, so that ``--help`` is quick."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        command: click.Command = importlib.import_module(f"windswept.cli.{cmd_name}").command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(
    cls=_LazyGroup, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]}
)
@click.version_option(package_name="windswept")
@click.pass_context
def cli(context: click.Context) -> None:
    """Plants that move in the wind as real ones do.

    Example: windswept render examples/forest_edge.toml -o edge.mp4
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


def main(arguments: list[str] | None = None) -> Any:
    """Runs the command line; a person's mistake ends as one line on stderr and exit code 2.

    Numba's own choice of threads, OpenMP, waits for milliseconds at the end of every kernel while another program
    holds a core. The command line calls kernels from one thread only, which is all that the simpler layer asks for.
    The threads of NumPy's and SciPy's linear algebra wait in the same way, while a plant's modes are sought.
    """
    os.environ.setdefault("NUMBA_THREADING_LAYER", "workqueue")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        with _stopped_by_sigterm():
            return cli.main(arguments, standalone_mode=False)
    except (WindsweptError, click.ClickException) as error:
        _end(2, error.format_message() if isinstance(error, click.ClickException) else str(error))
    except ModuleNotFoundError as error:
        package = (error.name or "").split(".")[0]
        if package in ("", "windswept"):
            raise
        _end(2, f"this needs the package {package}, which is not installed: pip install {package}")
    except OSError as error:
        if error.filename is not None or error.errno not in FULL:
            raise
        _let_go_of_stdout()
        _end(2, f"the output cannot be written ({error.strerror})")
    except (KeyboardInterrupt, click.Abort):
        _end(130, "stopped")


def _end(code: int, message: str) -> NoReturn:
    """Ends with one line on stderr."""
    click.echo(f"windswept: {' '.join(message.split())}", err=True)
    sys.exit(code)


@contextmanager
def _stopped_by_sigterm() -> Iterator[None]:
    """Ends what runs as Ctrl-C does when the process is told to end, so that no half file is left."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _let_go_of_stdout() -> None:
    """What could not be written is dropped: Python would try again, and fail, at its end."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
