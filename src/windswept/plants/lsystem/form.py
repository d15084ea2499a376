"""The form of the .toml file that may lie beside a grammar: units, leaves, material and look."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from pydantic import Field

from windswept.forms.check_form import check_form
from windswept.forms.form import Form
from windswept.forms.read_text import shown_path
from windswept.forms.read_toml import read_toml
from windswept.plants.plant import Look, Material
from windswept.plants.species_form import Line, LookForm, MaterialForm


class GrammarForm(Form):
    """What cpfg notation has no place for. Without the file all of it is at its defaults."""

    common_name: Line = ""
    summary: Line = ""
    scale_m: Annotated[float, Field(ge=1e-4, le=1000)] = 1.0
    """Metres per unit of the grammar: lengths, and diameters set by !."""
    tip_radius: Annotated[float, Field(ge=1e-4, le=0.1)] = 1e-3
    """Radius of the last twigs where the grammar sets no width, m; the rest follows from the pipe model."""
    leaf_aspect: Annotated[float, Field(ge=0.005, le=20)] = 0.5
    """Width over length of leaves drawn with one parameter."""
    material: MaterialForm = MaterialForm()
    look: LookForm = LookForm()

    def plant_material(self) -> Material:
        """What the plant's wood and leaves are made of."""
        return Material(**self.material.model_dump())

    def plant_look(self) -> Look:
        """What the plant looks like."""
        return Look(**self.look.model_dump())


def read_form(grammar: Path) -> GrammarForm:
    """The form beside a grammar, same name and .toml; defaults where there is none.

    Raises:
        InputError: with the dotted key.
    """
    path = grammar.with_suffix(".toml")
    if not path.is_file():
        return GrammarForm()
    return check_form(shown_path(path), GrammarForm, read_toml(path, 1 << 16, "a table of a grammar's looks"))
