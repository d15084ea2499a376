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
    """List the built-in species, a line each: plants that grow alone, then underbrush.

    Underbrush grows in scenes: render and view draw a patch of it, grow and levels do not take it.

    Example: windswept species --sheet species.png
    """
    if sheet is not None:
        from windswept.forms.files import check_place
        from windswept.studies.species_sheet import draw_sheet

        check_place(Path(sheet), (".png",), "--sheet")
        draw_sheet(species_names(), Path(sheet), say=lambda line: click.echo(line, err=True))
        click.echo(f"not on the sheet, as it grows in scenes: {', '.join(underbrush_names())}", err=True)
    known: list[Species | UnderbrushSpecies] = [
        *(load_species(name) for name in species_names()),
        *(load_underbrush(name) for name in underbrush_names()),
    ]
    if as_json:
        click.echo(json.dumps([_row(one) for one in known]))
        return
    width = max(len(one.name) for one in known)
    for one in known:
        mark = "underbrush, " if isinstance(one, UnderbrushSpecies) else ""
        click.echo(f"{one.name:<{width}}  {mark}{one.common_name} ({one.latin_name}): {one.summary}")


def _row(one: Species | UnderbrushSpecies) -> dict[str, object]:
    """What ``windswept species --json`` says of one."""
    said = {key: getattr(one, key) for key in ("name", "common_name", "latin_name", "summary")}
    return said | {"underbrush": isinstance(one, UnderbrushSpecies)}
