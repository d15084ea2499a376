"""Grey images: all kinds that hold numbers are read to 0..1, all others are refused in one line."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from PIL.TiffImagePlugin import ImageFileDirectory_v2

from windswept.errors import InputError
from windswept.forms.read_image import read_grey

RAMP = np.arange(12).reshape(3, 4)


@pytest.mark.parametrize("ending", ["png", "tif"])
@pytest.mark.parametrize(("kind", "white"), [(np.uint8, 255), (np.uint16, 65535)])
def test_grey_of_8_and_16_bit(tmp_path: Path, ending: str, kind: Any, white: int) -> None:
    path = tmp_path / f"ramp.{ending}"
    Image.fromarray((RAMP * (white // 11)).astype(kind)).save(path)
    image = read_grey(path)
    np.testing.assert_allclose(image.grey, RAMP * (white // 11) / white, atol=1e-12)
    assert image.step == pytest.approx(1.0 / white)


def test_floating_point_is_taken_as_it_is(tmp_path: Path) -> None:
    Image.fromarray((RAMP / 11.0).astype(np.float32)).save(tmp_path / "ramp.tif")
    image = read_grey(tmp_path / "ramp.tif")
    np.testing.assert_allclose(image.grey, RAMP / 11.0, atol=1e-7)
    assert image.step == 0.0


def test_opaque_alpha_is_no_hole(tmp_path: Path) -> None:
    Image.merge("LA", [Image.new("L", (4, 4), 51), Image.new("L", (4, 4), 255)]).save(tmp_path / "a.png")
    assert read_grey(tmp_path / "a.png").grey == pytest.approx(np.full((4, 4), 0.2))


def refusal(path: Path) -> str:
    with pytest.raises(InputError) as caught:
        read_grey(path)
    text = str(caught.value)
    assert text.startswith(str(path))
    assert "\n" not in text
    return text


@pytest.mark.parametrize(
    ("mode", "words"), [("RGB", "in colour"), ("RGBA", "in colour"), ("P", "with a palette")]
)
def test_other_kinds_are_named(tmp_path: Path, mode: str, words: str) -> None:
    Image.new(mode, (4, 4)).save(tmp_path / "image.png")
    assert f"(PNG or TIFF): this one is {words}" in refusal(tmp_path / "image.png")


def test_holes_by_alpha_by_colour_and_by_no_data_tag(tmp_path: Path) -> None:
    alpha = Image.new("L", (4, 4), 255)
    alpha.putpixel((2, 1), 0)
    Image.merge("LA", [Image.new("L", (4, 4)), alpha]).save(tmp_path / "alpha.png")
    assert "1 of its pixels has no value, the first in column 2, row 1" in refusal(tmp_path / "alpha.png")
    Image.fromarray(RAMP.astype(np.uint8)).save(tmp_path / "colour.png", transparency=7)
    assert "1 of its pixels has no value, the first in column 3, row 1" in refusal(tmp_path / "colour.png")
    tags = ImageFileDirectory_v2()
    tags[42113] = "5"
    Image.fromarray(RAMP.astype(np.uint16)).save(tmp_path / "tag.tif", tiffinfo=tags)
    assert "1 of its pixels has no value, the first in column 1, row 1" in refusal(tmp_path / "tag.tif")


def test_values_beyond_black_and_white(tmp_path: Path) -> None:
    Image.fromarray(RAMP.astype(np.float32)).save(tmp_path / "metres.tif")
    assert "its values go from 0 to 11, not from 0 to 1" in refusal(tmp_path / "metres.tif")


def test_sizes_endings_and_files_that_are_none(tmp_path: Path) -> None:
    Image.new("L", (1, 9)).save(tmp_path / "thin.png")
    assert "= '1 x 9': expected an image of 2 to 8,192 pixels a side" in refusal(tmp_path / "thin.png")
    Image.new("L", (9000, 2)).save(tmp_path / "long.png")
    assert "= '9000 x 2'" in refusal(tmp_path / "long.png")
    (tmp_path / "text.png").write_text("no image")
    assert "that can be read" in refusal(tmp_path / "text.png")
    whole = (tmp_path / "long.png").read_bytes()
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (64, 64), np.uint8)).save(tmp_path / "cut.png")
    whole = (tmp_path / "cut.png").read_bytes()
    (tmp_path / "cut.png").write_bytes(whole[: len(whole) // 2])
    assert "that can be read" in refusal(tmp_path / "cut.png")
    assert "a path that ends in .png, .tif, .tiff" in refusal(tmp_path / "photo.jpg")
    assert "expected a file that exists" in refusal(tmp_path / "none.png")
