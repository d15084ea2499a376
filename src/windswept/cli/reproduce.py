"""``windswept reproduce``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from windswept.cli.numbers import WholeRange
from windswept.errors import InputError
from windswept.forms.files import make_folder


@click.command("reproduce")
@click.argument("paper", type=click.Choice(["beaudoin", "endo", "skjermo"]))
@click.option(
    "--links",
    type=WholeRange(1000, 80_000),
    help="Of Beaudoin's tree.  [default: 77141]",
)
@click.option(
    "-o",
    "--output",
    help="Folder, made if need be, for pictures like the paper's, skjermo's figure 8 among them.",
)
@click.option("--json", "as_json", is_flag=True, help="A JSON list of rows.")
def command(paper: str, links: int | None, output: str | None, as_json: bool) -> None:
    """Make a founding paper's table beside ours.

    Example: windswept reproduce beaudoin -o pictures
    """

    def say(line: str) -> None:
        click.echo(line, err=True)

    if links is not None and paper != "beaudoin":
        raise InputError("--links", "", links, "beaudoin as the paper: the others have no such tree")
    if output == "":
        raise InputError("--output", "", output, "the path of a folder")
    folder = None if output is None else Path(output)
    if folder is not None:
        make_folder(folder, "--output")
    if paper == "beaudoin":
        from windswept.studies.beaudoin import PAPER, beaudoin

        rows, table = beaudoin(links or PAPER[0][0], folder=folder, say=say), _beaudoin_table
    elif paper == "endo":
        from windswept.studies.endo import endo

        rows, table = endo(folder, say=say), _endo_table
    else:
        from windswept.studies.skjermo import skjermo

        rows, table = skjermo(folder, say=say), _skjermo_table
    if as_json:
        click.echo(json.dumps(rows))
    else:
        table(rows)


def _beaudoin_table(rows: list[Any]) -> None:
    click.echo("thesis, figure 6           ours                                             thesis' merges")
    click.echo(
        "branches   fps  times  |  links   steps/s   times  bound m   p95 m  px   rms  |  p95 m   px   rms"
    )
    for row in rows:
        click.echo(
            f"{row['paper_branches']:>8} {row['paper_fps']:>5.0f} {row['paper_speedup']:>6.1f}  |"
            f" {row['branches']:>6} {row['steps_per_second']:>9.0f} {row['speedup']:>7.1f}"
            f" {row['bound_m']:>8.3f} {row['p95_m']:>7.3f} {row['p95_pixels']:>4.2f} {row['rms_over_motion']:>5.1%}  |"
            f" {row['printed_p95_m']:>6.3f} {row['printed_p95_pixels']:>5.2f} {row['printed_rms_over_motion']:>5.1%}"
        )


def _endo_table(rows: list[Any]) -> None:
    click.echo(
        "field      tufts  flowers  leaves     blades  |  paper fps      ours     drawn   steps/s  ns/blade"
    )
    for row in rows:
        paper = "" if row["paper_fps"] is None else "{:.0f} to {:.0f}".format(*row["paper_fps"])
        click.echo(
            f"{row['what']:<9} {row['tufts']:>6} {row['flowers']:>8} {row['leaves']:>7} {row['blades']:>10}  |"
            f" {paper:>10} {row['frames_per_second']:>9.1f} {row['blades_drawn']:>9} {row['steps_per_second']:>9.0f}"
            f" {row['ns_per_blade_step']:>9.1f}   {row['on']}"
        )


def _skjermo_table(rows: list[Any]) -> None:
    click.echo("what    mode     branches   vertices  |  paper/s     ours/s   gap p95 m  gap max m  on")
    for row in rows:
        paper = "" if row["paper_per_second"] is None else f"{row['paper_per_second']:.0f}"
        gaps = (f"{row[name]:.1e}" if name in row else "" for name in ("gap_p95_m", "gap_max_m"))
        click.echo(
            f"{row['what']:<7} {row['mode']:<8} {row['branches']:>8} {row['vertices'] or '':>10}  |"
            f" {paper:>8} {row['per_second']:>10.4g}   {next(gaps):>9}  {next(gaps):>9}  {row['on']}"
        )
