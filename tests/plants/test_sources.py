"""The one dispatcher: names, files of every family, the same bytes twice, and scenes that use them."""

import numpy as np
import pytest

from windswept.plants.save import save_plant
from windswept.plants.sources import grow_source, grow_with_report, source_names
from windswept.plants.species import species_names
from windswept.plants.weber_penn import grow
from windswept.plants.write_species import species_toml
from windswept.scene.load_scene import load_scene

from .importers.preset_files import PRESETS
from .scans.scan_files import fork, write_csv


@pytest.fixture
def files(tmp_path):
    """One file of every family."""
    for name, text in PRESETS.items():
        (tmp_path / name).write_text(text)
    write_csv(tmp_path / "fork.csv", fork())
    save_plant(grow("wheat", 2), tmp_path / "wheat.npz")
    species, _ = grow_with_report(tmp_path / "ash.py").species, None
    (tmp_path / "ash.toml").write_text(species_toml(species))
    (tmp_path / "weed.l").write_text(
        "Lsystem: 1\nderivation length: 3\nAxiom: F\nF --> F[+F]F[-F]F\nendlsystem\n"
    )
    return sorted(tmp_path.iterdir())


def test_every_family_gives_the_same_bytes_twice(files) -> None:
    assert len(files) == len(PRESETS) + 4
    for path in files:
        first, second = grow_source(path, 5), grow_source(str(path), 5)
        for name in ("link_base", "link_tip", "link_radius_base", "leaf_position", "leaf_axis"):
            assert getattr(first, name).tobytes() == getattr(second, name).tobytes(), path


def test_a_scene_may_hold_any_of_them(files, tmp_path) -> None:
    plants = "".join(
        f'[[plant]]\nsource = "{path.name}"\nposition = [{3 * i}, 0]\n' for i, path in enumerate(files)
    )
    camera = "[camera]\neye = [0, -9, 1]\ntarget = [0, 0, 1]\n"
    scene_file = tmp_path / "scene.toml"
    scene_file.write_text(plants + camera)
    assert len(load_scene(scene_file).kinds) == len(files)
    for path in files:
        assert load_scene(path).placement_count == 1


def test_what_was_changed_is_told(files) -> None:
    told: list[str] = []
    grow_source(next(path for path in files if path.name == "birch.xml"), say=told.append)
    assert told[0].startswith("Arbaro XML: ")
    assert any("Flare -0.8 -> 0" in line for line in told)


def test_names() -> None:
    assert set(species_names()) <= set(source_names())
    assert len(species_names()) >= 24
    np.testing.assert_array_equal(grow_source("hazel", 1).link_tip, grow("hazel", 1).link_tip)
