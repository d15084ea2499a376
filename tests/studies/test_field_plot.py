"""The plan view of the field, on a coarse grid."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from windswept.errors import InputError
from windswept.studies import field_plot


def test_picture_shows_the_gust_the_post_and_its_wake(tmp_path: Path) -> None:
    field = field_plot.passing_gust(cell=2.0)
    field_plot.draw_field(field, tmp_path / "field.png")
    picture = np.asarray(Image.open(tmp_path / "field.png").convert("RGB")).astype(int)
    assert picture.shape == (930, 1500, 3)

    def seen(x: float, y: float) -> np.ndarray:
        """Median colour of a square metre, which streaks do not fill."""
        column = field_plot.LEFT + round((x - field_plot.WEST) * field_plot.PER_METRE)
        row = field_plot.TOP + round((field_plot.NORTH - y) * field_plot.PER_METRE)
        return np.median(picture[row - 7 : row + 8, column - 7 : column + 8].reshape(-1, 3), axis=0)

    assert np.abs(seen(-14.0, 5.0) - [70, 66, 64]).max() <= 2
    gust, ahead, wake = seen(0.0, 18.0), seen(35.0, 18.0), seen(-6.0, 6.0)
    assert gust[0] > ahead[0] > wake[0]


def test_picture_ends_in_png(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="png"):
        field_plot.draw_field(field_plot.passing_gust(cell=4.0), tmp_path / "field.jpg")
