"""docs/scene-file.md says what the forms say."""

import tomllib
from pathlib import Path

import pytest

from windswept.scene.document import key_tables, with_key_tables
from windswept.scene.form import SceneForm
from windswept.scene.load_scene import build_scene

DOCUMENT = Path(__file__).parents[2] / "docs" / "scene-file.md"


def test_tables_are_in_step() -> None:
    text = DOCUMENT.read_text(encoding="utf-8")
    told = "run: python -m windswept.scene.document docs/scene-file.md"
    assert with_key_tables(text) == text, told


def test_every_key_has_a_meaning() -> None:
    rows = [line for line in key_tables().splitlines() if line.startswith("| `")]
    assert len(rows) > 60
    for row in rows:
        assert row.split("|")[4].strip() not in ("", "None"), row


@pytest.mark.parametrize(
    "heading", ["[ground]", "[[wind.gust]]", "[[stand.source]]", "[stand.area]", "[[camera.key]]"]
)
def test_every_table_has_a_section(heading: str) -> None:
    assert f"### {heading}\n" in key_tables()


def test_example_of_the_document_loads() -> None:
    text = DOCUMENT.read_text(encoding="utf-8")
    example = text.split("```toml\n")[1].split("```")[0]
    data = tomllib.loads(example)
    SceneForm.model_validate(data)
    assert build_scene("doc.toml", data).placement_count == 1
