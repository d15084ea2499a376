"""The command line: one file a command, loaded only when it is called."""

from __future__ import annotations

import importlib
import os
import sys
from typing import Any

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
    """
    os.environ.setdefault("NUMBA_THREADING_LAYER", "workqueue")
    try:
        return cli.main(arguments, standalone_mode=False)
    except (WindsweptError, click.ClickException) as error:
        message = error.format_message() if isinstance(error, click.ClickException) else str(error)
        click.echo(f"windswept: {' '.join(message.split())}", err=True)
        sys.exit(2)
    except (KeyboardInterrupt, click.Abort):
        click.echo("windswept: stopped", err=True)
        sys.exit(130)
