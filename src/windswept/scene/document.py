"""Writes the tables of keys into docs/scene-file.md and docs/plants.md.

Run ``python -m windswept.scene.document docs`` after a change of the forms.
"""

from __future__ import annotations

import sys
from pathlib import Path

from pydantic import BaseModel

from windswept.forms.document import with_key_tables
from windswept.plants.species_form import Species
from windswept.scene.form import SceneForm

FORMS: dict[str, type[BaseModel]] = {"scene-file.md": SceneForm, "plants.md": Species}
"""Which form each document describes."""


def write_documents(folder: Path) -> None:
    """Bring the tables of all documents in a folder up to date."""
    for name, form in FORMS.items():
        text = (folder / name).read_text(encoding="utf-8")
        (folder / name).write_text(with_key_tables(text, form), encoding="utf-8")


if __name__ == "__main__":
    write_documents(Path(sys.argv[1]))
