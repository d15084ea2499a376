"""The sheet of species: a picture with every plant, a person and a caption."""

import numpy as np
import pytest
from PIL import Image

from windswept.errors import InputError
from windswept.plants.species import load_species
from windswept.plants.weber_penn import grow
from windswept.studies.species_sheet import CAPTION, CELL, draw_sheet, typical_seed


@pytest.mark.slow
def test_two_plants_side_by_side(tmp_path) -> None:
    told: list[str] = []
    draw_sheet(["wheat", "hazel"], tmp_path / "sheet.png", columns=2, say=told.append)
    assert told == ["drawing wheat", "drawing hazel"]
    with Image.open(tmp_path / "sheet.png") as picture:
        assert picture.size == (2 * CELL[0], CELL[1] + CAPTION)
        pixels = np.asarray(picture).astype(int)
    person = (np.abs(pixels - (30, 32, 38)) <= 2).all(axis=2)
    assert person[:, : CELL[0]].sum() > 500
    assert person[:, CELL[0] :].sum() > 500


def test_the_typical_tree_has_its_species_size() -> None:
    name = "california_black_oak"
    scale = load_species(name).growth.scale
    assert grow(name, typical_seed(name)).height == pytest.approx(scale, rel=0.25)
    assert typical_seed("weed") == 0


def test_the_ending_is_checked_first(tmp_path) -> None:
    with pytest.raises(InputError, match=r"a path that ends in \.png"):
        draw_sheet(["wheat"], tmp_path / "sheet.jpg")
