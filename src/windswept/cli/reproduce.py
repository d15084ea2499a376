"""``windswept reproduce``."""

from __future__ import annotations

import json

import click


@click.command("reproduce")
@click.argument("paper", type=click.Choice(["beaudoin"]))
@click.option(
    "--links", type=click.IntRange(1000, 80_000), default=77_141, show_default=True, help="Of the tree."
)
@click.option("--json", "as_json", is_flag=True, help="A JSON list of rows.")
def command(paper: str, links: int, as_json: bool) -> None:
    """Make a founding paper's table beside ours.

    Example: windswept reproduce beaudoin
    """
    from windswept.studies.beaudoin import beaudoin

    rows = beaudoin(links, say=lambda line: click.echo(line, err=True))
    if as_json:
        click.echo(json.dumps(rows))
        return
    click.echo("thesis, figure 6           ours                                    thesis' merges")
    click.echo("branches   fps  times  |  links   steps/s   times   p95 m   rms  |  p95 m   rms")
    for row in rows:
        click.echo(
            f"{row['paper_branches']:>8} {row['paper_fps']:>5.0f} {row['paper_speedup']:>6.1f}  |"
            f" {row['branches']:>6} {row['steps_per_second']:>9.0f} {row['speedup']:>7.1f}"
            f" {row['p95_m']:>7.3f} {row['rms_over_motion']:>5.1%}  |"
            f" {row['printed_p95_m']:>6.3f} {row['printed_rms_over_motion']:>5.1%}"
        )
