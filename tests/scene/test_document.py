"""docs/scene-file.md and docs/plants.md say what the forms say."""

import tomllib
from pathlib import Path

import pytest

from windswept.forms.document import key_tables, with_key_tables
from windswept.scene.document import FORMS
from windswept.scene.form import SceneForm
from windswept.scene.load_scene import build_scene

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize("name", FORMS)
def test_tables_are_in_step(name: str) -> None:
    text = (DOCS / name).read_text(encoding="utf-8")
    assert with_key_tables(text, FORMS[name]) == text, "run: python -m windswept.scene.document docs"


@pytest.mark.parametrize("name", FORMS)
def test_every_key_has_a_meaning(name: str) -> None:
    rows = [line for line in key_tables(FORMS[name]).splitlines() if line.startswith("| `")]
    assert len(rows) > 50
    for row in rows:
        assert row.split("|")[4].strip() not in ("", "None"), row


@pytest.mark.parametrize(
    "heading", ["[ground]", "[[wind.gust]]", "[[stand.source]]", "[stand.area]", "[[camera.key]]"]
)
def test_every_table_has_a_section(heading: str) -> None:
    assert f"### {heading}\n" in key_tables(SceneForm)


def test_example_of_the_document_loads() -> None:
    text = (DOCS / "scene-file.md").read_text(encoding="utf-8")
    example = text.split("```toml\n")[1].split("```")[0]
    data = tomllib.loads(example)
    SceneForm.model_validate(data)
    assert build_scene("doc.toml", data).placement_count == 1
