"""Saved plants reload bit for bit; damaged ones are told in one line."""

import json
import zipfile
from dataclasses import fields, replace

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.plants.plant import Plant
from windswept.plants.save import load_plant, save_plant
from windswept.plants.sources import grow_source
from windswept.plants.weber_penn import grow


def assert_same(first: Plant, second: Plant) -> None:
    for item in fields(Plant):
        one, other = getattr(first, item.name), getattr(second, item.name)
        if isinstance(one, np.ndarray):
            assert one.dtype == other.dtype
            assert one.tobytes() == other.tobytes()
        else:
            assert one == other


@pytest.fixture(scope="module")
def plant():
    return grow("broom", seed=4)


def test_round_trip_and_same_bytes_twice(plant, tmp_path) -> None:
    save_plant(plant, tmp_path / "one.npz")
    save_plant(plant, tmp_path / "two.npz")
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "two.npz").read_bytes()
    assert_same(plant, load_plant(tmp_path / "one.npz"))
    assert_same(plant, grow_source(str(tmp_path / "one.npz"), seed=9))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.npz", "two.npz"]


def test_joint_scale_is_kept(plant, tmp_path) -> None:
    scaled = replace(plant, joint_scale=np.full((plant.link_count, 2), 0.5, np.float32))
    save_plant(scaled, tmp_path / "scaled.npz")
    assert_same(scaled, load_plant(tmp_path / "scaled.npz"))


def test_a_place_that_cannot_be_written(plant, tmp_path) -> None:
    with pytest.raises(InputError, match="a folder that exists"):
        save_plant(plant, tmp_path / "none" / "plant.npz")


def rewritten(plant, path, **changes):
    """A saved plant with some arrays replaced; None takes one out."""
    save_plant(plant, path)
    with np.load(path) as stored:
        arrays = {name: stored[name] for name in stored.files}
    arrays = {name: array for name, array in (arrays | changes).items() if array is not None}
    np.savez(path, **arrays)


@pytest.mark.parametrize(
    "name", ["link_base", "stem_radius", "leaf_link", "stem_link_start", "link_parent", "windswept_plant"]
)
def test_a_missing_array(plant, tmp_path, name) -> None:
    rewritten(plant, tmp_path / "bad.npz", **{name: None})
    with pytest.raises(InputError, match="the arrays of a plant"):
        load_plant(tmp_path / "bad.npz")


def head(**changes):
    from dataclasses import asdict

    from windswept.plants.plant import Look, Material

    whole = {"version": 1, "species": "a", "seed": 0, "material": asdict(Material()), "look": asdict(Look())}
    return np.frombuffer(json.dumps(whole | changes).encode(), np.uint8)


DAMAGE = {
    "nan": lambda plant: {"link_tip": np.full_like(plant.link_tip, np.nan)},
    "doubles": lambda plant: {"link_tip": plant.link_tip.astype(np.float64)},
    "flat": lambda plant: {"link_tip": plant.link_tip.ravel()},
    "number": lambda plant: {"link_tip": np.float32(3.0)},
    "short": lambda plant: {"link_radius_tip": plant.link_radius_tip[:-1]},
    "negative radius": lambda plant: {"link_radius_tip": -plant.link_radius_tip},
    "parent after child": lambda plant: {"link_parent": plant.link_parent[::-1].copy()},
    "parent out of range": lambda plant: {"link_parent": plant.link_parent + np.int32(10**6)},
    "leaf off the plant": lambda plant: {"leaf_link": plant.leaf_link + np.int32(10**6)},
    "stems out of order": lambda plant: {"stem_link_start": plant.stem_link_start[::-1].copy()},
    "another version": lambda plant: {"windswept_plant": head(version=99)},
    "no object": lambda plant: {"windswept_plant": np.frombuffer(b"[]", np.uint8)},
    "no JSON": lambda plant: {"windswept_plant": np.frombuffer(b"{", np.uint8)},
    "no material": lambda plant: {"windswept_plant": head(material={})},
    "text for a number": lambda plant: {
        "windswept_plant": head(material=json.loads(head().tobytes())["material"] | {"leaf_mass": "x"})
    },
    "objects": lambda plant: {"link_tip": np.array([{}], object)},
}


@pytest.mark.parametrize("name", DAMAGE)
def test_damaged_plants(plant, tmp_path, name) -> None:
    path = tmp_path / "bad.npz"
    rewritten(plant, path, **DAMAGE[name](plant))
    with pytest.raises(InputError) as caught:
        load_plant(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_a_truncated_file_and_an_archive_bomb(plant, tmp_path) -> None:
    path = tmp_path / "bad.npz"
    save_plant(plant, path)
    path.write_bytes(path.read_bytes()[:-200])
    with pytest.raises(InputError, match=r"an \.npz file that windswept saved a plant to, and whole"):
        load_plant(path)
    with (
        zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive,
        archive.open("link_tip.npy", "w") as entry,
    ):
        for _ in range(600):
            entry.write(bytes(1 << 20))
    with pytest.raises(InputError, match="bytes unpacked"):
        load_plant(path)
