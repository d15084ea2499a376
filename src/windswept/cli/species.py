"""``windswept species``."""

from __future__ import annotations

import json
from pathlib import Path

import click

from windswept.plants.species import Species, load_species, species_names
from windswept.plants.underbrush.form import UnderbrushSpecies
from windswept.plants.underbrush.library import load_underbrush, underbrush_names


@click.command("species")
@click.option("--json", "as_json", is_flag=True, help="One JSON list instead of lines.")
@click.option("--sheet", help="Draw them side by side into a .png file.")
def command(as_json: bool, sheet: str | None) -> None:
    """List the built-in species, a line each, trees and herbs before underbrush.

    Example: windswept species --sheet species.png
    """
    if sheet is not None:
        from windswept.forms.files import check_place
        from windswept.studies.species_sheet import draw_sheet

        check_place(Path(sheet), (".png",))
        draw_sheet(species_names(), Path(sheet), say=lambda line: click.echo(line, err=True))
    known: list[Species | UnderbrushSpecies] = [
        *(load_species(name) for name in species_names()),
        *(load_underbrush(name) for name in underbrush_names()),
    ]
    if as_json:
        keys = ("name", "common_name", "latin_name", "summary")
        click.echo(json.dumps([{key: getattr(one, key) for key in keys} for one in known]))
        return
    width = max(len(one.name) for one in known)
    for one in known:
        click.echo(f"{one.name:<{width}}  {one.common_name} ({one.latin_name}): {one.summary}")
