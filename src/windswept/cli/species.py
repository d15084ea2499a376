"""``windswept species``."""

from __future__ import annotations

import json

import click

from windswept.plants.species import load_species, species_names


@click.command("species")
@click.option("--json", "as_json", is_flag=True, help="One JSON list instead of lines.")
def command(as_json: bool) -> None:
    """List the built-in species, a line each.

    Example: windswept species
    """
    known = [load_species(name) for name in species_names()]
    if as_json:
        keys = ("name", "common_name", "latin_name", "summary")
        click.echo(json.dumps([{key: getattr(one, key) for key in keys} for one in known]))
        return
    width = max(len(one.name) for one in known)
    for one in known:
        click.echo(f"{one.name:<{width}}  {one.common_name} ({one.latin_name}): {one.summary}")
