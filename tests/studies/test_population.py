"""The population study with few trees."""

import numpy as np
from PIL import Image

from windswept.studies.population import TREES, figures, grow_population, main


def test_a_small_population_is_repeatable_and_scales() -> None:
    first, second = grow_population(2 * len(TREES)), grow_population(2 * len(TREES))
    np.testing.assert_array_equal(first.frequency, second.frequency)
    assert first.forest.sum() == len(TREES)
    assert (first.dbh > 0).all()
    # Tall trees are slow, and slender ones slower than those of the open: f is about c D / H^2.
    assert np.corrcoef(np.log(first.height), np.log(first.frequency))[0, 1] < -0.7
    found = figures(first)
    assert found["median_f_sqrt_h_forest"] < found["median_f_sqrt_h_open"]
    assert 0.5 < found["median_f_sqrt_h_forest"] < 3.0


def test_the_command_draws_a_picture(tmp_path, capsys) -> None:
    main(["-o", str(tmp_path / "trees.png"), "--count", "4"])
    assert "median_f_sqrt_h_open" in capsys.readouterr().out
    with Image.open(tmp_path / "trees.png") as picture:
        assert picture.size == (1500, 720)
